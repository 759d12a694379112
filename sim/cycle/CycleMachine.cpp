#include "sim/cycle/CycleMachine.h"

namespace dotek::sim {

const stdlib::Control& cycleControl() {
  static const stdlib::Control control = [] {
    stdlib::Control out;
    out.name = "cycle";
    out.title = "the meaning of the cycle";
    out.origin = "built in";
    out.locals = 0;
    out.common = {{100, 999, false}};
    // Its work offsets have their names.
    stdlib::CodeInfo system;
    system.tenths = 540;
    system.function = stdlib::Function::WorkSystem;
    out.codes.push_back(system);
    out.variables.toolCount = 999;
    out.variables.extendedCount = 300;
    return out;
  }();
  return control;
}

} // namespace dotek::sim
