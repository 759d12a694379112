#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_range){
    .severity = Severity::Error,
    .explanation = "The ranges of addresses are data of the profile of the control.",
    .check = reportFound<mikroprog::valuesOutOfRange>,
};

} // namespace dotek::lint::rule
