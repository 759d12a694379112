#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_text_missing){
    .severity = Severity::Error,
    .check = reportFound<mikroprog::missingTexts>,
};

} // namespace dotek::lint::rule
