#include "sim/run/SimMacros.h"

#include "project/MacroCycles.h"
#include "project/Programs.h"
#include "sim/machine/Arguments.h"
#include "sim/machine/Machine.h"
#include "stdlib/MovedSet.h"
#include "stdlib/ReadCall.h"
#include "support/Ascii.h"
#include "support/Files.h"
#include "support/messages/Commands.h"
#include "support/messages/Sim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <map>

namespace dotek::sim {
namespace {

// Numbers that the programs call and that none of them has.
std::set<std::uint32_t> missing(const ProgramLibrary& library) {
  std::set<std::uint32_t> out;
  const std::vector<const ir::Program*> programs = library.programs();
  for (const ir::Program* program : programs) {
    for (const ir::ProgramStatement& statement : program->body) {
      const auto* call = std::get_if<ir::Call>(&statement.node);
      const double* number = call != nullptr && call->program ? ir::constantValue(call->program) : nullptr;
      if (number != nullptr && *number >= 1 && *number < 1e8)
        out.insert(static_cast<std::uint32_t>(std::lround(*number)));
    }
  }
  for (const ir::Program* program : programs)
    if (program->number <= UINT32_MAX) out.erase(static_cast<std::uint32_t>(program->number));
  return out;
}

// By its name it was put aside before a change.
bool isCopy(const std::string& name) {
  const std::string upper = upperCase(name);
  constexpr std::array<std::string_view, 5> kEnds = {".BAK", ".OLD", ".ORG", ".ORIG", "~"};
  return std::any_of(kEnds.begin(), kEnds.end(), [&](std::string_view end) { return upper.ends_with(end); });
}

// A program of the user's own lies beside the one that calls its number, and the meaning of a set runs.
void noteOwnPrograms(const std::set<std::uint32_t>& called, const std::vector<const stdlib::MacroSet*>& sets,
                     const ProgramLibrary& library, Session& session) {
  namespace fs = std::filesystem;
  const fs::path main(library.mainPath());
  const fs::path folder = main.has_parent_path() ? main.parent_path() : fs::path(".");
  std::map<std::uint64_t, std::pair<bool, std::string>> beside; // a name that is no copy's first
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    const std::uint64_t number = project::numberOfName(name);
    if (number == 0 || name == main.filename()) continue;
    std::pair<bool, std::string> found{isCopy(name), (folder / name).lexically_normal().string()};
    const auto [known, isNew] = beside.try_emplace(number, found);
    if (!isNew) known->second = std::min(known->second, found);
  }
  for (const std::uint32_t program : called) {
    const auto own = beside.find(program);
    if (own == beside.end()) continue;
    const auto set = std::find_if(sets.begin(), sets.end(),
                                  [&](const stdlib::MacroSet* one) { return one->calls(program); });
    if (set != sets.end())
      session.diagnostics().report<diag::OwnProgramBeside>({}, program, (*set)->title, own->second.second,
                                                           folder.lexically_normal().string());
  }
}

} // namespace

std::unique_ptr<SimMacros> SimMacros::load(const std::optional<std::string>& chosen, bool all,
                                           const stdlib::Control& control, ProgramLibrary& library,
                                           Session& session) {
  auto out = std::make_unique<SimMacros>();
  const std::set<std::uint32_t> called = missing(library);
  if (called.empty() && !chosen && !all) return out;
  for (const stdlib::MacroSet& set : session.macroSets(&control))
    if (!chosen || set.name == *chosen) out->sets_.push_back(&set);
  if (chosen && out->sets_.empty())
    if (const stdlib::MacroSet* moved = session.macroSet(*chosen, &control)) out->sets_.push_back(moved);
  if (chosen && out->sets_.empty()) {
    project::reportUnknownMacroSet(*chosen, session);
    return nullptr;
  }
  noteOwnPrograms(called, out->sets_, library, session);
  const auto isCalled = [&](const stdlib::MacroSet* set) {
    return std::any_of(called.begin(), called.end(),
                       [&](std::uint32_t program) { return set->calls(program); });
  };
  std::vector<const stdlib::MacroSet*> meant; // that run by their meaning
  for (const stdlib::MacroSet* set : out->sets_) {
    const std::optional<std::string> text = stdlib::macroText(session.data(), set->name);
    if (!text) {
      if (isCalled(set)) meant.push_back(set);
      out->meanings_.emplace_back(*set, control, out->cycles_);
      continue;
    }
    if (!isCalled(set)) continue;
    const std::optional<FileId> id = addText("macrob/" + set->name + ".nc", *text, Encoding::Utf8,
                                             std::nullopt, session.sources(), session.diagnostics());
    std::optional<ir::ProgramFile> file;
    if (id) file = loadPrograms(*id, control, session);
    if (!file) return nullptr;
    library.addCallable(std::move(*file), session);
    for (const std::uint32_t program : called)
      if (set->calls(program)) out->texts_.insert(program);
  }
  out->cycles_ = project::measuringCycles(meant, session);
  return out;
}

std::optional<PathKind> SimMacros::kindOf(std::uint32_t program, std::span<const double> locals) const {
  const std::string letters = givenLetters(locals).letters;
  std::optional<PathKind> out;
  for (const stdlib::MacroSet* set : sets_) {
    if (!set->calls(program)) continue;
    const stdlib::MacroSignature* const signature = stdlib::readCall(*set, program, letters).signature;
    const bool moves = signature != nullptr && signature->intent == stdlib::Intent::ProtectedMove;
    if (!out || moves) out = moves ? PathKind::Protected : PathKind::Measuring;
  }
  return out;
}

std::optional<Measurement> SimMacros::foundBy(std::uint32_t program, std::span<const double> locals,
                                              const Machine& machine) const {
  if (texts_.count(program) == 0) return std::nullopt;
  for (const stdlib::MacroSet* set : sets_) {
    if (!set->calls(program)) continue;
    const stdlib::MacroSignature* const signature =
        stdlib::readCall(*set, program, givenLetters(locals).letters).signature;
    if (signature == nullptr || signature->intent == stdlib::Intent::ProtectedMove) continue;
    std::map<stdlib::Output, double> found;
    for (const stdlib::MacroResult& result : signature->results)
      if (result.documented) found[result.output] = machine.common(result.variable);
    return measurementOf(*signature, locals, found);
  }
  return std::nullopt;
}

void SimMacros::setStylusRadius(double radius) {
  for (VendorMacros& one : meanings_)
    one.setStylusRadius(radius);
}

bool SimMacros::knows(std::uint32_t program) const {
  return std::any_of(meanings_.begin(), meanings_.end(),
                     [&](const VendorMacros& one) { return one.knows(program); });
}

bool SimMacros::run(Machine& machine, std::uint32_t program, std::span<const double> locals) {
  VendorMacros* found = nullptr;
  for (VendorMacros& one : meanings_) {
    if (!one.knows(program)) continue;
    if (found != nullptr)
      return machine.inconclusive(
          fmt::format("several sets of probing macros have O{}; `--probe-macros SET` says which", program));
    found = &one;
  }
  return found->run(machine, program, locals);
}

} // namespace dotek::sim
