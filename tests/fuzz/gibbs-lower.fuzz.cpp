// Any bytes as a macro: its checks and its path become statements, with small limits. Nothing may crash or
// hang, and what comes out holds what every cycle holds.
#include "frontend/gibbs/Assumptions.h"
#include "frontend/gibbs/Lower.h"
#include "ir/Verify.h"
#include "stdlib/DataFiles.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>

using namespace dotek;
using namespace dotek::frontend;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const stdlib::DataFiles files;
  static const stdlib::GibbsKeywords keywords = stdlib::GibbsKeywords::load(files);
  if (size == 0) return 0;
  Limits limits;
  limits.steps = 2000;
  limits.paths = 8;
  limits.callDepth = 4;
  SourceMap sources;
  Diagnostics diagnostics;
  // The first byte chooses what is assumed.
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const FileId file =
      sources.add(SourceFile("fuzz.mac", text, isUtf8(text) ? Encoding::Utf8 : Encoding::Cp1250));
  const gibbs::Macro macro = gibbs::parseMacro(file, {sources, keywords, limits, diagnostics});
  const gibbs::Dialog dialog = gibbs::parseDialog(file, {sources, keywords, limits, diagnostics});
  ir::Cycle cycle;
  for (const char* name : {"a", "b", "Z"}) {
    ir::Variable field;
    field.name = name;
    field.role = ir::Role::Parameter;
    field.defaultValue = 1;
    cycle.add(field);
  }
  std::map<std::string, ir::VariableId> hosts;
  gibbs::LowerContext context{sources, keywords, limits, diagnostics, {}, {}, nullptr, nullptr, nullptr};
  context.load = [&](const std::string&, SourceRange) { return &macro; };
  context.loadDialog = [&](const std::string&, SourceRange) { return &dialog; };
  context.host = [&](const std::string& name) {
    const auto known = hosts.find(name);
    if (known != hosts.end()) return known->second;
    ir::Variable host;
    host.name = name;
    host.role = ir::Role::Host;
    return hosts[name] = cycle.add(host);
  };
  if ((data[0] & 1) != 0) {
    for (const gibbs::Assumption& each : gibbs::kAssumptions)
      context.assumptions.insert(std::string(each.id));
  }
  if ((data[0] & 2) != 0) context.assumptions.insert("unchecked");
  if ((data[0] & 4) != 0) context.touches.push_back({file, 0, static_cast<std::uint32_t>(text.size())});
  gibbs::lowerChecks(macro, cycle, context);
  gibbs::lowerToolPath(macro, cycle, context);
  if (!ir::verify(cycle).empty()) std::abort();
  return 0;
}
