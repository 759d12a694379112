#include "lint/Run.h"

#include "frontend/macrob/Check.h"
#include "lint/Lathe.h"
#include "lint/NcProgram.h"
#include "support/messages/Common.h"

#include <algorithm>
#include <atomic>
#include <future>
#include <iterator>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace dotek::lint {

void moveInto(Diagnostics& to, Diagnostics& from) {
  const std::vector<Diagnostic>& all = from.all();
  for (Diagnostic& one : from.all()) {
    if (one.code != diag::TooManyFindings::code) {
      // What was found there already gets the notes as well, as it does from a rule.
      std::vector<DiagnosticNote> notes = std::exchange(one.notes, {});
      std::optional<Fix> fix = std::exchange(one.fix, std::nullopt);
      Diagnostic& kept = to.add(std::move(one));
      std::move(notes.begin(), notes.end(), std::back_inserter(kept.notes));
      if (fix) kept.fix = std::move(fix);
      continue;
    }
    // The note that there are more findings counts against the code that it names.
    const auto of = std::find_if(all.begin(), all.end(), [&](const Diagnostic& other) {
      return other.range.file == one.range.file && from.full(other.code, other.range.file) &&
             one.message.find(fmt::format("`{}`", other.code)) != std::string::npos;
    });
    if (of != all.end()) to.add({of->code, one.severity, one.range, one.message, {}, {}});
  }
}

namespace {

// Where the findings of rules go.
struct Findings {
  Diagnostics& shared;
  Diagnostics& separate;
};

// A rule with the member that is set.
template <class Run> struct Chosen {
  Run run;
  const NamedRule* rule;
  bool ofMills;

  Report reportTo(const Findings& to) const {
    return {rule->id, rule->rule->severity, rule->rule->shared ? to.shared : to.separate};
  }
};
template <class Run>
std::vector<Chosen<Run>> chosen(Run Rule::*member, const std::vector<const NamedRule*>& rules) {
  std::vector<Chosen<Run>> out;
  for (const NamedRule* named : rules)
    if (const Run run = named->rule->*member; run != nullptr)
      out.push_back({run, named, isOfMills(named->id)});
  return out;
}

void runParsed(const Project& project, const std::vector<const NamedRule*>& rules, const Lathes& lathes,
               const Findings& to) {
  const auto parsed = chosen(&Rule::parsed, rules);
  if (parsed.empty()) return;
  for (const NcFile& nc : project.programs)
    for (const macrob::Program& program : nc.file->programs) {
      const macrob::CheckedProgram checked(program, project.control, project.sources, project.controls);
      for (const auto& one : parsed) {
        if (one.ofMills && lathes.contains(nc.file)) continue;
        Report report = one.reportTo(to);
        one.run(checked, report);
      }
    }
}

void runChecks(const Project& project, const std::vector<const NamedRule*>& rules, const Findings& to) {
  for (const auto& one : chosen(&Rule::check, rules)) {
    Report report = one.reportTo(to);
    one.run(project, report);
  }
}

// The programs of a project one by one, by whichever thread has time. What is found in each is kept apart, so
// that it does not matter who looked.
class Programs {
public:
  Programs(const Project& project, const std::vector<const NamedRule*>& rules, const Lathes& lathes)
      : all_(programsOf(project)), rules_(chosen(&Rule::program, rules)), lathes_(lathes),
        found_(rules_.empty() ? 0 : all_.size()) {}

  void run() {
    for (std::size_t at = next_++; at < found_.size(); at = next_++) {
      const NcProgram& nc = *all_[at];
      for (const auto& one : rules_) {
        if (one.ofMills && lathes_.contains(&nc.file)) continue;
        Report report = one.reportTo({found_[at].shared, found_[at].separate});
        one.run(nc, report);
      }
    }
  }

  void addTo(const Findings& to) {
    for (Found& one : found_) {
      moveInto(to.shared, one.shared);
      moveInto(to.separate, one.separate);
    }
  }

private:
  struct Found {
    Diagnostics shared, separate;
  };
  const NcPrograms& all_;
  std::vector<Chosen<decltype(Rule::program)>> rules_;
  const Lathes& lathes_;
  std::vector<Found> found_; // by program
  std::atomic<std::size_t> next_ = 0;
};

// A thread costs as much as the rules on some hundred blocks.
bool isLong(const Project& project) {
  constexpr std::size_t kFew = 1000;
  std::size_t blocks = 0;
  for (const NcFile& nc : project.programs)
    for (const macrob::Program& program : nc.file->programs)
      blocks += program.blocks.size();
  return blocks > kFew;
}

// Starts it on another thread; nothing where none is to be had.
template <class Work> std::future<void> startBeside(const Work& work) {
  if (std::thread::hardware_concurrency() < 2) return {};
  try {
    return std::async(std::launch::async, work);
  } catch (const std::system_error&) {
    return {};
  }
}

} // namespace

void runRules(const Project& project, Diagnostics& shared, Diagnostics& separate,
              const std::function<bool(const NamedRule&)>& wanted) {
  std::vector<const NamedRule*> all;
  for (const NamedRule& named : rules())
    if (wanted(named)) all.push_back(&named);
  const Lathes& lathes = lathesOf(project);
  const Findings to{shared, separate};
  Programs programs(project, all, lathes);
  if (!isLong(project)) {
    runParsed(project, all, lathes, to);
    programs.run();
    programs.addTo(to);
    runChecks(project, all, to);
    return;
  }
  // The other thread sees trees, sources and profiles, which nobody changes any more, a CheckedProgram that
  // is its own, and what is Lazy. Rules that look at all inputs stay with this one.
  Diagnostics sharedParsed, separateParsed, sharedChecks, separateChecks;
  const auto parsed = [&] { runParsed(project, all, lathes, {sharedParsed, separateParsed}); };
  std::future<void> beside = startBeside([&] {
    parsed();
    programs.run();
  });
  runChecks(project, all, {sharedChecks, separateChecks});
  programs.run();
  if (beside.valid())
    beside.get();
  else
    parsed();
  moveInto(shared, sharedParsed);
  moveInto(separate, separateParsed);
  programs.addTo(to);
  moveInto(shared, sharedChecks);
  moveInto(separate, separateChecks);
}

} // namespace dotek::lint
