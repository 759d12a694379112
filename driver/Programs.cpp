#include "driver/Programs.h"

#include "frontend/macrob/Lower.h"
#include "frontend/macrob/Parse.h"

#include <utility>

namespace dotek::driver {

std::optional<ir::ProgramFile> loadPrograms(FileId file, const stdlib::Control& control, Session& session) {
  Diagnostics found;
  const frontend::macrob::File tree =
      frontend::macrob::parse(file, session.sources(), session.limits(), found);
  for (Diagnostic& one : found.all())
    if (one.severity == Severity::Error) session.diagnostics().add(std::move(one));
  return frontend::macrob::lower(tree, control, session.sources(), session.diagnostics());
}

} // namespace dotek::driver
