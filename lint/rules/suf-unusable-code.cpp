#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_unusable_code){
    .severity = Severity::Error,
    .check = reportFound<mikroprog::unusableCodes>,
};

} // namespace dotek::lint::rule
