#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_range){
    .severity = Severity::Error,
    .check = reportFound<mikroprog::valuesOutOfRange>,
};

} // namespace dotek::lint::rule
