#include "frontend/mikroprog/Check.h"
#include "frontend/mikroprog/Lower.h"
#include "frontend/mikroprog/Parse.h"
#include "sim/machine/Run.h"
#include "sim/mikroprog/Dialect.h"
#include "stdlib/DataFiles.h"

#include <cstdint>
#include <string>

// The first byte chooses encoding and control; what can be read runs for some blocks in the empty room.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dotek;
  namespace mikroprog = frontend::mikroprog;
  static const stdlib::DataFiles files;
  static const stdlib::MikroprogControl lathe = *stdlib::MikroprogControl::load(files, "mikroprog-s280");
  static const stdlib::MikroprogControl mill = *stdlib::MikroprogControl::load(files, "mikroprog-mill");
  if (size == 0) return 0;
  struct : sim::SkipSignal {
    std::optional<double> contact(const sim::SkipMove&) override { return std::nullopt; }
  } room;
  SourceMap sources;
  const FileId id =
      sources.add(SourceFile("input", std::string(reinterpret_cast<const char*>(data) + 1, size - 1),
                             (data[0] & 1) != 0 ? Encoding::Utf8 : Encoding::Cp852));
  const stdlib::MikroprogControl& control = (data[0] & 2) != 0 ? lathe : mill;
  Diagnostics diagnostics;
  const mikroprog::Program program = mikroprog::parse(id, sources, diagnostics);
  mikroprog::refuse({program, control, sources}, diagnostics);
  renderText(diagnostics, sources, 0);
  mikroprog::dumpTokens(program, sources);
  mikroprog::dumpAst(program, sources);
  if (auto lowered = mikroprog::lower(program, sources)) {
    const sim::mikroprog::Profile profile(control);
    const sim::Bytecode code = sim::mikroprog::compile(lowered->programs.front(), profile, sources);
    sim::Machine machine(profile.machine, profile.dialect);
    machine.setSkipSignal(&room);
    Limits limits;
    limits.simSteps = 10'000;
    sim::Run(machine, code, limits).run();
  }
  return 0;
}
