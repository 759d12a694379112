#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(word_repeated) = programRule<macrob::wordRepeatedCheck>();

} // namespace dotek::lint::rule
