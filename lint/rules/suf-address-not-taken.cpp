#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_address_not_taken){
    .severity = Severity::Error,
    .explanation = "The control would refuse the word, or read it for another function.",
    .check = reportFound<mikroprog::addressesNotTaken>,
};

} // namespace dotek::lint::rule
