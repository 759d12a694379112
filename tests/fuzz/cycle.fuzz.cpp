#include "frontend/cycle/Check.h"
#include "frontend/cycle/Lower.h"
#include "frontend/cycle/Parse.h"
#include "ir/Print.h"
#include "ir/Verify.h"

#include <cstdint>
#include <cstdlib>
#include <string>

// What is read without a defect is laid out, and the layout is read as the same cycle. What the checks find
// nothing wrong with is lowered to IR that holds together.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dotek;
  namespace cycle = frontend::cycle;
  const Limits limits;
  SourceMap sources;
  const FileId id = sources.add(
      SourceFile("input.cycle", std::string(reinterpret_cast<const char*>(data), size), Encoding::Utf8));
  Diagnostics diagnostics;
  const cycle::File file = cycle::parse(id, sources, limits, diagnostics);
  cycle::check(file, sources, diagnostics);
  if (!file.hasErrorNodes && !diagnostics.hasErrors())
    if (const auto lowered = cycle::lower(file, sources, diagnostics)) {
      for (const ir::Violation& violation : ir::verify(lowered->cycle))
        if (!violation.mixedKinds) std::abort();
      ir::Module module;
      module.cycles.push_back(lowered->cycle);
      ir::print(module, &sources);
    }
  renderText(diagnostics, sources, 0);
  cycle::dumpTokens(id, sources, limits, diagnostics);
  cycle::dumpAst(file, sources);
  if (file.hasErrorNodes) return 0;
  const std::string text = cycle::layOut(file);
  const FileId again = sources.add(SourceFile("again.cycle", text, Encoding::Utf8));
  Diagnostics second;
  if (cycle::layOut(cycle::parse(again, sources, limits, second)) != text) std::abort();
  return 0;
}
