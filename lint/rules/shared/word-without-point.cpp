#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(word_without_point) = programRule<macrob::wordWithoutPointCheck>();

} // namespace dotek::lint::rule
