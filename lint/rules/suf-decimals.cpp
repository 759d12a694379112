#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_decimals){
    .severity = Severity::Error,
    .explanation = "Lengths have three decimals at most.",
    .check = reportFound<mikroprog::tooManyDecimals>,
};

} // namespace dotek::lint::rule
