#include "lint/ProgBlocks.h"

#include <map>

namespace dotek::lint::rule {
namespace {

struct Line {
  SourceRange blanks; // before the statement
  std::uint32_t width = 0;
};

class Check {
public:
  Check(const Project& project, Report& report) : project_(project), report_(report) {}

  void body(const std::vector<compost::Statement>& statements) {
    std::vector<Line> lines;
    for (const compost::Statement& statement : statements) {
      if (const auto line = lineOf(rangeOf(statement))) lines.push_back(*line);
      if (const auto* branch = std::get_if<std::unique_ptr<compost::If>>(&statement)) {
        body((*branch)->thenBody);
        body((*branch)->elseBody);
      }
    }
    std::map<std::uint32_t, std::size_t> widths;
    for (const Line& line : lines)
      ++widths[line.width];
    if (widths.size() < 2) return;
    auto usual = widths.begin();
    for (auto at = widths.begin(); at != widths.end(); ++at)
      if (at->second > usual->second) usual = at;
    if (usual->second * 2 <= lines.size()) return; // no habit that the others break
    for (const Line& line : lines) {
      if (line.width == usual->first) continue;
      report_.at(line.blanks, "the line begins in column {}, most lines of this part in column {}",
                 line.width + 1, usual->first + 1);
    }
  }

private:
  // Nothing where the statement does not begin its line.
  std::optional<Line> lineOf(SourceRange range) const {
    const SourceFile& file = project_.sources.file(range.file);
    const std::uint32_t start = file.lineStart(file.lineOf(range.begin));
    const SourceRange blanks{range.file, start, range.begin};
    if (project_.sources.text(blanks).find_first_not_of(" \t") != std::string_view::npos) return std::nullopt;
    SourceRange shown = blanks;
    if (shown.begin == shown.end) shown.end = range.begin + 1;
    return Line{shown, range.begin - start};
  }

  const Project& project_;
  Report& report_;
};

void check(const Project& project, Report& report) {
  eachRoutine(project, [&](const compost::Program&, const compost::Routine& routine) {
    Check(project, report).body(routine.body);
  });
}

} // namespace

DOTEK_LINT_RULE(indentation){
    .severity = Severity::Note,
    .byDefault = false,
    .tier = Tier::Text,
    .check = check,
};

} // namespace dotek::lint::rule
