#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(rotation_words) = programRule<macrob::rotationWordsCheck>();

} // namespace dotek::lint::rule
