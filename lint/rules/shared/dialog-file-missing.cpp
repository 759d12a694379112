#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(dialog_file_missing) = cycleRule<gibbs::dialogFileMissingCheck>();

} // namespace dotek::lint::rule
