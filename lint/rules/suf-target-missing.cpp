#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_target_missing){
    .severity = Severity::Error,
    .check = reportFound<mikroprog::missingTargets>,
};

} // namespace dotek::lint::rule
