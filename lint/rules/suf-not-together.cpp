#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_not_together){
    .severity = Severity::Error,
    .explanation = "The control refuses an arc with a radius and a centre, for example.",
    .check = reportFound<mikroprog::addressesNotTogether>,
};

} // namespace dotek::lint::rule
