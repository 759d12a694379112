#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(keyword_misspelt) = progRule<compost::keywordMisspeltCheck>();

} // namespace dotek::lint::rule
