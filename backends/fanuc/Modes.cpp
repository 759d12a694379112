// The modal groups that the program changes: kept in locals, set, put back.
#include "backends/fanuc/State.h"
#include "support/messages/Fanuc.h"

#include <algorithm>

namespace dotek::backends::fanuc {

namespace {

using stdlib::Function;

ir::Origin made(std::string reason) {
  ir::Origin out;
  out.reason = std::move(reason);
  return out;
}

bool setsWorkSystem(const ir::Cycle& cycle) {
  return std::any_of(cycle.body.begin(), cycle.body.end(), [](const ir::CycleStatement& statement) {
    const auto* mode = std::get_if<ir::SetMode>(&statement.node);
    return mode != nullptr && mode->mode == ir::Mode::WorkSystem;
  });
}

} // namespace

std::vector<SavedMode> planModes(State& state) {
  // What calls it within its file counts on these modes, too, and puts its own caller's back.
  const bool called = state.options.calledFrom.has_value();
  std::vector<Function> groups;
  if (!called) groups = {Function::Rapid, Function::PlaneXY, Function::Absolute, Function::FeedPerMinute};
  if (setsWorkSystem(state.cycle) || state.copied.workSystem) groups.push_back(Function::WorkSystem);
  std::vector<SavedMode> out;
  const auto take = [&](const stdlib::CodeInfo* code) {
    const std::uint32_t local = state.pool.take();
    if (local == 0)
      state.refuse<diag::TooManyLocals>(state.cycle.range, "a modal group", state.control.locals);
    out.push_back({code, local});
  };
  std::string lost;
  std::vector<const stdlib::CodeInfo*> codes;
  for (const Function function : groups)
    codes.push_back(state.control.find(function));
  codes.insert(codes.end(), state.copied.groups.begin(), state.copied.groups.end());
  for (const auto* code : codes) {
    if (code == nullptr) continue; // no such group
    const bool plane = code->function == Function::PlaneXY;
    if (code->group && state.control.variables.modalFirst && !(plane && state.copied.staysTurned))
      take(code);
    else
      lost += " " + codeText(*code);
  }
  if (called) return out;
  if (state.control.variables.modalFeed)
    take(nullptr);
  else
    lost += " F";
  if (!lost.empty()) state.remarks.push_back("CHANGED AND NOT PUT BACK, GROUP OF:" + lost);
  return out;
}

void writeModes(State& state, const std::vector<SavedMode>& saved) {
  for (const SavedMode& mode : saved) {
    const int variable = mode.code == nullptr ? *state.control.variables.modalFeed
                                              : *state.control.variables.modalFirst + *mode.code->group;
    state.sheet.add("#" + std::to_string(mode.local) + "=#" + std::to_string(variable), made("mode kept"));
  }
  std::string text;
  for (const Function function : {Function::Absolute, Function::FeedPerMinute, Function::PlaneXY,
                                  Function::CutterCompOff, Function::CannedCycleOff})
    if (const auto* code = state.control.find(function)) text += (text.empty() ? "" : " ") + codeText(*code);
  if (!text.empty()) state.sheet.add(text, made("modes of the program"));
}

void restoreModes(State& state, const std::vector<SavedMode>& saved) {
  std::string text;
  for (const SavedMode& mode : saved) {
    text += text.empty() ? "" : " ";
    text += (mode.code == nullptr ? "F#" : "G#") + std::to_string(mode.local);
  }
  if (!text.empty()) state.sheet.add(text, made("modes put back"));
}

} // namespace dotek::backends::fanuc
