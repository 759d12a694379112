#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_endless_loop){
    .severity = Severity::Warning,
    .check = reportFound<mikroprog::endlessLoops>,
};

} // namespace dotek::lint::rule
