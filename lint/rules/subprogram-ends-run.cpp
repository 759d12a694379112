#include "frontend/macrob/Calls.h"
#include "lint/Project.h"

#include <map>
#include <set>

namespace dotek::lint::rule {
namespace {

using Program = macrob::Program;

// The M30 or M2 of a program that has no M99; nullptr: it returns, or has none.
const frontend::nc::Word* endOf(const Program& program) {
  const frontend::nc::Word* end = nullptr;
  for (const macrob::Block& block : program.blocks) {
    const auto* words = std::get_if<macrob::Words>(&block.body);
    if (words == nullptr) continue;
    if (macrob::findCode(*words, 'M', 99) != nullptr) return nullptr;
    for (const double code : {30.0, 2.0})
      if (const auto* word = macrob::findCode(*words, 'M', code)) end = word;
  }
  return end;
}

void check(const Project& project, Report& report) {
  for (const NcFile& nc : project.programs) {
    std::map<std::uint64_t, SourceRange> called;
    for (const Program& program : nc.file->programs)
      for (const macrob::Block& block : program.blocks) {
        const auto* words = std::get_if<macrob::Words>(&block.body);
        const auto call = words == nullptr ? std::nullopt : macrob::callOf(*words);
        if (!call || call->program == nullptr) continue;
        if (call->kind != macrob::CallKind::Simple && call->kind != macrob::CallKind::Subprogram) continue;
        const auto number = macrob::literal(*call->program);
        if (!number || *number < 1 || *number > 99999999) continue;
        called.emplace(static_cast<std::uint64_t>(*number), call->program->range);
        if (call->kind == macrob::CallKind::Subprogram && *number > 9999)
          called.emplace(static_cast<std::uint64_t>(*number) % 10000, call->program->range);
      }
    for (const Program& program : nc.file->programs) {
      const auto call = program.name ? called.find(program.name->number) : called.end();
      if (call == called.end()) continue;
      if (const auto* end = endOf(program))
        report
            .at(end->range,
                "O{} is called as a subprogram and ends the whole run here; nothing after the call is "
                "carried out; "
                "write M99",
                program.name->text)
            .note(call->second, "called here");
    }
  }
}

} // namespace

DOTEK_LINT_RULE(subprogram_ends_run){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
