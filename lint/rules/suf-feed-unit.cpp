#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_feed_unit){
    .severity = Severity::Error,
    .check = reportFound<mikroprog::feedUnits>,
};

} // namespace dotek::lint::rule
