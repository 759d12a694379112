#include "lint/Lathe.h"

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  if (project.control != nullptr && project.control->turning) return;
  for (const NcFile& nc : project.programs)
    if (const auto mark = lathesOf(project).find(nc.file); mark != lathesOf(project).end())
      report.at(
          mark->second.range,
          "this block {}: the program is for a lathe, and no profile of one is named; G90, G92, G10, cycles "
          "and offsets mean something else there than on a machining centre, and nothing is said of them; "
          "variables, jumps and calls are checked as usual; `--control fanuc-0i-tf`, or `control` in "
          "dotek.toml, names a lathe",
          mark->second.what);
}

} // namespace

DOTEK_LINT_RULE(lathe_program){
    .severity = Severity::Note,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
