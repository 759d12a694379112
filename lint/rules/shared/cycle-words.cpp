#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(cycle_words) = programRule<macrob::cycleWordsCheck>();

} // namespace dotek::lint::rule
