#include "project/Compilation.h"

#include "project/Programs.h"

#include "frontend/gibbs/Parse.h"
#include "frontend/macrob/Lower.h"
#include "frontend/macrob/Parse.h"
#include "project/Prog.h"
#include "support/Files.h"

#include <utility>

namespace dotek::project {

namespace compost = frontend::compost;
namespace gibbs = frontend::gibbs;
namespace macrob = frontend::macrob;

namespace {

gibbs::ParseContext contextOf(Session& session) {
  return {session.sources(), session.gibbsKeywords(), session.limits(), session.diagnostics()};
}

} // namespace

const std::vector<stdlib::Control>& Compilation::controls(const stdlib::ProbeCodes& probe) {
  const auto [at, isNew] = controls_.try_emplace(probe);
  if (!isNew) return at->second;
  for (const stdlib::DataFile* file : session_.data().list("controls"))
    if (const stdlib::Control* control = session_.control(file->name, probe)) at->second.push_back(*control);
  return at->second;
}

LoweringInputs* Compilation::load(const SourceOptions& source, const std::string& control) {
  inputs_ = loadLoweringInputs(source, control, session_);
  return inputs_ ? &*inputs_ : nullptr;
}

LoweringInputs* Compilation::loadSettings(const SourceOptions& source) {
  inputs_ = project::loadSettings(source, session_);
  return inputs_ ? &*inputs_ : nullptr;
}

bool Compilation::loadProg(const SourceOptions& source) {
  return loadProgInto(*inputs_, source, session_);
}

const compost::Program* Compilation::addProg(const std::string& path, bool checked) {
  std::optional<compost::Program> program = project::loadProg(path, session_, checked);
  if (!program) return nullptr;
  return progs_.emplace_back(std::make_shared<const compost::Program>(std::move(*program))).get();
}

CycleFolder& Compilation::addFolder(const std::string& path, bool checked) {
  return folders_.emplace_back(loadCycleFolder(path, session_, checked));
}

const gibbs::Macro& Compilation::addMacro(FileId file) {
  return macros_.emplace_back(gibbs::parseMacro(file, contextOf(session_)));
}

const gibbs::Dialog& Compilation::addDialog(FileId file) {
  return dialogs_.emplace_back(gibbs::parseDialog(file, contextOf(session_)));
}

const gibbs::DefineData& Compilation::addDefineData(FileId file) {
  return defines_.emplace_back(gibbs::parseDefineData(file, contextOf(session_)));
}

const macrob::File& Compilation::addPrograms(FileId file) {
  const macrob::Text text = textOf(file, session_);
  return programs_.emplace_back(
      macrob::parse(file, session_.sources(), session_.limits(), session_.diagnostics(), text));
}

std::optional<LoweredCycle> Compilation::lower(const CycleFolder& folder, Strictness strictness) {
  return lowerCycle(folder, *inputs_, usedSets_, session_, strictness);
}

std::optional<LoweredCycle> Compilation::lower(const CycleFolder& folder,
                                               std::shared_ptr<const compost::Program> prog,
                                               const compost::Routine& routine, Strictness strictness) {
  const auto program = std::exchange(inputs_->program, std::move(prog));
  const auto named = std::exchange(inputs_->routine, routine.name);
  std::optional<LoweredCycle> out = lower(folder, strictness);
  inputs_->program = program;
  inputs_->routine = named;
  return out;
}

std::shared_ptr<const ir::ProgramFile> Compilation::lower(const macrob::File& file,
                                                          const stdlib::Control* control) {
  const auto as = [&](const stdlib::Control& one) -> std::shared_ptr<const ir::ProgramFile> {
    Diagnostics ignored;
    auto program = macrob::lower(file, one, session_.sources(), ignored);
    return program ? std::make_shared<const ir::ProgramFile>(std::move(*program)) : nullptr;
  };
  if (control != nullptr) return as(*control);
  for (const stdlib::Control& one : controls(session_.probeCodes()))
    if (auto program = as(one)) return program;
  return nullptr;
}

} // namespace dotek::project
