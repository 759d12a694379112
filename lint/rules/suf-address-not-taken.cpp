#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_address_not_taken){
    .severity = Severity::Error,
    .check = reportFound<mikroprog::addressesNotTaken>,
};

} // namespace dotek::lint::rule
