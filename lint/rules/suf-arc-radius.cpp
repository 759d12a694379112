#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_arc_radius){
    .severity = Severity::Error,
    .check = reportFound<mikroprog::impossibleArcs>,
};

} // namespace dotek::lint::rule
