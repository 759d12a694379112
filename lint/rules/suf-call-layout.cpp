#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_call_layout){
    .severity = Severity::Error,
    .explanation = "M30 divides the main program from the subprograms.",
    .check = reportFound<mikroprog::subprogramsBeforeEnd>,
};

} // namespace dotek::lint::rule
