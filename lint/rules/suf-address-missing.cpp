#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_address_missing){
    .severity = Severity::Error,
    .explanation = "Which addresses a function needs is data of the profile of the control.",
    .check = reportFound<mikroprog::missingAddresses>,
};

} // namespace dotek::lint::rule
