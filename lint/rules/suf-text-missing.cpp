#include "lint/SufPrograms.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(suf_text_missing){
    .severity = Severity::Error,
    .explanation = "M29 writes the text that follows the semicolon.",
    .check = reportFound<mikroprog::missingTexts>,
};

} // namespace dotek::lint::rule
