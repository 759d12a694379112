#include "lint/Shared.h"

namespace dotek::lint::rule {

DOTEK_LINT_RULE(table_base_read) = programRule<macrob::tableBaseReadCheck>();

} // namespace dotek::lint::rule
