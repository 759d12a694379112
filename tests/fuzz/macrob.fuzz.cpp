#include "frontend/macrob/Check.h"
#include "frontend/macrob/Format.h"
#include "frontend/macrob/Parse.h"
#include "stdlib/DataFiles.h"

#include <cstdint>
#include <cstdlib>
#include <string>

// The first byte chooses encoding and control. Both readers have to agree, and the layout has to keep the
// tree.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dotek;
  namespace macrob = frontend::macrob;
  static const stdlib::DataFiles files;
  static const stdlib::Control early = *stdlib::Control::load(files, "fanuc-6m");
  static const stdlib::Control late = *stdlib::Control::load(files, "fanuc-31i-b");
  if (size == 0) return 0;
  const Limits limits;
  const auto open = [&](std::string text, SourceMap& sources) {
    return sources.add(
        SourceFile("input", std::move(text), (data[0] & 1) != 0 ? Encoding::Utf8 : Encoding::Cp1250));
  };
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  SourceMap sources;
  const FileId id = open(text, sources);
  Diagnostics diagnostics;
  Diagnostics same;
  const macrob::File file = macrob::parse(id, sources, limits, diagnostics);
  const macrob::File slow =
      macrob::parse(id, sources, limits, same, macrob::Text::Program, macrob::Reader::GrammarOnly);
  if (macrob::dumpAst(file, sources) != macrob::dumpAst(slow, sources)) std::abort();
  diagnostics.sort();
  same.sort();
  if (renderText(diagnostics, sources, 0) != renderText(same, sources, 0)) std::abort();
  macrob::checkFile(file,
                    (data[0] & 2) != 0   ? &early
                    : (data[0] & 4) != 0 ? &late
                                         : nullptr,
                    sources, diagnostics);
  renderText(diagnostics, sources, 0);
  macrob::dumpTokens(id, sources, limits, same);
  const auto once = macrob::format(file, sources);
  if (!once || file.leader.begin < file.leader.end) return 0;
  SourceMap again;
  Diagnostics ignored;
  const macrob::File second = macrob::parse(open(*once, again), again, limits, ignored);
  if (macrob::dumpAst(second, again, false) != macrob::dumpAst(file, sources, false)) std::abort();
  const auto twice = macrob::format(second, again);
  if (!twice || *twice != *once) std::abort();
  return 0;
}
