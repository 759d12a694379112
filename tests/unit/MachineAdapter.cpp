#include "tests/unit/MachineAdapter.h"

#include "frontend/macrob/Lower.h"
#include "tests/unit/MacroBHelper.h"

namespace dotek::tests {
namespace {

const stdlib::Control& controlOf(const std::string& name) {
  static const stdlib::Control modern = *stdlib::Control::load(stdlib::DataFiles(), "fanuc-31i-b");
  static const stdlib::Control older = *stdlib::Control::load(stdlib::DataFiles(), "fanuc-0i-md");
  return name == older.name ? older : modern;
}

} // namespace

MachineRun runOnMachine(const std::string& text, const MacroSetup& setup) {
  MachineRun out;
  MacroFile parsed(text);
  const auto programs = frontend::macrob::lower(parsed.file, controlOf(setup.control), parsed.sources, parsed.diagnostics);
  if (!programs) {
    out.refusal = "not lowered: " + parsed.told();
    return out;
  }
  out.refusal = kNoMachine;
  return out;
}

} // namespace dotek::tests
