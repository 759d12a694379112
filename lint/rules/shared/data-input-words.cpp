#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(data_input_words) = programRule<macrob::dataInputWordsCheck>();

} // namespace dotek::lint::rule
