// convert --to cycle.
#include "targets/Target.h"

#include "backends/cycle/Emit.h"
#include "backends/cycle/TargetText.h"
#include "backends/cycle/TargetVerify.h"
#include "support/messages/Cycle.h"
#include "targets/Conversion.h"
#include "targets/ReadBack.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::targets {

namespace {

bool isBlank(char c) {
  return c == ' ' || c == '\n' || c == '\t';
}

// The lines of the layout with what they come from: it moves blanks and line ends, and nothing else.
std::vector<backends::EmittedLine> mapped(const std::string& text,
                                          const std::vector<backends::EmittedLine>& written) {
  std::vector<backends::EmittedLine> out;
  std::size_t from = 0, used = 0; // line, and how many of its characters are printed
  const auto size = [](const std::string& line) {
    return static_cast<std::size_t>(
        std::count_if(line.begin(), line.end(), [](char c) { return !isBlank(c); }));
  };
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    backends::EmittedLine line{text.substr(at, end - at), {}, ""};
    at = end + 1;
    std::size_t left = size(line.text);
    while (left > 0 && from < written.size()) {
      const std::size_t all = size(written[from].text), here = std::min(left, all - used);
      if (here > 0) {
        line.ranges.insert(line.ranges.end(), written[from].ranges.begin(), written[from].ranges.end());
        if (line.reason.empty()) line.reason = written[from].reason;
      }
      left -= here;
      used += here;
      if (used == all) ++from, used = 0;
    }
    std::erase_if(line.ranges, [](const SourceRange& range) { return !range.hasPlace(); });
    out.push_back(std::move(line));
  }
  return out;
}

class CycleConversion final : public Conversion {
public:
  using Conversion::Conversion;

  bool cycle(const CycleFolder& folder, std::size_t /*index*/) override {
    std::optional<LoweredSource> source = lowerSource(folder, context_);
    if (!source) return false;
    if (session_.diagnostics().hasErrors()) return true;
    const ir::Cycle& cycle = source->lowered.cycle;
    const SourceRange range = cycle.range;
    auto written = writtenCycle(folder, source->lowered, sourceControl(), session_);
    if (!written) return true;
    std::string file = written->name + ".cycle";
    std::replace(file.begin(), file.end(), '_', '-');
    std::string text;
    for (const backends::EmittedLine& line : written->lines)
      text += line.text + "\n";
    Diagnostics found;
    ReadCycle read(session_);
    if (!read.read(file, text, found) || !read.lowered(found)) {
      refuse(range, found, written->lines);
      return true;
    }
    context_.result.add(file, mapped(read.laidOut(), written->lines));
    if (source->lowered.macros != nullptr) context_.result.macros = source->lowered.macros->name;
    return true;
  }

private:
  const stdlib::Control* sourceControl() const {
    const LoweringInputs* inputs = context_.inputs;
    return inputs == nullptr || !inputs->sourceControl ? nullptr : &*inputs->sourceControl;
  }

  // What the checks of the language have against the text, at what the line was written for.
  void refuse(SourceRange range, const Diagnostics& found, const std::vector<backends::EmittedLine>& lines) {
    for (const Diagnostic& one : found.all()) {
      if (one.severity != Severity::Error) continue;
      std::string line;
      if (one.range.hasPlace()) {
        const SourceFile& file = session_.sources().file(one.range.file);
        const std::uint32_t number = session_.sources().line(one.range);
        line = std::string(file.line(number));
        if (number > 0 && number <= lines.size())
          for (const SourceRange& source : lines[number - 1].ranges)
            if (source.hasPlace()) {
              range = source;
              break;
            }
      }
      std::string why = one.message;
      if (one.code == diag::KindsMixed::code)
        why += "; a label of the dialog says in what a field counts: `[mm]`, `[deg]`";
      session_.diagnostics().report<diag::CycleFormCannot>(
          range, line.empty() ? std::string("this cycle") : fmt::format("`{}`", line), why);
      return;
    }
  }
};

void checkCycleConvert(const ConvertOptions& options, Diagnostics& diagnostics) {
  if (!options.source.prog) diagnostics.report<diag::CycleFormNeedsProg>({});
}

} // namespace

namespace target {

DOTEK_TARGET(cycle) = {
    .text = "file of the cycle language, from the folder of a CAM",
    .checkConvert = checkCycleConvert,
    .convert = conversionBy<CycleConversion>,
    .verify = cycleVerification,
};

} // namespace target

} // namespace dotek::targets
