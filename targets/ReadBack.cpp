#include "targets/ReadBack.h"

#include "frontend/macrob/Lower.h"
#include "frontend/macrob/Parse.h"
#include "support/messages/Commands.h"

namespace dotek::targets {

namespace macrob = frontend::macrob;

std::optional<ir::ProgramFile> readBack(const std::string& name, std::string text,
                                        const stdlib::Control& control, const Limits& limits,
                                        SourceMap& sources, Diagnostics& found) {
  const FileId id = sources.add(SourceFile(name, std::move(text), Encoding::Utf8));
  const macrob::File tree = macrob::parse(id, sources, limits, found);
  if (found.hasErrors()) return std::nullopt;
  auto out = macrob::lower(tree, control, sources, found);
  if (!out || !out->programs.empty()) return out;
  found.report<diag::NoProgram>({}, name, "compared");
  return std::nullopt;
}

std::string firstError(const Diagnostics& found) {
  for (const Diagnostic& one : found.all())
    if (one.severity == Severity::Error) return one.message;
  return "no reason is given";
}

} // namespace dotek::targets
