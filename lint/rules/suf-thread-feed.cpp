#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_thread_feed){
    .severity = Severity::Error,
    .explanation = "Found on the machine: the cycle does not run without a feed from before or in "
                   "its block.",
    .check = reportFound<mikroprog::threadsWithoutFeed>,
};

} // namespace dotek::lint::rule
