#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_arc_radius){
    .severity = Severity::Error,
    .explanation = "With R an arc has at most 180 degrees in one block, so its ends lie at most the "
                   "diameter apart, and a full circle has no R.",
    .check = reportFound<mikroprog::impossibleArcs>,
};

} // namespace dotek::lint::rule
