#include "lint/Run.h"

#include "lint/Lathe.h"
#include "lint/NcProgram.h"
#include "lint/Shared.h"

#include <algorithm>
#include <set>
#include <vector>

namespace dotek::lint {
namespace {

// Rules with the member that is set, and where their findings go.
template <class Run> struct Chosen {
  Run run;
  Report report;
  bool ofMills;
};
template <class Run>
std::vector<Chosen<Run>> chosen(Run Rule::*member, const std::vector<const NamedRule*>& rules,
                                Diagnostics& diagnostics) {
  std::vector<Chosen<Run>> out;
  for (const NamedRule* named : rules)
    if (const Run run = named->rule->*member; run != nullptr)
      out.push_back({run, Report(named->id, named->rule->severity, diagnostics), isOfMills(named->id)});
  return out;
}

} // namespace

void runRules(const Project& project, Diagnostics& diagnostics,
              const std::function<bool(const NamedRule&)>& wanted) {
  std::vector<const NamedRule*> all;
  for (const NamedRule& named : rules())
    if (wanted(named)) all.push_back(&named);

  const std::set<const macrob::File*> lathes = latheFiles(project);

  if (auto parsed = chosen(&Rule::parsed, all, diagnostics); !parsed.empty())
    for (const NcFile& nc : project.programs)
      for (const macrob::Program& program : nc.file->programs) {
        const macrob::CheckedProgram checked(program, project.control, project.sources, project.controls);
        for (auto& [run, report, ofMills] : parsed)
          if (!ofMills || !lathes.contains(nc.file)) run(checked, report);
      }
  if (auto lowered = chosen(&Rule::program, all, diagnostics); !lowered.empty())
    eachProgram(project, [&](const ir::Program& program, const macrob::File& file) {
      const NcProgram nc(project, program, file);
      for (auto& [run, report, ofMills] : lowered)
        if (!ofMills || !lathes.contains(&file)) run(nc, report);
    });
  for (auto& [run, report, ofMills] : chosen(&Rule::check, all, diagnostics))
    run(project, report);
}

} // namespace dotek::lint
