// Text of macro programs through the parser, the lowering and the machine, with small limits: nothing may
// crash, hang or grow, and two runs are the same.
#include "frontend/macrob/Lower.h"
#include "frontend/macrob/Parse.h"
#include "sim/machine/Compile.h"
#include "sim/machine/Run.h"
#include "stdlib/DataFiles.h"

#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

class Half : public dotek::sim::SkipSignal {
public:
  std::optional<double> contact(const dotek::sim::SkipMove&) override { return 0.5; }
};

} // namespace

// The first byte chooses the control and whether the probe touches.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dotek;
  static const stdlib::DataFiles files;
  static const stdlib::Control controls[] = {*stdlib::Control::load(files, "fanuc-31i-b"),
                                             *stdlib::Control::load(files, "fanuc-0i-md"),
                                             *stdlib::Control::load(files, "fanuc-6m")};
  if (size == 0) return 0;
  const stdlib::Control& control = controls[data[0] % 3];
  Limits limits;
  limits.simSteps = 20000;
  limits.outputBytes = 4096;
  SourceMap sources;
  Diagnostics diagnostics;
  const FileId id = sources.add(
      SourceFile("input", std::string(reinterpret_cast<const char*>(data) + 1, size - 1), Encoding::Cp1250));
  const auto file = frontend::macrob::lower(frontend::macrob::parse(id, sources, limits, diagnostics),
                                            control, sources, diagnostics);
  if (!file) return 0;
  std::vector<const ir::Program*> programs;
  for (const ir::Program& program : file->programs)
    programs.push_back(&program);
  const sim::Bytecode code = sim::compile(programs, control, sources);
  std::string traces[2];
  for (std::string& out : traces) {
    sim::Machine machine(control);
    Half signal;
    if ((data[0] & 64) != 0) machine.setSkipSignal(&signal);
    sim::Trace trace([&](std::string_view piece) { out += piece; });
    machine.setTrace(&trace);
    sim::Run run(machine, code, limits);
    run.run();
    trace.flush();
    machine.setTrace(nullptr);
    if (machine.running() || run.output().size() > 3 * limits.outputBytes + 65536) std::abort();
    if (!run.place().hasPlace() && !code.routines.empty() && !programs.front()->body.empty()) std::abort();
    run.openCalls();
    machine.written();
    out += run.output();
  }
  if (traces[0] != traces[1]) std::abort();
  return 0;
}
