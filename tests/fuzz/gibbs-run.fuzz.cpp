// Any bytes as a macro: parsed, its checks run, its path run, with small limits. Nothing may crash or hang.
#include "frontend/gibbs/Assumptions.h"
#include "frontend/gibbs/Parse.h"
#include "frontend/gibbs/Run.h"
#include "stdlib/DataFiles.h"

#include <cstddef>
#include <cstdint>
#include <string>

using namespace dotek;
using namespace dotek::frontend;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const stdlib::DataFiles files;
  static const stdlib::GibbsKeywords keywords = stdlib::GibbsKeywords::load(files);
  if (size == 0) return 0;
  Limits limits;
  limits.steps = 2000;
  limits.paths = 32;
  limits.outputBytes = 20000;
  SourceMap sources;
  Diagnostics diagnostics;
  // The first byte chooses what is known and assumed.
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const FileId file =
      sources.add(SourceFile("fuzz.mac", text, isUtf8(text) ? Encoding::Utf8 : Encoding::Cp1250));
  const gibbs::Macro macro = gibbs::parseMacro(file, {sources, keywords, limits, diagnostics});
  const gibbs::Dialog dialog = gibbs::parseDialog(file, {sources, keywords, limits, diagnostics});
  gibbs::RunContext context{sources,
                            keywords,
                            limits,
                            diagnostics,
                            {{"A", 1}, {"B", -2.5}},
                            {},
                            {},
                            [&](const std::string&, SourceRange) { return &macro; },
                            [&](const std::string&, SourceRange) { return &dialog; }};
  if ((data[0] & 1) != 0) context.hosts = {{"tool_radius", 3}, {"retract", 5}, {"tool_number", 1}};
  if ((data[0] & 2) != 0) {
    for (const gibbs::Assumption& each : gibbs::kAssumptions)
      context.assumptions.insert(std::string(each.id));
  }
  gibbs::runChecks(macro, context);
  if (const auto path = gibbs::runToolPath(macro, context)) gibbs::pathText(*path);
  return 0;
}
