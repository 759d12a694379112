#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_unknown_code){
    .severity = Severity::Error,
    .check = reportFound<mikroprog::unknownCodes>,
};

} // namespace dotek::lint::rule
