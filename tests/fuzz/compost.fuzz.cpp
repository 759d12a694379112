// Arbitrary bytes as a Prog: tokens, tree, findings, summary.
#include "frontend/compost/Check.h"
#include "frontend/compost/Parse.h"
#include "frontend/compost/Summary.h"
#include "stdlib/ComPostKeywords.h"
#include "stdlib/DataFiles.h"

#include <cstdint>
#include <cstdlib>
#include <string>

using namespace dotek;
using namespace dotek::frontend;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const stdlib::DataFiles kFiles;
  static const stdlib::ComPostKeywords kKeywords = stdlib::ComPostKeywords::load(kFiles);
  const std::string bytes(data, data + size);
  SourceMap sources;
  Diagnostics diagnostics;
  const Limits limits;
  const FileId file =
      sources.add(SourceFile("input", bytes, isUtf8(bytes) ? Encoding::Utf8 : Encoding::Cp1250));
  const compost::Program program = compost::parse(file, sources, limits, diagnostics);
  // What is broken is also reported.
  if (program.hasErrorNodes && !diagnostics.hasErrors()) std::abort();
  compost::check(program, kKeywords, sources, diagnostics);
  for (const std::string& id : compost::cycleIds(program)) {
    compost::printingRoutines(program, kKeywords, id);
    for (const compost::BranchRef& branch : compost::branchesOf(program, id))
      compost::fieldsPrinted(program, branch, id);
  }
  compost::dumpAst(program, sources);
  compost::dumpTokens(file, sources, limits, diagnostics);
  renderText(diagnostics, sources, 0);
  return 0;
}
