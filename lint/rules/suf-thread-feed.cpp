#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_thread_feed){
    .severity = Severity::Error,
    .check = reportFound<mikroprog::threadsWithoutFeed>,
};

} // namespace dotek::lint::rule
