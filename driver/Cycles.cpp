// `dotek check`, `dotek fmt` and `dotek new cycle`.
#include "driver/Command.h"
#include "frontend/cycle/Parse.h"
#include "frontend/cycle/Words.h"
#include "project/CycleFiles.h"
#include "project/Inputs.h"

namespace dotek::driver {

namespace cycle = frontend::cycle;

namespace {

constexpr std::string_view kExpected = "a cycle";

bool hasInputs(const CycleOptions& options, const char* command, Session& session) {
  if (!options.inputs.empty()) return true;
  session.diagnostics().report<diag::MissingOption>({}, command, "FILE.cycle", kExpected);
  return false;
}

} // namespace

Outcome check(const CycleOptions& options) {
  return guarded(options.common, [&](Session& session) {
    CycleFiles cycles(session);
    if (hasInputs(options, "check", session))
      for (const std::string& path : options.inputs)
        if (kindAmong(path, {InputKind::Cycle}, kExpected, session)) cycles.check(path);
    return outcomeOf(session, "", true);
  });
}

Outcome layOut(const CycleOptions& options) {
  return guarded(options.common, [&](Session& session) {
    CycleFiles cycles(session);
    std::vector<OutputFile> files;
    std::vector<std::string> inputs;
    if (hasInputs(options, "fmt", session))
      for (const std::string& path : options.inputs) {
        if (!kindAmong(path, {InputKind::Cycle}, kExpected, session)) continue;
        const cycle::File* file = cycles.load(path);
        if (file == nullptr || file->hasErrorNodes) continue;
        files.push_back({path, cycle::layOut(*file)});
        if (session.sources().file(file->file).bytes() != files.back().text) inputs.push_back(path);
      }
    Outcome outcome = outcomeOf(session, "", true);
    outcome.files = std::move(files);
    outcome.inputs = std::move(inputs);
    return outcome;
  });
}

Outcome newCycle(const std::string& name, const CommonOptions& common) {
  return guarded(common, [&](Session& session) {
    if (cycle::isName(name) && !cycle::isReserved(name)) return outcomeOf(session, cycleDraft(name));
    session.diagnostics().report<diag::CycleName>({}, name, cycle::proposeName(name));
    return outcomeOf(session, "");
  });
}

} // namespace dotek::driver
