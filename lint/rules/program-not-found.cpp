#include "frontend/macrob/Calls.h"
#include "lint/Analyses.h"
#include "lint/Project.h"
#include "support/Ascii.h"

#include <set>

namespace dotek::lint::rule {
namespace {

// From here on they are the builder's and the vendors', who keep them in the control.
constexpr std::uint64_t kOfOthers = 8000;

// A control names the file of a program after its number: O1234, O1234.NC.
std::optional<std::uint64_t> numberInName(std::string_view path) {
  const std::size_t slash = path.find_last_of("/\\");
  const std::string_view name = slash == std::string_view::npos ? path : path.substr(slash + 1);
  if (name.empty() || upperCase(name[0]) != 'O') return std::nullopt;
  std::uint64_t number = 0;
  std::size_t at = 1;
  for (; at < name.size() && isDigit(name[at]) && at < 10; ++at)
    number = number * 10 + static_cast<std::uint64_t>(name[at] - '0');
  return at > 1 ? std::optional(number) : std::nullopt;
}

void check(const Project& project, Report& report) {
  std::set<std::uint64_t> known;
  for (const NcFile& nc : project.programs) {
    if (const auto number = numberInName(project.sources.file(nc.file->file).name())) known.insert(*number);
    for (const macrob::Program& program : nc.file->programs)
      if (program.name) known.insert(program.name->number);
  }
  for (const NcFile& nc : project.programs) {
    // A file with its subprograms is meant to be whole, as a folder is.
    const bool whole = project.analyses->wholeFolder || nc.file->programs.size() > 1;
    if (!whole) continue;
    std::set<std::uint64_t> told;
    for (const macrob::Program& program : nc.file->programs)
      for (const macrob::Block& block : program.blocks) {
        const auto* words = std::get_if<macrob::Words>(&block.body);
        const auto call = words == nullptr ? std::nullopt : macrob::callOf(*words);
        if (!call || call->kind == macrob::CallKind::Return || call->program == nullptr) continue;
        const auto value = macrob::literal(*call->program);
        if (!value || *value < 1 || *value >= kOfOthers) continue;
        const auto number = static_cast<std::uint64_t>(*value);
        if (known.contains(number) || !told.insert(number).second) continue;
        report.at(call->program->range,
                  "no program O{} is {}; the control stops with alarm 78 where it has none either; add the "
                  "program, or "
                  "call the one that is meant",
                  number,
                  project.analyses->wholeFolder ? "in the folder" : "in this file, which holds others");
      }
  }
}

} // namespace

DOTEK_LINT_RULE(program_not_found){
    .severity = Severity::Warning,
    .tier = Tier::Bundle,
    .check = check,
};

} // namespace dotek::lint::rule
