// Any bytes as programs of Macro B: their outline, and new numbers for their blocks. What gets new numbers
// reads as as many blocks as before, and the same numbers again change nothing. The first byte chooses the
// options.
#include "frontend/macrob/Renumber.h"
#include "frontend/macrob/Outline.h"
#include "frontend/macrob/Parse.h"

#include <cstdint>
#include <cstdlib>
#include <string>

using namespace dotek;
using namespace dotek::frontend;

namespace {

// Numbers of all blocks in their order; how many calls and jumps there are.
struct Shape {
  std::size_t programs = 0, numbers = 0, calls = 0, jumps = 0;
  bool operator==(const Shape&) const = default;
};

Shape shapeOf(const std::vector<macrob::OutlineProgram>& programs) {
  Shape out;
  out.programs = programs.size();
  for (const macrob::OutlineProgram& one : programs) {
    out.numbers += one.numbers.size();
    out.calls += one.calls.size();
    out.jumps += one.jumps.size();
  }
  return out;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const Limits limits;
  SourceMap sources;
  Diagnostics diagnostics;
  const auto read = [&](std::string text) {
    const FileId id = sources.add(SourceFile("input", std::move(text), Encoding::Cp1250));
    return macrob::parse(id, sources, limits, diagnostics);
  };
  macrob::RenumberOptions options;
  options.all = (data[0] & 1) != 0;
  options.step = 1 + ((data[0] >> 1) & 7);
  options.last = (data[0] & 16) != 0 ? 9999 : 99999999;
  if ((data[0] & 32) != 0) options.range = std::pair<std::uint64_t, std::uint64_t>(10, 100);
  const macrob::File file = read(std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
  const Shape before = shapeOf(macrob::outline(file, sources));
  const bool sound = !diagnostics.hasErrors();
  const auto once = macrob::renumber(file, options, sources, diagnostics);
  if (!once) {
    if (sound && !diagnostics.hasErrors()) std::abort(); // refused without a word
    return 0;
  }
  diagnostics = Diagnostics();
  const macrob::File second = read(*once);
  const Shape after = shapeOf(macrob::outline(second, sources));
  if (options.all ? after.jumps != before.jumps || after.calls != before.calls : after != before)
    std::abort();
  if (options.range) return 0; // other blocks may lie in it now
  const auto twice = macrob::renumber(second, options, sources, diagnostics);
  if (!twice || *twice != *once) std::abort();
  return 0;
}
