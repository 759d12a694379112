// Arbitrary bytes as blocks of NC, one a line: read and lifted. `{` is a hole; the first byte chooses
// control, macro set, and whether the holes' values are fixed.
#include "frontend/nc/Lift.h"
#include "frontend/nc/Parse.h"
#include "stdlib/DataFiles.h"

#include <cstdint>
#include <cstdlib>
#include <string>

using namespace dotek;
using namespace dotek::frontend;

namespace {

struct Data {
  std::vector<stdlib::Control> controls;
  std::vector<stdlib::MacroSet> sets;
  std::vector<Picture> pictures;

  Data() {
    const stdlib::DataFiles files;
    for (const char* name : {"fanuc-0i-md", "fanuc-6m"})
      controls.push_back(*stdlib::Control::load(files, name));
    for (const char* name : {"easyprobe", "inspection-plus"})
      sets.push_back(*stdlib::MacroSet::load(files, name));
    for (const char* text : {"###.##;0", "###", "##^000"})
      pictures.push_back(std::get<Picture>(Picture::parse(text)));
  }
};

std::vector<nc::Piece> piecesOf(std::string_view line, std::uint32_t at, FileId file, const Data& data) {
  std::vector<nc::Piece> out;
  const auto place = [&](std::size_t begin, std::size_t end) {
    return SourceRange{file, at + static_cast<std::uint32_t>(begin), at + static_cast<std::uint32_t>(end)};
  };
  for (std::size_t i = 0; i < line.size();) {
    if (line[i] == '{') {
      const Picture* picture = i % 4 == 3 ? nullptr : &data.pictures[i % 4];
      out.emplace_back(
          nc::HolePiece{{ir::variable(static_cast<ir::VariableId>(i % 2)), picture, "v"}, place(i, i + 1)});
      ++i;
      continue;
    }
    const std::size_t end = std::min(line.find('{', i), line.size());
    out.emplace_back(nc::TextPiece{std::string(line.substr(i, end - i)), place(i, end)});
    i = end;
  }
  return out;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const Data data;
  if (size == 0) return 0;
  const unsigned choice = bytes[0];
  const std::string text(bytes + 1, bytes + size);
  SourceMap sources;
  Diagnostics diagnostics;
  const Limits limits;
  const FileId file = sources.add(SourceFile("input", text, Encoding::Cp1250));
  ir::Cycle cycle;
  for (const char* name : {"a", "b"}) {
    ir::Variable variable;
    variable.name = name;
    cycle.add(variable);
  }
  nc::LiftContext context{data.controls[choice & 1],
                          (choice & 2) != 0 ? nullptr : &data.sets[(choice >> 2) & 1], cycle, diagnostics};
  if ((choice & 8) != 0) context.fixed = [](ir::VariableId id) { return id == 0 ? 56.0 : 9770.0; };
  std::vector<ir::CycleStatement> body;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = std::min(text.find('\n', i), text.size());
    const auto before = diagnostics.all().size();
    const auto block = nc::parseBlock(
        piecesOf(std::string_view(text).substr(i, end - i), static_cast<std::uint32_t>(i), file, data),
        limits, diagnostics);
    // What is refused is reported; a finding that was said before is kept once.
    if (!block && before == 0 && !diagnostics.hasErrors()) std::abort();
    if (block) {
      nc::programsCalled(*block);
      const std::size_t statements = body.size();
      if (!nc::lift(*block, context, body) && !diagnostics.hasErrors()) std::abort();
      for (std::size_t s = statements; s < body.size(); ++s) {
        if (body[s].origin.block == 0) std::abort();
      }
    }
    i = end + 1;
  }
  renderText(diagnostics, sources, 0);
  return 0;
}
