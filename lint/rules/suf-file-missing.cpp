#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_file_missing){
    .severity = Severity::Error,
    .check = reportFound<mikroprog::missingFiles>,
};

} // namespace dotek::lint::rule
