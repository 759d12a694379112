#include "targets/Subject.h"

#include <algorithm>

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

std::vector<Rejection> commonestFirst(const Rejections& rejections) {
  std::vector<Rejection> out;
  for (const auto& [key, one] : rejections)
    out.push_back(one);
  std::stable_sort(out.begin(), out.end(),
                   [](const Rejection& a, const Rejection& b) { return a.count > b.count; });
  return out;
}

} // namespace dotek::targets
