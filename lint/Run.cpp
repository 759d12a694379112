#include "lint/Run.h"

#include "frontend/macrob/Check.h"
#include "lint/Lathe.h"
#include "lint/NcProgram.h"

#include <algorithm>
#include <future>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace dotek::lint {
namespace {

// Where the findings of rules go.
struct Findings {
  Diagnostics& shared;
  Diagnostics& separate;
};

// Rules with the member that is set, and where their findings go.
template <class Run> struct Chosen {
  Run run;
  Report report;
  bool ofMills;
};
template <class Run>
std::vector<Chosen<Run>> chosen(Run Rule::*member, const std::vector<const NamedRule*>& rules,
                                const Findings& to) {
  std::vector<Chosen<Run>> out;
  for (const NamedRule* named : rules)
    if (const Run run = named->rule->*member; run != nullptr)
      out.push_back({run,
                     Report(named->id, named->rule->severity, named->rule->shared ? to.shared : to.separate),
                     isOfMills(named->id)});
  return out;
}

void runParsed(const Project& project, const std::vector<const NamedRule*>& rules, const Lathes& lathes,
               const Findings& to) {
  auto parsed = chosen(&Rule::parsed, rules, to);
  if (parsed.empty()) return;
  for (const NcFile& nc : project.programs)
    for (const macrob::Program& program : nc.file->programs) {
      const macrob::CheckedProgram checked(program, project.control, project.sources, project.controls);
      for (auto& [run, report, ofMills] : parsed)
        if (!ofMills || !lathes.contains(nc.file)) run(checked, report);
    }
}

void runOthers(const Project& project, const std::vector<const NamedRule*>& rules, const Lathes& lathes,
               const Findings& to) {
  if (auto lowered = chosen(&Rule::program, rules, to); !lowered.empty())
    for (const auto& nc : programsOf(project))
      for (auto& [run, report, ofMills] : lowered)
        if (!ofMills || !lathes.contains(&nc->file)) run(*nc, report);
  for (auto& [run, report, ofMills] : chosen(&Rule::check, rules, to))
    run(project, report);
}

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
  if (!isLong(project)) {
    runParsed(project, all, lathes, to);
    runOthers(project, all, lathes, to);
    return;
  }
  // Rules on what was parsed see one CheckedProgram each, which is theirs, and else what nobody changes any
  // more: trees, sources, profiles. What is computed when first asked for (Analyses, NcProgram) stays with
  // the thread of the others.
  Diagnostics sharedBeside, separateBeside;
  const auto parsed = [&] { runParsed(project, all, lathes, {sharedBeside, separateBeside}); };
  std::future<void> beside = startBeside(parsed);
  runOthers(project, all, lathes, to);
  if (beside.valid())
    beside.get();
  else
    parsed();
  for (const auto& [from, into] : {std::pair{&sharedBeside, &shared}, {&separateBeside, &separate}})
    for (Diagnostic& one : from->all())
      into->add(std::move(one));
}

} // namespace dotek::lint
