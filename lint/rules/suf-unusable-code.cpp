#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_unusable_code){
    .severity = Severity::Error,
    .explanation = "No source describes the function, or the machine was found unable to run it.",
    .check = reportFound<mikroprog::unusableCodes>,
};

} // namespace dotek::lint::rule
