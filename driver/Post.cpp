#include "frontend/compost/Post.h"
#include "driver/Command.h"
#include "driver/Driver.h"
#include "driver/PostedLimits.h"
#include "frontend/compost/Summary.h"
#include "project/Compilation.h"
#include "project/CycleChecks.h"
#include "project/Fields.h"
#include "project/Prog.h"
#include "support/NearestName.h"
#include "support/messages/Commands.h"

#include <algorithm>
#include <set>

namespace dotek::driver {

namespace compost = frontend::compost;

namespace {

// true: what the routine prints is in branches of other cycles, whatever the values are.
bool testsOtherCyclesOnly(const compost::Program& program, const compost::Routine& routine,
                          const std::string& cycle) {
  if (!compost::branchesOf(program, cycle).empty()) return false;
  return !routine.body.empty() &&
         std::all_of(routine.body.begin(), routine.body.end(), [&](const compost::Statement& statement) {
           const auto* branch = std::get_if<std::unique_ptr<compost::If>>(&statement);
           if (branch == nullptr || !(*branch)->elseBody.empty()) return false;
           const auto cycles = compost::cyclesOf((*branch)->condition);
           return cycles && !cycles->contains(cycle);
         });
}

// An operation with all that the Prog and the macro need to run.
struct Prepared {
  const JobOperation* operation;
  const CycleFolder* folder;
  const compost::Routine* routine;
  std::map<std::string, double> hosts;
  FieldTable fields;
};

// Whether names of macro variables compare equal.
bool sameField(const std::string& a, const std::string& b) {
  return frontend::gibbs::foldCase(a) == frontend::gibbs::foldCase(b);
}

// One command: the parts that every operation needs.
class PostCommand {
public:
  PostCommand(const PostOptions& options, Session& session)
      : options_(options), session_(session), compilation_(session) {}

  Outcome run();

private:
  bool load();
  void prepare(const JobOperation& operation);
  void post(Prepared& prepared, compost::PostRun& run);
  void boundary(const std::optional<std::string>& name, SourceRange where, compost::PostRun& run);
  std::vector<JobOperation> operations();
  const CycleFolder* folderOf(const JobOperation& operation);
  void applySets(const JobOperation& operation, FieldTable& fields, const CycleFolder& folder);
  void reportUnknownSets();
  void checkProgramNumber(const std::vector<compost::PostedLine>& lines);

