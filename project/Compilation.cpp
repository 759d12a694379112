#include "project/Compilation.h"

#include "project/Programs.h"

#include "frontend/gibbs/Parse.h"
#include "frontend/macrob/Lower.h"
#include "frontend/macrob/Parse.h"
#include "ir/CycleNames.h"
#include "project/CycleFiles.h"
#include "project/CycleLowering.h"
#include "project/CycleValues.h"
#include "project/Inputs.h"
#include "project/Prog.h"
#include "support/Decimal.h"
#include "support/Files.h"
#include "support/NearestName.h"
#include "support/messages/Commands.h"
#include "support/messages/Sim.h"

#include <algorithm>
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
  const std::vector<const stdlib::DataFile*> files = session_.data().list("controls");
  if (at->second.size() == files.size()) return at->second;
  at->second.clear(); // a dotek.toml has named a file since
  for (const stdlib::DataFile* file : files)
    if (const stdlib::Control* control = session_.control(file->name, probe)) at->second.push_back(*control);
  std::stable_partition(at->second.begin(), at->second.end(),
                        [](const stdlib::Control& one) { return !one.turning; });
  return at->second;
}

LoweringInputs* Compilation::load(const SourceOptions& source, const std::string& control) {
  inputs_ = loadLoweringInputs(source, control, session_, sets_);
  return inputs_ ? &*inputs_ : nullptr;
}

