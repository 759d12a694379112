#include "frontend/macrob/Check.h"

#include "frontend/macrob/CheckParts.h"

namespace dotek::frontend::macrob {

void checkFile(const File& file, const stdlib::Control* control, const SourceMap& sources,
               Diagnostics& diagnostics) {
  const CheckContext context{control, sources, diagnostics};
  for (const Program& program : file.programs) {
    checkFlow(program, context);
    checkVariables(program, context);
    checkExpressions(program, context);
    checkWords(program, context);
    checkMessages(program, context);
  }
}

} // namespace dotek::frontend::macrob
