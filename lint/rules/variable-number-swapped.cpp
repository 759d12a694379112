#include "frontend/macrob/Calls.h"
#include "lint/NcProgram.h"

#include <algorithm>
#include <map>

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kFirstCommon = 100;
constexpr std::uint32_t kLastCommon = 999;

bool isCommon(std::uint32_t number) {
  return number >= kFirstCommon && number <= kLastCommon;
}

// Two neighbouring digits have changed places.
bool areSwapped(std::uint32_t a, std::uint32_t b) {
  const std::string first = std::to_string(a);
  const std::string second = std::to_string(b);
  if (a == b || first.size() != second.size()) return false;
  for (std::size_t i = 1; i < first.size(); ++i) {
    std::string swapped = first;
    std::swap(swapped[i], swapped[i - 1]);
    if (swapped == second) return true;
  }
  return false;
}

void check(const Project& project, Report& report) {
  // A common variable may be set in one file and read in another, but a misprint is made in one.
  std::map<std::uint32_t, SourceRange> stored, read;
  std::map<std::uint32_t, int> times; // each number is read or set
  for (const auto& nc : programsOf(project)) {
    const auto& body = nc->program.body;
    for (std::size_t i = 0; i < body.size(); ++i) {
      const SourceRange place = body[i].origin.range();
      if (const auto number = storedNumber(body[i]); number && isCommon(*number)) {
        stored.emplace(*number, place);
        ++times[*number];
      }
      for (const auto& [number, range] : nc->reads(i)) {
        if (!isCommon(number)) continue;
        read.emplace(number, range.hasPlace() ? range : place);
        ++times[number];
      }
    }
  }
  // Results and tables of probing macros are set by the vendor's text.
  const auto ofVendor = [&](std::uint32_t number) {
    return std::any_of(project.macroSets.begin(), project.macroSets.end(), [&](const stdlib::MacroSet& set) {
      return std::any_of(set.scratch.begin(), set.scratch.end(),
                         [&](const auto& one) { return number >= one.first && number <= one.second; }) ||
             std::any_of(set.signatures.begin(), set.signatures.end(), [&](const auto& signature) {
               return std::any_of(signature.results.begin(), signature.results.end(),
                                  [&](const auto& result) { return result.variable == number; });
             });
    });
  };
  const bool probes = std::any_of(project.programs.begin(), project.programs.end(), [](const NcFile& nc) {
    return std::any_of(
        nc.file->programs.begin(), nc.file->programs.end(), [](const macrob::Program& program) {
          return std::any_of(program.blocks.begin(), program.blocks.end(), [](const macrob::Block& block) {
            const auto* words = std::get_if<macrob::Words>(&block.body);
            return words != nullptr && macrob::callOf(*words).has_value() &&
                   macrob::callOf(*words)->kind == macrob::CallKind::Simple;
          });
        });
  });
  for (const auto& [number, range] : read) {
    if (stored.contains(number)) continue;
    // A misprint is made once.
    if (times[number] > 1 || (probes && ofVendor(number))) continue;
    const auto other =
        std::find_if(stored.begin(), stored.end(), [&, to = number, at = range](const auto& one) {
          return one.second.file == at.file && !read.contains(one.first) && areSwapped(one.first, to);
        });
    if (other == stored.end()) continue;
    report
        .at(range,
            "#{0} is read and set nowhere, #{1} is set and read nowhere; one of them is a misprint of the "
            "other; write the number that is meant",
            number, other->first)
        .note(other->second, fmt::format("#{} is set here", other->first));
  }
}

} // namespace

DOTEK_LINT_RULE(variable_number_swapped){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .check = check,
};

} // namespace dotek::lint::rule
