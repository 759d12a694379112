#include "lint/Shared.h"

namespace dotek::lint {

std::shared_ptr<const SharedInputs> sharedInputs(const Project& project,
                                                 std::vector<const gibbs::CheckedFile*> files) {
  auto shared = std::make_shared<SharedInputs>();
  for (const compost::Program* prog : project.progs)
    shared->progs.emplace_back(*prog, project.compostKeywords, project.sources);
  shared->files = std::move(files);
  for (const gibbs::Cycle* cycle : project.cycles)
    shared->cycles.emplace_back(*cycle, project.sources, project.gibbsKeywords);
  for (const NcFile& nc : project.programs)
    for (const macrob::Program& program : nc.file->programs)
      shared->programs.emplace_back(program, project.control ? &*project.control : nullptr, project.sources);
  return shared;
}

} // namespace dotek::lint
