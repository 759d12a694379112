#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_power_section){
    .severity = Severity::Error,
    .check = reportFound<mikroprog::powerSection>,
};

} // namespace dotek::lint::rule
