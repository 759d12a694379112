#include "frontend/gibbs/RunMachine.h"

#include "support/Decimal.h"
#include "support/messages/Gibbs.h"

namespace dotek::frontend::gibbs {
namespace {

void reportQuestion(Machine& machine, const Question& question) {
  if (question.sources.empty()) {
    machine.reportOnce(makeDiagnostic<diag::UnknownValue>(question.range, question.reason));
  } else {
    machine.reportOnce(
        makeDiagnostic<diag::HostInputUnknown>(question.range, question.sources.begin()->name));
  }
}

// Rounding hides the binary fractions of sums such as 0.1 + 0.2.
std::string coordinateText(double value) {
  return numberText(Decimal::of(value).rounded(6).value());
}

} // namespace

std::optional<std::vector<PathMove>> runToolPath(const Macro& toolPath, RunContext& context) {
  Machine machine(context, Purpose::ToolPath);
  State state = machine.start(toolPath);
  const PathEnd end = machine.run(state);
  if (end == PathEnd::Asks) reportQuestion(machine, machine.question());
  if (end == PathEnd::Stopped) machine.reportOnce(makeDiagnostic<diag::ToolPathStopped>(machine.place()));
  if (end != PathEnd::Ended) return std::nullopt;
  if (const auto code = state.globals.find("CALLBACK_RETURNCODE"); code != state.globals.end()) {
    const auto fails = machine.isNonZero(state, code->second, state.returnCodeSet);
    if (!fails) reportQuestion(machine, machine.question());
    if (fails && *fails) machine.reportOnce(makeDiagnostic<diag::ReturnCodeSet>(state.returnCodeSet));
    if (!fails || *fails) return std::nullopt;
  }
  for (const Rejection& message : machine.messagesSince(state, kNoMessage)) {
    context.diagnostics.report<diag::MessageShown>(message.range, message.text);
  }
  return std::move(machine.moves());
}

std::string pathText(const std::vector<PathMove>& path) {
  std::string text;
  for (const PathMove& move : path) {
    switch (move.kind) {
    case PathMove::Kind::Feed:
      text += "feed(" + coordinateText(move.x) + "," + coordinateText(move.y) + "," + coordinateText(move.z) +
              ")";
      break;
    case PathMove::Kind::FeedX: text += "x " + coordinateText(move.x); break;
    case PathMove::Kind::FeedY: text += "y " + coordinateText(move.y); break;
    case PathMove::Kind::FeedZ: text += "z " + coordinateText(move.z); break;
    }
    text += '\n';
  }
  return text;
}

} // namespace dotek::frontend::gibbs
