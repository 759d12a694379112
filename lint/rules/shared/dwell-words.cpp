#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(dwell_words) = programRule<macrob::dwellWordsCheck>();

} // namespace dotek::lint::rule
