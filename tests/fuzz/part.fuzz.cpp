// Part and machine files: read, and what was read is probed. A contact has to be one.
#include "sim/geometry/Contact.h"
#include "sim/geometry/PartFile.h"
#include "sim/geometry/Probe.h"
#include "support/Files.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dotek;
  using namespace dotek::sim;
  // toml++ runs into undefined behaviour of its own at some letters that are no ASCII.
  if (std::any_of(data, data + size, [](std::uint8_t byte) { return byte >= 0x80; })) return 0;
  SourceMap sources;
  Diagnostics diagnostics;
  const auto added = addText("input", std::string(reinterpret_cast<const char*>(data), size), Encoding::Utf8,
                             std::nullopt, sources, diagnostics);
  if (!added) return 0;
  const FileId id = *added;
  readMachine(id, sources, diagnostics);
  Diagnostics ofPart;
  const ReadMesh none = [](const std::string&, SourceRange) {
    return std::optional<std::string>("solid a\nendsolid a\n");
  };
  const auto file = readPart(id, sources, none, ofPart);
  if (file.has_value() == ofPart.hasErrors()) std::abort();
  if (!file) return 0;
  const Part& part = file->part;
  const Point3 to = part.toMachine({1, 2, -3});
  for (const Point3& d : {Point3{100, 3, 5}, Point3{-7, 110, 1}, Point3{0, 0, 90}}) {
    const Point3 from = to + d;
    const auto touch = firstContact(part, 2, from, to);
    if (touch && !touch->atStart && std::abs(part.distance(touch->centre) - 2) > 1e-6) std::abort();
    firstCollision(part, {from, from + Point3{0, 0, 40}, 1.5}, to - from);
  }
  return 0;
}
