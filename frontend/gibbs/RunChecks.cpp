#include "frontend/gibbs/RunMachine.h"
#include "support/messages/Gibbs.h"

#include <algorithm>
#include <tuple>

namespace dotek::frontend::gibbs {
namespace {

// Variables of waiting paths, all together: bounds memory where a large macro forks often.
constexpr std::size_t kMaxWaitingVariables = 2'000'000;

void addOnce(std::vector<Rejection>& list, const Rejection& item) {
  const bool known = std::any_of(list.begin(), list.end(), [&](const Rejection& other) {
    return other.range == item.range && other.text == item.text;
  });
  if (!known) list.push_back(item);
}

void sortByPlace(std::vector<Rejection>& list) {
  std::stable_sort(list.begin(), list.end(), [](const Rejection& a, const Rejection& b) {
    return std::tie(a.range.file, a.range.begin, a.range.end) <
           std::tie(b.range.file, b.range.begin, b.range.end);
  });
}

class Checks {
public:
  explicit Checks(RunContext& context) : context_(context), machine_(context, Purpose::Checks) {}

  ChecksResult run(const Macro& macro) {
    waiting_.push_back(machine_.start(macro));
    std::size_t paths = 1;
    while (!waiting_.empty()) {
      State state = std::move(waiting_.back());
      waiting_.pop_back();
      waitingVariables_ -= std::min(waitingVariables_, sizeOf(state));
      PathEnd end = machine_.run(state);
      if (end == PathEnd::Ended) end = finish(state);
      if (end == PathEnd::Failed || end == PathEnd::NeedsUser) return notRun();
      if (end == PathEnd::Stopped || end == PathEnd::DialogAgain) reject(state, machine_.place(), end);
      if (end != PathEnd::Asks) continue;
      if (++paths > context_.limits.paths || !follow(std::move(state))) {
        machine_.reportOnce(
            makeDiagnostic<diag::TooManyPaths>(machine_.question().range, context_.limits.paths));
        return notRun();
      }
    }
    return merged();
  }

private:
  static std::size_t sizeOf(const State& state) {
    std::size_t size = state.globals.size() + state.learnt.size() + state.arrays.size();
    for (const Frame& frame : state.frames)
      size += frame.locals.size() + frame.loops.size() + 1;
    return size;
  }

  static ChecksResult notRun() {
    ChecksResult result;
    result.verdict = ChecksResult::Verdict::NotRun;
    return result;
  }

  // Both answers to the open question. false: the waiting paths would take too much memory.
  bool follow(State state) {
    const Question& question = machine_.question();
    for (const Symbol& source : question.sources)
      hosts_.insert(source.name);
    if (question.sources.empty()) open_.push_back({question.range, question.reason});
    State other = state;
    state.learnt[question.key].restrict(question.relation, question.bound);
    other.learnt[question.key].restrict(opposite(question.relation), question.bound);
    waitingVariables_ += sizeOf(state) + sizeOf(other);
    waiting_.push_back(std::move(other));
    waiting_.push_back(std::move(state));
    return waitingVariables_ <= kMaxWaitingVariables;
  }

  PathEnd finish(State& state) {
    const auto code = state.globals.find("CALLBACK_RETURNCODE");
    if (code != state.globals.end()) {
      const auto turnsAway = machine_.isNonZero(state, code->second, state.returnCodeSet);
      if (!turnsAway) return PathEnd::Asks;
      if (*turnsAway) {
        reject(state, state.returnCodeSet, PathEnd::Ended);
        return PathEnd::Ended;
      }
    }
    return pass(state);
  }

  void reject(const State& state, SourceRange place, PathEnd end) {
    ++rejecting_;
    auto messages = machine_.messagesSince(state, state.messageBefore);
    if (messages.empty() && end == PathEnd::Ended) messages = machine_.messagesSince(state, kNoMessage);
    if (!messages.empty() && end == PathEnd::Ended) return addOnce(rejections_, messages.back());
    for (const Rejection& message : messages)
      addOnce(rejections_, message);
    if (messages.empty()) {
      addOnce(rejections_,
              {end == PathEnd::DialogAgain && state.jumped.hasPlace() ? state.jumped : place, ""});
    }
  }

  PathEnd pass(const State& state) {
    ++passing_;
    for (const Rejection& message : machine_.messagesSince(state, kNoMessage))
      addOnce(shown_, message);
    std::map<std::string, double> changed;
    for (const auto& [field, given] : context_.fields) {
      const auto assigned = state.globals.find(field);
      if (assigned == state.globals.end()) continue;
      const Value& value = assigned->second;
      if (const Unknown* unknown = unknownIn(value)) {
        machine_.reportOnce(makeDiagnostic<diag::FieldOpen>(machine_.place(), field, unknownText(*unknown)));
        return PathEnd::Failed;
      }
      const double* number = std::get_if<double>(&value);
      if (number == nullptr || *number == given) continue;
      changed[field] = *number;
      if (const auto set = state.fieldSet.find(field); set != state.fieldSet.end())
        changedAt_[field] = set->second;
    }
    if (passing_ == 1) {
      changed_ = std::move(changed);
    } else if (changed != changed_) {
      const std::string host = hosts_.empty() ? "what the macro asks the CAM" : *hosts_.begin();
      const std::string field = changed.empty() ? changed_.begin()->first : changed.begin()->first;
      machine_.reportOnce(makeDiagnostic<diag::FieldOpen>(machine_.place(), field, host));
      return PathEnd::Failed;
    }
    return PathEnd::Ended;
  }

  ChecksResult merged() {
    ChecksResult result;
    sortByPlace(rejections_);
    sortByPlace(shown_);
    result.rejections = std::move(rejections_);
    result.shown = std::move(shown_);
    for (const auto& [field, value] : changed_)
      result.changedAt.push_back(changedAt_[field]);
    result.changed = std::move(changed_);
    if (rejecting_ == 0) return result;
    result.verdict = ChecksResult::Verdict::Rejected;
    if (passing_ == 0) return result;
    result.verdict = ChecksResult::Verdict::Depends;
    result.neededHosts.assign(hosts_.begin(), hosts_.end());
    for (const auto& [range, reason] : open_) {
      context_.diagnostics.report<diag::ConditionOpen>(range, reason);
    }
    return result;
  }

  RunContext& context_;
  Machine machine_;
  std::vector<State> waiting_;
  std::size_t waitingVariables_ = 0;
  std::set<std::string> hosts_;
  std::vector<std::pair<SourceRange, std::string>> open_;
  std::size_t passing_ = 0;
  std::size_t rejecting_ = 0;
  std::vector<Rejection> rejections_;
  std::vector<Rejection> shown_;
  std::map<std::string, double> changed_;
  std::map<std::string, SourceRange> changedAt_;
};

} // namespace

ChecksResult runChecks(const Macro& cycleData, RunContext& context) {
  return Checks(context).run(cycleData);
}

} // namespace dotek::frontend::gibbs
