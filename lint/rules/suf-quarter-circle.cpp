#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_quarter_circle){
    .severity = Severity::Error,
    .check = reportFound<mikroprog::unequalQuarters>,
};

} // namespace dotek::lint::rule
