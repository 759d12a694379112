#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(word_not_taken) = programRule<macrob::wordNotTakenCheck>();

} // namespace dotek::lint::rule
