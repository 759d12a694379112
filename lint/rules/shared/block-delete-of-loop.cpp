#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(block_delete_of_loop) = programRule<macrob::blockDeleteOfLoopCheck>();

} // namespace dotek::lint::rule
