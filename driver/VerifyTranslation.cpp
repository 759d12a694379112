#include "driver/VerifyTranslation.h"

#include "sim/geometry/PartFile.h"
#include "support/Files.h"
#include "support/messages/Verify.h"

#include <algorithm>

namespace dotek::driver {

std::shared_ptr<const ConvertedInput> convertedFor(const VerifyOptions& options,
                                                   const ConvertOptions& convert, Outcome& refused) {
  if (options.converted) return options.converted;
  Outcome found = driver::convert(convert);
  if (found.status != 0 || found.files.size() != 1) {
    refused = std::move(found);
    return nullptr;
  }
  auto out = std::make_shared<ConvertedInput>();
  out->file = std::move(found.files.front());
  out->map = std::move(found.maps.front());
  if (!found.arguments.empty()) out->arguments = std::move(found.arguments.front());
  out->macros = std::move(found.macros);
  out->sources = std::move(found.sources);
  return out;
}

Translation translationOf(const ConvertedInput& converted) {
  Translation out;
  out.name = converted.file.name;
  out.text = converted.file.text;
  out.arguments = converted.arguments;
  for (const MappedLine& line : converted.map.lines) {
    auto& places = out.sources.emplace_back().emplace();
    for (const SourceRange& range : line.ranges)
      if (range.hasPlace())
        places.emplace(converted.sources.file(range.file).name(), converted.sources.line(range));
  }
  return out;
}

bool takeEdited(const std::string& path, Translation& translation, Session& session) {
  const auto bytes = readBytes(path, session.limits(), session.diagnostics());
  if (!bytes) return false;
  const SourceFile before("", translation.text, Encoding::Utf8), now("", *bytes, Encoding::Utf8);
  const std::uint32_t rows = before.lineCount(), columns = now.lineCount();
  constexpr std::uint64_t kMost = 25'000'000;
  std::vector<std::optional<std::set<std::pair<std::string, std::uint32_t>>>> sources(columns);
  if (std::uint64_t{rows} * columns <= kMost) {
    // The longest common subsequence of lines.
    std::vector<std::vector<std::uint32_t>> common(rows + 1, std::vector<std::uint32_t>(columns + 1, 0));
    for (std::uint32_t r = rows; r-- > 0;)
      for (std::uint32_t c = columns; c-- > 0;)
        common[r][c] = before.line(r + 1) == now.line(c + 1) ? common[r + 1][c + 1] + 1
                                                             : std::max(common[r + 1][c], common[r][c + 1]);
    for (std::uint32_t r = 0, c = 0; r < rows && c < columns;) {
      if (before.line(r + 1) == now.line(c + 1)) {
        if (r < translation.sources.size()) sources[c] = translation.sources[r];
        ++r, ++c;
      } else if (common[r + 1][c] >= common[r][c + 1]) {
        ++r;
      } else {
        ++c;
      }
    }
  }
  translation.name = path;
  translation.text = *bytes;
  translation.sources = std::move(sources);
  return true;
}

bool loadWorld(const VerifyOptions& options, VerifyPlan& plan, Session& session) {
  if (options.machine) {
    plan.machine =
        sim::loadMachine(*options.machine, session.limits(), session.sources(), session.diagnostics());
    if (!plan.machine) return false;
  }
  if (!options.part) return true;
  const auto part = sim::loadPart(*options.part, session.limits(), session.sources(), session.diagnostics());
  if (!part) return false;
  plan.part = part->part;
  return true;
}

} // namespace dotek::driver
