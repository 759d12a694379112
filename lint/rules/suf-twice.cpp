#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_twice){
    .severity = Severity::Error,
    .check = reportFound<mikroprog::saidTwice>,
};

} // namespace dotek::lint::rule
