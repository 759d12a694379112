#include "frontend/gibbs/Cycle.h"
#include "stdlib/DataFiles.h"

#include <cstdint>
#include <string>

// The first byte chooses the encoding.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dotek;
  static const stdlib::DataFiles files;
  static const stdlib::GibbsKeywords keywords = stdlib::GibbsKeywords::load(files);
  if (size == 0) return 0;
  SourceMap sources;
  const Limits limits;
  Diagnostics diagnostics;
  const FileId file =
      sources.add(SourceFile("input", std::string(reinterpret_cast<const char*>(data) + 1, size - 1),
                             (data[0] & 1) != 0 ? Encoding::Utf8 : Encoding::Cp1250));
  const frontend::gibbs::ParseContext context{sources, keywords, limits, diagnostics};
  frontend::gibbs::Cycle cycle;
  cycle.defineData = frontend::gibbs::parseDefineData(file, context);
  frontend::gibbs::checkDefineData(*cycle.defineData, context);
  frontend::gibbs::declaredFields(cycle);
  frontend::gibbs::dumpAst(*cycle.defineData, sources);
  renderText(diagnostics, sources, 0);
  return 0;
}
