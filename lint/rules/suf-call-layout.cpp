#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_call_layout){
    .severity = Severity::Error,
    .check = reportFound<mikroprog::subprogramsBeforeEnd>,
};

} // namespace dotek::lint::rule
