#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_quarter_circle){
    .severity = Severity::Error,
    .explanation = "G62 and G63 cut 90 degrees and nothing else. X is a diameter: its travel is half "
                   "the difference of the words.",
    .check = reportFound<mikroprog::unequalQuarters>,
};

} // namespace dotek::lint::rule
