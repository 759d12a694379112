#include "targets/ReadBack.h"

#include "frontend/macrob/Lower.h"
#include "frontend/macrob/Parse.h"

namespace dotek::targets {

namespace macrob = frontend::macrob;

std::optional<ir::ProgramFile> readBack(const std::string& name, std::string text,
                                        const stdlib::Control& control, const Limits& limits,
                                        SourceMap& sources, Diagnostics& found) {
  const FileId id = sources.add(SourceFile(name, std::move(text), Encoding::Utf8));
  const macrob::File tree = macrob::parse(id, sources, limits, found);
  if (found.hasErrors()) return std::nullopt;
  return macrob::lower(tree, control, sources, found);
}

std::string firstError(const Diagnostics& found) {
  for (const Diagnostic& one : found.all())
    if (one.severity == Severity::Error) return one.message;
  return "no reason is given";
}

} // namespace dotek::targets
