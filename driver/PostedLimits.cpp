#include "driver/PostedLimits.h"

#include "frontend/macrob/Calls.h"
#include "frontend/macrob/Scan.h"
#include "stdlib/MacroLimits.h"
#include "stdlib/ReadCall.h"
#include "support/Decimal.h"
#include "support/messages/Commands.h"

#include <fmt/format.h>

namespace dotek::driver {

namespace macrob = frontend::macrob;

namespace {

void reportLimits(const macrob::Call& call, const frontend::compost::PostedLine& line,
                  project::Session& session) {
  const auto program = macrob::calledProgram(call);
  if (call.kind != macrob::CallKind::Simple || !program) return;
  std::string letters;
  for (const macrob::CallArgument& argument : call.arguments)
    letters += argument.word->address;
  for (const stdlib::MacroSet& set : session.macroSets()) {
    if (!set.calls(*program)) continue;
    const stdlib::MacroSignature* const signature = stdlib::readCall(set, *program, letters).signature;
    if (signature == nullptr) continue;
    for (const macrob::CallArgument& given : call.arguments) {
      const auto value = macrob::literal(*given.word);
      const stdlib::MacroArgument* const argument = signature->find(given.word->address);
      if (!value || !(*value < 0) || argument == nullptr || !stdlib::isLimit(argument->role)) continue;
      session.diagnostics().report<diag::PostedLimit>(line.range, std::string(1, given.word->address),
                                                      numberText(*value), fmt::format("P{}", *program),
                                                      stdlib::roleName(argument->role));
    }
    return;
  }
}

} // namespace

void reportLimits(const std::vector<frontend::compost::PostedLine>& lines, project::Session& session) {
  for (const frontend::compost::PostedLine& line : lines) {
    const auto block = macrob::scanBlock(line.text, {}, session.limits());
    const auto* const words = block ? std::get_if<macrob::Words>(&block->body) : nullptr;
    if (words == nullptr) continue;
    if (const auto call = macrob::callOf(*words)) reportLimits(*call, line, session);
  }
}

} // namespace dotek::driver
