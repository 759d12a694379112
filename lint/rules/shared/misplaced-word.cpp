#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(misplaced_word) = fileRule<gibbs::misplacedWordCheck>();

} // namespace dotek::lint::rule
