#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(word_out_of_range) = programRule<macrob::wordOutOfRangeCheck>();

} // namespace dotek::lint::rule
