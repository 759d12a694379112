#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_stray_return){
    .severity = Severity::Error,
    .check = reportFound<mikroprog::strayReturns>,
};

} // namespace dotek::lint::rule
