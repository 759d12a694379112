#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_condition_in_comment){
    .severity = Severity::Error,
    .explanation = "A listing prints the letter O small and after a semicolon; so the condition is "
                   "lost.",
    .check = reportFound<mikroprog::conditionsInComments>,
};

} // namespace dotek::lint::rule
