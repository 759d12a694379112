#include "lint/CalledFiles.h"

namespace dotek::lint {

const gibbs::Macro* calledMacro(const gibbs::Cycle& cycle, const std::string& name, const Project& project) {
  const std::string wanted = gibbs::foldCase(name);
  for (const gibbs::Macro* macro : cycle.others) {
    const std::string path = gibbs::foldCase(project.sources.file(macro->file).name());
    const std::size_t slash = path.find_last_of("/\\");
    const std::string file = slash == std::string::npos ? path : path.substr(slash + 1);
    if (file == wanted || file == wanted + ".MAC") return macro;
  }
  return nullptr;
}

} // namespace dotek::lint
