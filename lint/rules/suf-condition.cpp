#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_condition){
    .severity = Severity::Error,
    .explanation = "O6 is reserved, O9 unused; others are not described.",
    .check = reportFound<mikroprog::unknownConditions>,
};

} // namespace dotek::lint::rule
