#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_condition){
    .severity = Severity::Error,
    .check = reportFound<mikroprog::unknownConditions>,
};

} // namespace dotek::lint::rule
