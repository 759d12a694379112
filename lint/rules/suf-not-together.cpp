#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_not_together){
    .severity = Severity::Error,
    .check = reportFound<mikroprog::addressesNotTogether>,
};

} // namespace dotek::lint::rule
