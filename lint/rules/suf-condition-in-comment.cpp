#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_condition_in_comment){
    .severity = Severity::Error,
    .check = reportFound<mikroprog::conditionsInComments>,
};

} // namespace dotek::lint::rule
