#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_file_missing){
    .severity = Severity::Error,
    .explanation = "The function writes or reads a file of the folder of the program.",
    .check = reportFound<mikroprog::missingFiles>,
};

} // namespace dotek::lint::rule
