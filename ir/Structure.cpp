#include "ir/Structure.h"

namespace dotek::ir {

Structure structureOf(const Program& program) {
  Structure out;
  (void)program;
  return out;
}

} // namespace dotek::ir
