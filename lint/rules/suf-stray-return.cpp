#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_stray_return){
    .severity = Severity::Error,
    .explanation = "M17 without a call is an error of the control.",
    .check = reportFound<mikroprog::strayReturns>,
};

} // namespace dotek::lint::rule
