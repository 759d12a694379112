#include "lint/NcProgram.h"
#include "lint/Probing.h"

#include <map>

namespace dotek::lint::rule {
namespace {

// Variables in which a call of the program leaves what it measured; EasyProbe and Inspection Plus name them.
std::vector<std::uint32_t> resultsOf(const Project& project, std::uint32_t program) {
  std::vector<std::uint32_t> out;
  for (const stdlib::MacroSet& set : project.macroSets)
    for (const stdlib::MacroSignature* signature : set.of(program))
      for (const stdlib::MacroResult& result : signature->results)
        out.push_back(result.variable);
  return out;
}

// The measurement whose result each variable holds before a statement: index of the statement.
using Holders = std::map<std::uint32_t, std::size_t>;

void checkProgram(const ir::Program& program, const Project& project, const Probing& probing,
                  Report& report) {
  const auto& body = program.body;
  std::vector<std::size_t> measures;
  for (std::size_t i = 0; i < body.size(); ++i)
    if (probing.step(body[i]).kind == ProbeStep::Kind::Measure) measures.push_back(i);
  if (measures.size() < 2) return;
  // In a straight run of measurements: one whose results are read nowhere before the next, while some other's
  // are.
  for (std::size_t m = 0; m + 1 < measures.size(); ++m) {
    const auto results = resultsOf(project, probing.step(body[measures[m]]).program);
    const auto later = resultsOf(project, probing.step(body[measures[m + 1]]).program);
    std::optional<SourceRange> between;
    bool flow = false;
    for (std::size_t i = measures[m] + 1; i < measures[m + 1]; ++i) {
      flow =
          flow ||
          match(
              body[i],
              [](const ir::OneOf<ir::NcBlock, ir::Store, ir::Comment, ir::Call> auto&) { return false; },
              [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::JumpTo, ir::Loop, ir::LoopEnd, ir::Exit,
                                 ir::Raise, ir::Notice, ir::Port, ir::Print, ir::NameVariables> auto&) {
                return true;
              });
      eachRead(body[i], [&](std::uint32_t number, SourceRange range) {
        for (const std::uint32_t result : results)
          if (number == result) between = range;
      });
    }
    if (between || flow) continue;
    // A call that sets an offset or a tool leaves its result there.
    const auto* call = std::get_if<ir::Call>(&body[measures[m]].node);
    bool sets = false;
    if (call != nullptr)
      for (const ir::CallArgument& argument : call->arguments)
        sets = sets || argument.letter == 'S' || argument.letter == 'T';
    if (sets) continue;
    std::optional<SourceRange> read;
    for (std::size_t i = measures[m + 1] + 1; i < body.size() && !read; ++i) {
      if (probing.step(body[i]).kind == ProbeStep::Kind::Measure) break;
      eachRead(body[i], [&](std::uint32_t number, SourceRange range) {
        for (const std::uint32_t result : later)
          if (number == result && !read) read = range;
      });
    }
    if (!read) continue;
    report
        .at(body[measures[m]].origin.range(),
            "nothing reads the result of this measurement before the next one "
            "overwrites it; what was measured is lost; save it, or set an offset "
            "with it")
        .note(body[measures[m + 1]].origin.range(), "the next measurement")
        .note(*read, "only its result is read");
  }
}

void check(const NcProgram& nc, Report& report) {
  checkProgram(nc.program, nc.project, probingOf(nc.project), report);
}

} // namespace

DOTEK_LINT_RULE(result_not_saved){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
