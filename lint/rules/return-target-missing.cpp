#include "frontend/macrob/Calls.h"
#include "lint/Project.h"

#include <algorithm>

#include <map>

namespace dotek::lint::rule {
namespace {

using Program = macrob::Program;

std::optional<std::uint64_t> numberOf(const frontend::nc::Word* word) {
  const auto value = word == nullptr ? std::nullopt : macrob::literal(*word);
  if (!value || *value < 1 || *value > 1e9) return std::nullopt;
  return static_cast<std::uint64_t>(*value);
}

bool hasBlock(const Program& program, std::uint64_t number) {
  return std::any_of(program.blocks.begin(), program.blocks.end(), [&](const macrob::Block& block) {
    return block.sequenceNumber && block.sequenceNumber->value == number;
  });
}

std::string nameOf(const Program& program) {
  if (!program.name) return "program";
  return program.name->kind == macrob::ProgramName::Kind::Name ? "<" + program.name->text + ">"
                                                               : "O" + program.name->text;
}

// Calls visit(call) with each call of a program and each M99.
template <class Visit> void eachCall(const Program& program, const Visit& visit) {
  for (const macrob::Block& block : program.blocks)
    if (const auto* words = std::get_if<macrob::Words>(&block.body))
      if (const auto call = macrob::callOf(*words)) visit(*call);
}

// Ends with M2 or M30, so that it is one that nobody calls.
bool isMain(const Program& program) {
  return std::any_of(program.blocks.begin(), program.blocks.end(), [](const macrob::Block& block) {
    const auto* words = std::get_if<macrob::Words>(&block.body);
    return words != nullptr &&
           (macrob::findCode(*words, 'M', 30) != nullptr || macrob::findCode(*words, 'M', 2) != nullptr);
  });
}

struct Caller {
  const Program* program = nullptr;
  SourceRange call;
};

void checkFile(const macrob::File& file, Report& report) {
  std::map<std::uint64_t, std::vector<Caller>> callers;
  for (const Program& program : file.programs)
    eachCall(program, [&](const macrob::Call& call) {
      if (call.kind != macrob::CallKind::Simple && call.kind != macrob::CallKind::Subprogram) return;
      const auto number = numberOf(call.program);
      if (!number) return;
      callers[*number].push_back({&program, call.program->range});
      // M98 P51002 repeats O1002 on some controls.
      if (*number > 9999) callers[*number % 10000].push_back({&program, call.program->range});
    });
  for (const Program& program : file.programs) {
    if (!program.name || !program.closed) continue; // an excerpt
    const auto calls = callers.find(program.name->number);
    const bool called = calls != callers.end();
    if (!called && !isMain(program)) continue; // who calls it is in no file that is known
    eachCall(program, [&](const macrob::Call& call) {
      if (call.kind != macrob::CallKind::Return) return;
      const auto number = numberOf(call.program);
      if (!number) return;
      if (!called) {
        if (!hasBlock(program, *number))
          report.at(call.program->range,
                    "M99 goes on at N{0} of this program, which has no such block; the control stops with "
                    "alarm 128; number the block that is meant",
                    *number);
        return;
      }
      for (const Caller& caller : calls->second) {
        if (hasBlock(*caller.program, *number)) continue;
        report
            .at(call.program->range,
                "M99 goes back to N{} of {}, which has no such block; the control stops with alarm 128; "
                "number the block that is meant",
                *number, nameOf(*caller.program))
            .note(caller.call, "called here");
        return;
      }
    });
  }
}

void check(const Project& project, Report& report) {
  for (const NcFile& nc : project.programs)
    checkFile(*nc.file, report);
}

} // namespace

DOTEK_LINT_RULE(return_target_missing){
    .severity = Severity::Error,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
