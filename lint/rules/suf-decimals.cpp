#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_decimals){
    .severity = Severity::Error,
    .check = reportFound<mikroprog::tooManyDecimals>,
};

} // namespace dotek::lint::rule
