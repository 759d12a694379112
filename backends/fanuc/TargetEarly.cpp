#include "backends/fanuc/TargetEarly.h"

#include "frontend/macrob/Check.h"
#include "frontend/macrob/Parse.h"

#include <algorithm>
#include <string>
#include <utility>

namespace dotek::targets {

namespace macrob = frontend::macrob;

void warnOfEarlyReads(const std::vector<backends::EmittedLine>& lines, const stdlib::Control& control,
                      project::Session& session) {
  constexpr std::uint32_t kSkip = 310;
  const auto& stops = control.readAheadStops;
  if (stops.empty() || std::find(stops.begin(), stops.end(), std::pair('G', kSkip)) != stops.end()) return;
  std::string text;
  for (const backends::EmittedLine& line : lines)
    text += line.text + "\n";
  SourceMap sources;
  Diagnostics unread, found;
  const FileId id = sources.add(SourceFile("translation", std::move(text), Encoding::Utf8));
  const macrob::File file = macrob::parse(id, sources, session.limits(), unread);
  const Check<macrob::CheckedProgram>* const checks[] = {&macrob::positionReadEarlyCheck};
  for (const macrob::Program& program : file.programs)
    runChecks<macrob::CheckedProgram>(checks, macrob::CheckedProgram(program, &control, sources), found);
  for (const Diagnostic& one : found.all()) {
    Diagnostic said{one.code, one.severity, {}, one.message, {}, {}};
    const std::uint32_t number = sources.line(one.range);
    if (number > 0 && number <= lines.size())
      for (const SourceRange& range : lines[number - 1].ranges)
        if (range.hasPlace()) {
          said.range = range;
          break;
        }
    session.diagnostics().add(std::move(said));
  }
}

} // namespace dotek::targets
