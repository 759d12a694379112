#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_subprogram_end){
    .severity = Severity::Error,
    .check = reportFound<mikroprog::subprogramsWithoutReturn>,
};

} // namespace dotek::lint::rule