LoweringInputs* Compilation::loadSettings(const SourceOptions& source) {
  inputs_ = project::loadSettings(source, session_, sets_);
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

const macrob::File& Compilation::addPrograms(FileId file, macrob::Forms forms, macrob::Keep keep) {
  const macrob::Text text = textOf(file, session_);
  return programs_.emplace_back(macrob::parse(file, session_.sources(), session_.limits(),
                                              session_.diagnostics(), text, macrob::Reader::Fast, forms,
                                              keep));
}

CycleFolder& Compilation::addFile(const std::string& path) {
  CycleFolder& folder = folders_.emplace_back();
  folder.name = inputName(path);
  cycleFiles_.emplace(&folder, path);
  return folder;
}

const std::string* Compilation::fileOf(const CycleFolder& folder) const {
  const auto found = cycleFiles_.find(&folder);
  return found == cycleFiles_.end() ? nullptr : &found->second;
}

std::optional<LoweredCycle> Compilation::lower(const CycleFolder& folder, Strictness strictness) {
  if (const std::string* file = fileOf(folder)) return lowerFile(*file, {});
  // Fields of a folder are numbers, whatever the cycles beside it take.
  for (const auto& [name, text] : session_.options().set)
    if (!parseNumber(text) && usedSets_.insert(name).second)
      session_.diagnostics().report<diag::NotANumber>({}, "--set", name, text);
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

namespace {

constexpr const char* kApproachFeed = "approach_feed";

// A protected move of the language goes at the approach feed where it states none; a control has no such
// feed.
std::optional<ir::VariableId> approachFeedOf(const ir::Cycle& cycle) {
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id)
    if (cycle.variable(id).role == ir::Role::Host && cycle.variable(id).name == kApproachFeed) return id;
  return std::nullopt;
}

ir::VariableId addApproachFeed(ir::Cycle& cycle) {
  ir::Variable variable;
  variable.name = kApproachFeed;
  variable.kind = ir::Kind::Feed;
  variable.role = ir::Role::Host;
  variable.range = cycle.range;
  return cycle.add(std::move(variable));
}

void giveApproachFeed(ir::Cycle& cycle) {
  std::optional<ir::VariableId> feed = approachFeedOf(cycle);
  for (ir::CycleStatement& statement : cycle.body) {
    auto* move = std::get_if<ir::Move>(&statement.node);
    if (move == nullptr || move->motion != ir::Motion::Protected || move->feed != nullptr) continue;
    if (!feed) feed = addApproachFeed(cycle);
    move->feed = ir::variable(*feed, statement.origin.range());
  }
}

// Calls of programs that take the feed hand it on. true: something was added.
bool handOnApproachFeed(ir::Cycle& cycle, const std::vector<LoweredProgram>& programs) {
  bool out = false;
  for (ir::CycleStatement& statement : cycle.body) {
    auto* call = std::get_if<ir::CallCycle>(&statement.node);
    if (call == nullptr || call->cycle != ir::kProgram) continue;
    const auto argument = [&](std::string_view name) {
      return std::find_if(call->arguments.begin(), call->arguments.end(),
                          [&](const ir::CycleArgument& one) { return one.parameter == name; });
    };
    const auto called = argument(ir::kCalledProgram);
    const double* index = called == call->arguments.end() ? nullptr : ir::constantValue(called->value);
    if (index == nullptr || argument(kApproachFeed) != call->arguments.end() ||
        !approachFeedOf(programs.at(static_cast<std::size_t>(*index)).cycle))
      continue;
    const std::optional<ir::VariableId> own = approachFeedOf(cycle);
    const ir::VariableId feed = own ? *own : addApproachFeed(cycle);
    call->arguments.push_back({kApproachFeed, ir::variable(feed), std::nullopt, ir::Kind::Feed, true});
    out = true;
  }
  return out;
}

void handOnApproachFeed(LoweredCycle& all) {
  for (bool changed = true; changed;) {
    changed = handOnApproachFeed(all.cycle, all.programs);
    for (LoweredProgram& program : all.programs)
      changed = handOnApproachFeed(program.cycle, all.programs) || changed;
  }
}

} // namespace

namespace {

// Values of --set and the job by the names of parameters; what is no number is a literal of the language:
// `18mm`, `G54`. Values that are none are reported.
std::vector<std::pair<std::string, double>> setsOf(const std::string& path, const LoweringInputs& inputs,
                                                   Session& session) {
  std::vector<std::pair<std::string, double>> out = inputs.sets;
  Diagnostics said = std::exchange(session.diagnostics(), Diagnostics());
  CycleFiles files(session);
  const auto* const tree = files.linked(path); // it has been lowered
  session.diagnostics() = std::move(said);
  for (const auto& [name, text] : session.options().set) {
    if (parseNumber(text) || tree == nullptr) continue;
    Diagnostics found;
    const auto values = cycleValues(*tree, {{name, text}}, found);
    const bool twice =
        std::any_of(out.begin(), out.end(), [&, &set = name](const auto& one) { return one.first == set; });
    if (twice) {
      session.diagnostics().report<diag::GivenTwice>({}, "--set", name);
    } else if (const auto value = values.find(name); value != values.end()) {
      out.emplace_back(name, value->second);
    } else {
      for (Diagnostic& one : found.all())
        if (one.code == diag::ParameterValue::code) session.diagnostics().add(std::move(one));
      out.emplace_back(name, 0); // one that the cycle does not have is reported by name
    }
  }
  return out;
}

} // namespace

std::optional<LoweredCycle> Compilation::lowerFile(const std::string& path, const SourceOptions& source) {
  if (!inputs_) {
    takeLiterals();
    if (loadSettings(source) == nullptr) return std::nullopt;
  }
  std::optional<frontend::cycle::Lowered> lowered = lowerCycleFile(path, session_, calls_);
  if (!lowered) return std::nullopt;
  LoweredCycle out;
  out.cycle = std::move(lowered->cycle);
  out.letters = std::move(lowered->letters);
  giveApproachFeed(out.cycle);
  for (frontend::cycle::CalledProgram& one : lowered->programs) {
    LoweredProgram& program = out.programs.emplace_back();
    program.cycle = std::move(one.cycle);
    program.letters = std::move(one.letters);
    program.results = std::move(one.results);
    program.readResults = std::move(one.readResults);
    giveApproachFeed(program.cycle);
  }
  handOnApproachFeed(out);
  for (LoweredProgram& program : out.programs)
    for (ir::VariableId id = 0; id < program.cycle.variables.size(); ++id) {
      const ir::Variable& variable = program.cycle.variable(id);
      const auto given = inputs_->hosts.find(variable.name);
      if (variable.role == ir::Role::Host && !variable.name.starts_with("start_") &&
          given != inputs_->hosts.end())
        program.fixed[id] = given->second;
    }
  std::set<std::string> names;
  const auto sets = setsOf(path, *inputs_, session_);
  for (ir::VariableId id = 0; id < out.cycle.variables.size(); ++id) {
    const ir::Variable& variable = out.cycle.variable(id);
    const auto fix = [&](double value) {
      out.fixed[id] = value;
      out.fixedByName[variable.name] = value;
    };
    if (variable.role == ir::Role::Parameter) {
      names.insert(variable.name);
      for (const auto& [name, value] : sets)
        if (name == variable.name) fix(value);
    }
    if (variable.role != ir::Role::Host) continue;
    if (const auto given = inputs_->hosts.find(variable.name); given != inputs_->hosts.end())
      fix(given->second);
  }
  for (frontend::cycle::CallInPlace& one : lowered->inPlace)
    out.inPlace.push_back({one.range, std::move(one.cycle), std::move(one.why)});
  for (const auto& [name, value] : sets) {
    if (inputs_->oneOfSeveral && !names.contains(name)) continue;
    usedSets_.insert(name); // reported here, once
    if (names.contains(name)) continue;
    const std::string near = nearestName(name, names);
    session_.diagnostics().report<diag::NoSuchField>({}, name, out.cycle.name,
                                                     near.empty() ? "" : "; did you mean `" + near + "`?");
  }
  if (session_.diagnostics().hasErrors()) return std::nullopt;
  return out;
}

std::shared_ptr<const ir::ProgramFile> Compilation::lower(const macrob::File& file,
                                                          const stdlib::Control* control) {
  const auto as = [&](const stdlib::Control& one) -> std::shared_ptr<const ir::ProgramFile> {
    Diagnostics ignored;
    auto program = macrob::lower(file, one, session_.sources(), ignored, macrob::LowerFor::Rules);
    return program ? std::make_shared<const ir::ProgramFile>(std::move(*program)) : nullptr;
  };
  if (control != nullptr) return as(*control);
  for (const stdlib::Control& one : controls(session_.probeCodes()))
    if (auto program = as(one)) return program;
  return nullptr;
}

} // namespace dotek::project
