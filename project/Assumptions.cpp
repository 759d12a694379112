#include "project/Assumptions.h"

#include "frontend/gibbs/Assumptions.h"
#include "stdlib/CodeSpan.h"
#include "support/NearestName.h"
#include "support/messages/Commands.h"

#include <algorithm>

namespace dotek::project {
namespace {

constexpr std::string_view kTouch = "touch=";

// touch=FILE:LINE
bool namesTouch(const std::string& name) {
  const std::size_t colon = name.rfind(':');
  return name.starts_with(kTouch) && colon != std::string::npos && colon > kTouch.size() &&
         colon + 1 < name.size() && name.find_first_not_of("0123456789", colon + 1) == std::string::npos;
}

// Word?=yes, Word?(name)=no
bool answersCondition(const std::string& name) {
  const std::size_t mark = name.find('?');
  return mark != std::string::npos && mark > 0 && (name.ends_with("=yes") || name.ends_with("=no"));
}

} // namespace

std::vector<std::pair<std::string, std::string>> assumptionTable() {
  std::vector<std::pair<std::string, std::string>> out{
      {"missing-field-zero", "a field that the post prints and nobody declares: it is 0"},
      {"changed-field=macro", "a field that the macro changes after its dialog: the macro's value is stored"},
      {"changed-field=given", "a field that the macro changes after its dialog: the given value is stored"},
      {"unchecked", "checks of CycleData.mac that cannot be made: the values pass"},
      {"touch=FILE:LINE", "a move of ToolPath.mac that could be a touch and does not show it: it is one"},
      {"probe-on", "verify: another routine has switched the probe on before the cycle"},
      {"same-axes",
       "A, B, C, U, V and W of a branch: the other machine has these axes, and they move there what they "
       "move on the machine of the source"},
      {"plain-messages", "a message that the control cannot show: accents and odd characters are dropped"},
      {"auxiliary=CODE",
       "a code that the control does not list, M41 or M100-M199: it moves no axis and changes no "
       "mode; the same as --auxiliary CODE"},
      {"and-before-or", "AND beside OR in a Prog: AND binds tighter"},
      {"left-to-right", "AND beside OR in a Prog: read from left to right"},
      {"Word?=yes", "a condition of a Prog that only the CAM can answer: it holds"},
      {"Q7", "Mikroprog: G23 inside a subprogram stores no return address"},
      {"Q10", "Mikroprog: P90 takes sums, P90=P90+constant"},
      {"Q11", "Mikroprog: a parameter may appear in an axis word"},
      {"Q13", "Mikroprog: O11 to O18 test the coordinate of the moment"},
      {"Word?=no", "a condition of a Prog that only the CAM can answer: it does not hold"},
  };
  for (const frontend::gibbs::Assumption& one : frontend::gibbs::kAssumptions)
    out.emplace_back(one.id, std::string(one.construct) + ": " + std::string(one.reading));
  std::sort(out.begin(), out.end());
  return out;
}

bool isAssumption(const std::string& name) {
  if (answersCondition(name) || namesTouch(name) || !stdlib::auxiliaryCodes({name}).empty()) return true;
  const auto table = assumptionTable();
  return std::any_of(table.begin(), table.end(), [&](const auto& row) { return row.first == name; });
}

void checkAssumptions(const std::set<std::string>& given, Diagnostics& diagnostics) {
  for (const std::string& name : given) {
    if (isAssumption(name)) continue;
    const std::string near = nearestName(name, assumptionTable());
    diagnostics.report<diag::UnknownAssumption>({}, name,
                                                near.empty() ? "" : "; did you mean `" + near + "`?");
  }
}

std::vector<SourceRange> touchLines(const SourceMap& sources, const std::set<std::string>& given,
                                    Diagnostics& diagnostics) {
  std::vector<SourceRange> out;
  for (const std::string& name : given) {
    if (!namesTouch(name)) continue;
    const std::size_t colon = name.rfind(':');
    const std::string file = name.substr(kTouch.size(), colon - kTouch.size());
    const unsigned long line = std::stoul(name.substr(colon + 1, 9));
    const std::size_t before = out.size();
    for (FileId id = 0; id < sources.size(); ++id) {
      const SourceFile& source = sources.file(id);
      const bool same = source.name() == file || source.name().ends_with("/" + file);
      if (!same || line == 0 || line > source.lineCount()) continue;
      const std::uint32_t number = static_cast<std::uint32_t>(line);
      const std::uint32_t begin = source.lineStart(number);
      out.push_back({id, begin, begin + static_cast<std::uint32_t>(source.line(number).size())});
    }
    if (out.size() == before)
      diagnostics.report<diag::UnknownName>({}, "--assume", name, "line in an input", "");
  }
  return out;
}

} // namespace dotek::project
