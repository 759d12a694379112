#include "sim/cycle/CycleMachine.h"

#include "ir/CycleNames.h"
#include "stdlib/RadiusOffsets.h"

#include <utility>

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
    // Its tool table, by the numbers at which a cycle reads it.
    constexpr int kTools = 999;
    const auto base = [](ir::ToolPart part) {
      return static_cast<int>(ir::kToolTable + ir::kToolPartStep * static_cast<double>(part));
    };
    out.variables.toolCount = kTools;
    out.variables.toolGeometry = base(ir::ToolPart::Length);
    out.variables.toolWear = base(ir::ToolPart::LengthWear);
    for (const auto& [part, title] : {std::pair(ir::ToolPart::Radius, stdlib::kRadiusGeometryTitle),
                                      std::pair(ir::ToolPart::RadiusWear, stdlib::kRadiusWearTitle)}) {
      stdlib::StateRange range;
      range.first = static_cast<std::uint32_t>(base(part)) + 1;
      range.last = range.first + kTools - 1;
      range.access = stdlib::StateRange::Access::Store;
      range.initial = 0;
      range.title = title;
      out.state.push_back(std::move(range));
    }
    out.variables.extendedCount = 300;
    return out;
  }();
  return control;
}

} // namespace dotek::sim
