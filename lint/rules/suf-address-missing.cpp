#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_address_missing){
    .severity = Severity::Error,
    .check = reportFound<mikroprog::missingAddresses>,
};

} // namespace dotek::lint::rule