  const PostOptions& options_;
  Session& session_;
  Compilation compilation_;
  const LoweringInputs* inputs_ = nullptr;
  std::map<std::string, std::string> hints_; // of --set names that a cycle does not know
  std::vector<Prepared> prepared_;
};

bool PostCommand::load() {
  Diagnostics& diagnostics = session_.diagnostics();
  if (options_.folders.empty())
    diagnostics.report<diag::MissingOption>({}, "post", "FOLDER", "the folder of a cycle");
  if (!options_.source.prog) {
    for (const std::string& folder : options_.folders)
      static_cast<void>(settingsOf(folder, session_)); // what is wrong with a `prog` there
    if (!diagnostics.hasErrors())
      diagnostics.report<diag::MissingOption>({}, "post", "--prog PROG.txt or `prog` in dotek.toml",
                                              "the Prog whose routine prints the cycle");
  }
  const NamedTexts& sets = options_.common.set;
  for (const auto& [postField, variable] : options_.common.field) {
    const bool alsoSet = std::any_of(sets.begin(), sets.end(),
                                     [&, &key = postField](const auto& s) { return s.first == key; });
    if (alsoSet && postField != variable)
      diagnostics.report<diag::GivenTwice>({}, "--set beside --field", postField);
  }
  if (options_.source.cycle && options_.folders.size() > 1) diagnostics.report<diag::CycleWithSeveral>({});
  inputs_ = compilation_.loadSettings(options_.source);
  if (inputs_ == nullptr) return false;
  for (const std::string& path : options_.folders)
    compilation_.addFolder(path);
  const std::deque<CycleFolder>& folders = compilation_.folders();
  if (options_.source.cycle) compilation_.folders().front().name = *options_.source.cycle;
  for (std::size_t i = 0; i < folders.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (folders[i].name == folders[k].name) diagnostics.report<diag::CycleNameTwice>({}, folders[i].name);
    }
  }
  const bool read = compilation_.loadProg(options_.source);
  if (inputs_->program) leaveFindingsToLint(session_);
  return read && !diagnostics.hasErrors();
}

std::vector<JobOperation> PostCommand::operations() {
  if (inputs_->job && !inputs_->job->operations.empty()) return inputs_->job->operations;
  std::vector<JobOperation> out;
  for (const CycleFolder& folder : compilation_.folders()) {
    JobOperation one;
    one.cycle = folder.name;
    one.cycleRange = {folder.place, 0, 0};
    out.push_back(std::move(one));
  }
  return out;
}

const CycleFolder* PostCommand::folderOf(const JobOperation& operation) {
  std::vector<std::string> names;
  for (const CycleFolder& folder : compilation_.folders()) {
    if (folder.name == operation.cycle) return &folder;
    names.push_back(folder.name);
  }
  const std::string near = nearestName(operation.cycle, names);
  session_.diagnostics().report<diag::CycleNotGiven>(operation.cycleRange, operation.cycle,
                                                     near.empty() ? "" : "; did you mean `" + near + "`?");
  return nullptr;
}

void PostCommand::applySets(const JobOperation& operation, FieldTable& fields, const CycleFolder& folder) {
  const auto once = [&](std::set<std::string>& seen, const std::string& name, SourceRange where,
                        std::string_view flag) {
    const std::string key = fields.declares(name) ? frontend::gibbs::foldCase(name) : name;
    if (!seen.insert(key).second) session_.diagnostics().report<diag::GivenTwice>(where, flag, name);
  };
  std::set<std::string> inJob;
  std::set<std::string> inFlags;
  for (const auto& [name, value] : inputs_->sets)
    once(inFlags, name, {}, "--set");
  for (const auto& [name, value, where] : operation.set) {
    once(inJob, name, where, "set");
    const bool flagWins = std::any_of(inputs_->sets.begin(), inputs_->sets.end(),
                                      [&, &key = name](const auto& s) { return sameField(s.first, key); });
    if (flagWins || fields.set(name, value, where)) continue;
    session_.diagnostics().report<diag::NoSuchField>(where, name, folder.name, fields.hint(name));
  }
  for (const auto& [name, value] : inputs_->sets) {
    if (fields.set(name, value, {}))
      compilation_.usedSets().insert(name);
    else
      hints_.emplace(name, fields.hint(name));
  }
}

// Looks up all that an operation needs, so that what the command line got wrong is said before any run.
void PostCommand::prepare(const JobOperation& operation) {
  const CycleFolder* folder = folderOf(operation);
  if (folder == nullptr) return;
  const compost::Routine* routine =
      chooseRoutine(*inputs_->program, inputs_->routine, inputs_->routineAt, folder->name, session_);
  if (routine == nullptr) {
    for (const auto& set : inputs_->sets)
      compilation_.usedSets().insert(set.first); // one finding for one cause
    for (const auto& [postField, variable] : options_.common.field)
      compilation_.usedSets().insert(postField + "=" + variable);
    return;
  }

  if (testsOtherCyclesOnly(*inputs_->program, *routine, folder->name)) {
    session_.diagnostics().report<diag::NothingPosted>(routine->nameRange, routine->name, folder->name,
                                                       testedCycles(*inputs_->program, folder->name));
    return;
  }

  std::map<std::string, double> hosts = inputs_->givenHosts;
  hosts.insert(operation.hosts.begin(), operation.hosts.end());
  hosts.insert(inputs_->hosts.begin(), inputs_->hosts.end());

  std::vector<std::string> printed;
  for (const compost::FieldRef& field : compost::fieldsPrinted(*inputs_->program, *routine, folder->name))
    printed.push_back(field.name);
  FieldTable fields(*folder, std::move(printed), session_);
  applySets(operation, fields, *folder);
  const bool mapped = fields.mapGiven(compilation_.folders().size() > 1, compilation_.usedSets());
  if (mapped && fields.certain())
    prepared_.push_back({&operation, folder, routine, std::move(hosts), std::move(fields)});
}

void PostCommand::post(Prepared& prepared, compost::PostRun& run) {
  std::vector<std::pair<double, double>> points = prepared.operation->at;
  const bool anywhere = points.empty();
  if (anywhere) points.emplace_back(0.0, 0.0);
  std::map<std::string, double>& hosts = prepared.hosts;
  for (const auto& [x, y] : points) {
    if (!anywhere) {
      const std::map<std::string, double>& given = inputs_->givenHosts;
      hosts.insert_or_assign("start_x", given.contains("start_x") ? given.at("start_x") : x);
      hosts.insert_or_assign("start_y", given.contains("start_y") ? given.at("start_y") : y);
    }
    // The macro of the dialog runs once for an operation: what it changes does not add up over the points.
    FieldTable fields = prepared.fields;
    runCycleChecks(*prepared.folder, fields, hosts, session_);
    compost::Operation now;
    now.cycle = prepared.folder->name;
    now.hosts = hosts;
    now.field = [&fields](const std::string& name, SourceRange where) { return fields.value(name, where); };
    const std::size_t before = run.lineCount();
    run.run(*prepared.routine, now);
    if (run.lineCount() == before && !session_.diagnostics().hasErrors())
      session_.diagnostics().report<diag::NothingPosted>(
          prepared.routine->nameRange, prepared.routine->name, prepared.folder->name,
          testedCycles(*inputs_->program, prepared.folder->name));
  }
}

void PostCommand::boundary(const std::optional<std::string>& name, SourceRange where, compost::PostRun& run) {
  if (!name) return;
  const compost::Routine* routine = chooseRoutine(*inputs_->program, name, where, "", session_);
  if (routine == nullptr) return;
  compost::Operation none;
  none.hosts = inputs_->hosts;
  none.field = [this](const std::string& field, SourceRange at) -> std::optional<double> {
    session_.diagnostics().report<diag::FieldOutsideOperation>(at, field);
    return std::nullopt;
  };
  run.run(*routine, none);
}

void PostCommand::reportUnknownSets() {
  std::string cycles;
  for (const CycleFolder& folder : compilation_.folders())
    cycles += (cycles.empty() ? "" : ", ") + folder.name;
  if (compilation_.folders().size() > 1)
    reportUnknownPairs(options_.common, compilation_.usedSets(), cycles, session_.diagnostics());
  for (const auto& [name, value] : inputs_->sets) {
    if (compilation_.usedSets().contains(name)) continue;
    const auto hint = hints_.find(name);
    session_.diagnostics().report<diag::NoSuchField>(SourceRange{}, name, cycles,
                                                     hint == hints_.end() ? "" : hint->second);
  }
}

// The job states the O number, the Prog prints it: a difference is a program stored under a wrong number.
void PostCommand::checkProgramNumber(const std::vector<compost::PostedLine>& lines) {
  const std::optional<Job>& job = inputs_->job;
  if (!job || !job->number) return;
  const std::string number = std::to_string(*job->number);
  const bool printed = std::any_of(lines.begin(), lines.end(), [&](const compost::PostedLine& line) {
    const std::size_t o = line.text.find_first_not_of(" ");
    if (o == std::string::npos || (line.text[o] != 'O' && line.text[o] != ':')) return false;
    const std::size_t digits = std::min(line.text.find_first_not_of('0', o + 1), line.text.size());
    const std::size_t end = std::min(line.text.find_first_not_of("0123456789", digits), line.text.size());
    return line.text.substr(digits, end - digits) == number;
  });
  if (!printed) session_.diagnostics().report<diag::ProgramNumberNotPrinted>(job->numberRange, "O" + number);
}

Outcome PostCommand::run() {
  if (!load()) {
    keepStrongest(session_.diagnostics());
    return outcomeOf(session_, "");
  }
  compost::PostSettings settings{session_.sources(), *inputs_->form, session_.limits(),
                                 options_.common.assume};
  const std::optional<Job>& job = inputs_->job;
  const auto sequence = options_.sequence || !job ? options_.sequence : job->sequence;
  if (sequence) {
    settings.sequenceStart = sequence->first;
    settings.sequenceStep = sequence->second;
  }
  const std::vector<JobOperation> all = operations();
  for (const JobOperation& one : all)
    prepare(one);
  if (prepared_.size() == all.size()) reportUnknownSets();
  if (session_.diagnostics().hasErrors()) return outcomeOf(session_, "");
  compost::PostRun run(*inputs_->program, settings, session_.diagnostics());
  if (job) boundary(job->startRoutine, job->startRange, run);
  for (Prepared& one : prepared_)
    post(one, run);
  if (job) boundary(job->endRoutine, job->endRange, run);
  const std::vector<compost::PostedLine> lines = run.finish();
  checkProgramNumber(lines);
  reportLimits(lines, session_);
  keepStrongest(session_.diagnostics());
  std::string out;
  for (const compost::PostedLine& line : lines)
    out += line.text + "\n";
  return outcomeOf(session_, std::move(out));
}

} // namespace

Outcome post(const PostOptions& options) {
  return guarded(options.common, options.folders,
                 [&](Session& session) { return PostCommand(options, session).run(); });
}

} // namespace dotek::driver
