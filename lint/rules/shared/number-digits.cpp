#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(number_digits) = programRule<macrob::numberDigitsCheck>();

} // namespace dotek::lint::rule
