#include "frontend/compost/Post.h"
#include "driver/CycleFolder.h"
#include "driver/Driver.h"
#include "driver/Fields.h"
#include "driver/Hosts.h"
#include "driver/Job.h"
#include "driver/PostChecks.h"
#include "driver/PostProgram.h"
#include "driver/Session.h"
#include "frontend/compost/Summary.h"
#include "support/Decimal.h"
#include "support/NearestName.h"

#include <algorithm>
#include <set>

namespace dotek::driver {

namespace compost = frontend::compost;

namespace {

// One command: the parts that every operation needs.
class PostCommand {
public:
  PostCommand(const PostOptions& options, Session& session) : options_(options), session_(session) {}

  Outcome run();

private:
  bool load();
  void operation(const JobOperation& operation, compost::PostRun& run);
  void boundary(const std::optional<std::string>& name, SourceRange where, compost::PostRun& run);
  std::vector<JobOperation> operations() const;
  const CycleFolder* folderOf(const JobOperation& operation);
  void applySets(const JobOperation& operation, FieldTable& fields, const CycleFolder& folder);
  void reportUnknownSets();
  void checkProgramNumber(const std::vector<compost::PostedLine>& lines);

  const PostOptions& options_;
  Session& session_;
  std::map<std::string, double> flagHosts_;
  std::vector<std::pair<std::string, double>> sets_;
  std::set<std::string> usedSets_;
  std::map<std::string, std::string> nearSets_;
  std::optional<Job> job_;
  std::optional<stdlib::Form> form_;
  std::optional<compost::Program> program_;
  std::vector<CycleFolder> folders_;
};

bool PostCommand::load() {
  Diagnostics& diagnostics = session_.diagnostics();
  const CommonOptions& common = options_.common;
  flagHosts_ = parseHosts(common.host, diagnostics);
  for (const auto& [name, text] : common.set) {
    const std::optional<double> value = parseNumber(text);
    const bool twice =
        std::any_of(sets_.begin(), sets_.end(), [&, &key = name](const auto& s) { return s.first == key; });
    if (!value)
      diagnostics.report<diag::NotANumber>({}, "--set", name, text);
    else if (twice)
      diagnostics.report<diag::GivenTwice>({}, "--set", name);
    else
      sets_.emplace_back(name, *value);
  }
  if (options_.folders.empty())
    diagnostics.report<diag::MissingOption>({}, "post", "FOLDER", "the folder of a cycle");
  if (!options_.source.prog)
    diagnostics.report<diag::MissingOption>({}, "post", "--prog PROG.txt",
                                            "the Prog whose routine prints the cycle");
  if (options_.source.cycle && options_.folders.size() > 1) diagnostics.report<diag::CycleWithSeveral>({});
  if (common.job) job_ = loadJob(*common.job, common.limits, session_.sources(), diagnostics);
  form_ = session_.form(options_.source.form);
  if (diagnostics.hasErrors()) return false;
  for (const std::string& path : options_.folders)
    folders_.push_back(loadCycleFolder(path, session_));
  if (options_.source.cycle) folders_.front().name = *options_.source.cycle;
  for (std::size_t i = 0; i < folders_.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (folders_[i].name == folders_[k].name)
        diagnostics.report<diag::CycleNameTwice>({}, folders_[i].name);
    }
  }
  program_ = loadProg(*options_.source.prog, session_);
  return program_ && !diagnostics.hasErrors();
}

std::vector<JobOperation> PostCommand::operations() const {
  if (job_) return job_->operations;
  std::vector<JobOperation> out;
  for (const CycleFolder& folder : folders_) {
    JobOperation one;
    one.cycle = folder.name;
    one.cycleRange = {folder.place, 0, 0};
    out.push_back(std::move(one));
  }
  return out;
}

const CycleFolder* PostCommand::folderOf(const JobOperation& operation) {
  std::vector<std::string> names;
  for (const CycleFolder& folder : folders_) {
    if (folder.name == operation.cycle) return &folder;
    names.push_back(folder.name);
  }
  const std::string near = nearestName(operation.cycle, names);
  session_.diagnostics().report<diag::CycleNotGiven>(operation.cycleRange, operation.cycle,
                                                     near.empty() ? "" : "; did you mean `" + near + "`?");
  return nullptr;
}

void PostCommand::applySets(const JobOperation& operation, FieldTable& fields, const CycleFolder& folder) {
  for (const auto& [name, value] : operation.set) {
    const bool flagWins =
        std::any_of(sets_.begin(), sets_.end(), [&, &key = name](const auto& s) { return s.first == key; });
    if (flagWins || fields.set(name, value, operation.range)) continue;
    const std::string near = fields.nearest(name);
    session_.diagnostics().report<diag::NoSuchField>(operation.range, name, folder.name,
                                                     near.empty() ? "" : "; did you mean `" + near + "`?");
  }
  for (const auto& [name, value] : sets_) {
    if (fields.set(name, value, {}))
      usedSets_.insert(name);
    else if (const std::string near = fields.nearest(name); !near.empty())
      nearSets_.emplace(name, near);
  }
}

void PostCommand::operation(const JobOperation& operation, compost::PostRun& run) {
  const CycleFolder* folder = folderOf(operation);
  if (folder == nullptr) return;
  const std::optional<std::string>& named = options_.source.routine ? options_.source.routine
                                            : job_                  ? job_->operationRoutine
                                                                    : options_.source.routine;
  const SourceRange namedAt = !options_.source.routine && job_ ? job_->operationRange : SourceRange{};
  const compost::Routine* routine = chooseRoutine(*program_, named, namedAt, folder->name, session_);
  if (routine == nullptr) return;

  std::map<std::string, double> hosts = flagHosts_;
  hosts.insert(operation.hosts.begin(), operation.hosts.end());
  if (job_) hosts.insert(job_->hosts.begin(), job_->hosts.end());

  std::vector<std::string> printed;
  for (const compost::BranchRef& branch : compost::branchesOf(*program_, folder->name)) {
    for (const compost::FieldRef& field : compost::fieldsPrinted(*program_, branch, folder->name))
      printed.push_back(field.name);
  }
  FieldTable fields(*folder, std::move(printed), session_);
  applySets(operation, fields, *folder);
  for (const auto& [postField, variable] : options_.common.field)
    fields.map(postField, variable);

  std::vector<std::pair<double, double>> points = operation.at;
  const bool anywhere = points.empty();
  if (anywhere) points.emplace_back(0.0, 0.0);
  for (const auto& [x, y] : points) {
    if (!anywhere) {
      hosts.insert_or_assign("start_x", flagHosts_.contains("start_x") ? flagHosts_.at("start_x") : x);
      hosts.insert_or_assign("start_y", flagHosts_.contains("start_y") ? flagHosts_.at("start_y") : y);
    }
    runCycleChecks(*folder, fields, hosts, session_);
    compost::Operation now;
    now.cycle = folder->name;
    now.hosts = hosts;
    now.field = [&fields](const std::string& name, SourceRange where) { return fields.value(name, where); };
    const std::size_t before = run.lineCount();
    run.run(*routine, now);
    if (run.lineCount() == before && !session_.diagnostics().hasErrors())
      session_.diagnostics().report<diag::NothingPosted>(routine->nameRange, routine->name, folder->name);
  }
}

void PostCommand::boundary(const std::optional<std::string>& name, SourceRange where, compost::PostRun& run) {
  if (!name) return;
  const compost::Routine* routine = chooseRoutine(*program_, name, where, "", session_);
  if (routine == nullptr) return;
  compost::Operation none;
  none.hosts = flagHosts_;
  none.hosts.insert(job_->hosts.begin(), job_->hosts.end());
  none.field = [this](const std::string& field, SourceRange at) -> std::optional<double> {
    session_.diagnostics().report<diag::FieldOutsideOperation>(at, field);
    return std::nullopt;
  };
  run.run(*routine, none);
}

void PostCommand::reportUnknownSets() {
  for (const auto& [name, value] : sets_) {
    if (usedSets_.contains(name)) continue;
    std::string cycles;
    for (const CycleFolder& folder : folders_)
      cycles += (cycles.empty() ? "" : ", ") + folder.name;
    const auto near = nearSets_.find(name);
    session_.diagnostics().report<diag::NoSuchField>(
        SourceRange{}, name, cycles, near == nearSets_.end() ? "" : "; did you mean `" + near->second + "`?");
  }
}

// The job states the O number, the Prog prints it: a difference is a program stored under a wrong number.
void PostCommand::checkProgramNumber(const std::vector<compost::PostedLine>& lines) {
  if (!job_ || !job_->number) return;
  const std::string word = "O" + std::to_string(*job_->number);
  const bool printed = std::any_of(lines.begin(), lines.end(), [&](const compost::PostedLine& line) {
    const std::size_t at = line.text.find(word);
    if (at == std::string::npos) return false;
    const char next = at + word.size() < line.text.size() ? line.text[at + word.size()] : ' ';
    return next < '0' || next > '9';
  });
  if (!printed) session_.diagnostics().report<diag::ProgramNumberNotPrinted>({job_->file, 0, 0}, word);
}

Outcome PostCommand::run() {
  if (!load()) return session_.finish("");
  compost::PostSettings settings{session_.sources(), *form_, session_.limits(), options_.common.assume};
  const auto sequence = options_.sequence ? options_.sequence : job_ ? job_->sequence : options_.sequence;
  if (sequence) {
    settings.sequenceStart = sequence->first;
    settings.sequenceStep = sequence->second;
  }
  compost::PostRun run(*program_, settings, session_.diagnostics());
  if (job_) boundary(job_->startRoutine, job_->startRange, run);
  for (const JobOperation& one : operations())
    operation(one, run);
  if (job_) boundary(job_->endRoutine, job_->endRange, run);
  reportUnknownSets();
  const std::vector<compost::PostedLine> lines = run.finish();
  checkProgramNumber(lines);
  std::string out;
  for (const compost::PostedLine& line : lines)
    out += line.text + "\n";
  return session_.finish(std::move(out));
}

} // namespace

Outcome post(const PostOptions& options) {
  return guarded(options.common, [&](Session& session) { return PostCommand(options, session).run(); });
}

} // namespace dotek::driver
