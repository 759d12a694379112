#include "targets/Subject.h"

namespace dotek::targets {

bool Translation::madeUp(std::uint32_t line) const {
  return line != 0 && line <= sources.size() && sources[line - 1] && sources[line - 1]->empty();
}

bool Translation::stemsFrom(SourceRange source, std::uint32_t line, const SourceMap& files) const {
  if (!source.hasPlace() || line == 0) return true;
  if (line > sources.size()) return false;
  const auto& from = sources[line - 1];
  return !from || from->contains({files.file(source.file).name(), files.line(source)});
}

} // namespace dotek::targets
