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

const gibbs::Macro* calledMacro(const gibbs::Cycle& cycle, const gibbs::CallMacro& call,
                                const Project& project) {
  const auto* name = call.macro ? std::get_if<gibbs::TextLiteral>(&call.macro->node) : nullptr;
  const std::string& file = name != nullptr ? name->text : call.bareName;
  return file.empty() ? nullptr : calledMacro(cycle, file, project);
}

} // namespace dotek::lint
