#include "lint/Shared.h"

namespace dotek::lint {

SharedInputs::SharedInputs(const Project& project) {
  for (const compost::Program* prog : project.progs)
    progs.emplace_back(*prog, project.compostKeywords, project.sources, project.form);
  for (const gibbs::Cycle* cycle : project.cycles)
    cycles.emplace_back(*cycle, project.sources, project.gibbsKeywords);
}

} // namespace dotek::lint
