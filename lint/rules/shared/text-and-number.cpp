#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(text_and_number) = fileRule<gibbs::textAndNumberCheck>();

} // namespace dotek::lint::rule
