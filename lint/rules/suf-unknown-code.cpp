#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_unknown_code){
    .severity = Severity::Error,
    .explanation = "The functions of the control are listed in its profile; a code from another "
                   "control may mean something else here.",
    .check = reportFound<mikroprog::unknownCodes>,
};

} // namespace dotek::lint::rule
