#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(call_words_alone) = programRule<macrob::callWordsAloneCheck>();

} // namespace dotek::lint::rule
