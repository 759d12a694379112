// Which variable holds what a macro measured, and keeping it where a later call would overwrite it.
#include "backends/common/MacroCall.h"
#include "backends/fanuc/State.h"
#include "backends/fanuc/Uses.h"
#include "ir/Flow.h"
#include "ir/Walk.h"
#include "support/messages/Fanuc.h"

#include <algorithm>

namespace dotek::backends::fanuc {

namespace {

// Beyond this, every result is kept.
constexpr std::size_t kMostStatements = 2000;

// The variable that every signature of the set names for the result; nothing where they differ.
std::optional<std::uint32_t> common(const stdlib::MacroSet& macros, ir::ResultName name) {
  std::optional<std::uint32_t> out;
  for (const stdlib::MacroSignature& signature : macros.signatures) {
    const auto* result = findResult(signature, name);
    if (result == nullptr) continue;
    if (out && *out != result->variable) return std::nullopt;
    out = result->variable;
  }
  return out;
}

bool callsMacro(const State& state, const ir::CycleStatement& statement) {
  return match(
      statement, [](const ir::Move& node) { return node.motion == ir::Motion::Protected; },
      [&](const ir::ProbePower& node) {
        return state.macros.find(node.on ? stdlib::Intent::ProbeOn : stdlib::Intent::ProbeOff) != nullptr;
      },
      [](const ir::OneOf<ir::Measure, ir::OpaqueBlock> auto&) { return true; },
      [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Comment, ir::Assign, ir::Return,
                         ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop, ir::Alarm> auto&) {
        return false;
      });
}

// Whether a call of a macro may appear between the measurement and the use.
bool overwritten(const State& state, std::size_t measure, std::size_t use) {
  if (state.cycle.body.size() > kMostStatements) return true;
  auto next = ir::successors(state.cycle.body);
  const auto first = next[measure];
  next[measure].clear(); // through it the result is another one
  std::vector<std::vector<std::size_t>> from = next;
  from[measure] = first;
  const auto behind = reachableFrom(from, measure);
  for (std::size_t i = 0; i < state.cycle.body.size(); ++i) {
    if (i == measure || i == use || !behind[i] || !callsMacro(state, state.cycle.body[i])) continue;
    if (reachableFrom(next, i)[use]) return true;
  }
  return false;
}

} // namespace

void planResults(State& state, Body& body) {
  const auto& list = state.cycle.body;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const ir::Measure* last = body.last[i];
    if (last == nullptr) continue;
    std::set<ir::ResultName> names;
    ir::eachNode(list[i], [&](const ir::Expression& node) {
      if (const auto* result = std::get_if<ir::MeasuredResult>(&node.node)) names.insert(result->name);
    });
    if (names.empty()) continue;
    const auto at = std::find_if(list.begin(), list.end(), [&](const ir::CycleStatement& statement) {
      return std::get_if<ir::Measure>(&statement.node) == last;
    });
    if (!overwritten(state, static_cast<std::size_t>(at - list.begin()), i)) continue;
    for (const ir::ResultName name : names) {
      if (body.kept.contains({last, name})) continue;
      const std::uint32_t local = state.pool.take();
      if (local == 0)
        state.refuse<diag::TooManyLocals>(list[i].origin.range(), resultName(name), state.control.locals);
      body.kept[{last, name}] = local;
    }
  }
}

namespace {

// The macro's own variable for a result of the measurement; nothing where it was refused.
std::optional<std::uint32_t> variableOf(State& state, ir::ResultName name, const ir::Measure* measure,
                                        SourceRange range) {
  if (measure == nullptr) {
    if (const auto shared = common(state.macros, name)) return shared;
  } else if (const auto* signature = signatureOf(state.macros, *measure)) {
    const FoundResult found = resultAfter(*signature, *measure, name);
    if (found.instead)
      state.diagnostics.report<diag::ResultDiffers>(range, found.result->variable, state.macros.title,
                                                    resultName(*found.instead));
    if (found.result != nullptr) return found.result->variable;
  }
  state.refuse<diag::ResultUnknown>(range, state.macros.title, resultName(name));
  return std::nullopt;
}

} // namespace

void keepResults(State& state, const ir::Measure& measure, const ir::Origin& given) {
  for (const auto& [key, local] : state.body->kept) {
    if (key.first != &measure) continue;
    ir::Origin origin;
    origin.ranges = given.ranges;
    origin.reason = "kept before the next call overwrites it";
    if (const auto variable = variableOf(state, key.second, &measure, origin.range()))
      state.sheet.add("#" + std::to_string(local) + "=#" + std::to_string(*variable), origin);
  }
}

std::string resultText(State& state, ir::ResultName name, SourceRange range) {
  const ir::Measure* measure = state.body == nullptr ? nullptr : state.body->last[state.at];
  if (measure != nullptr)
    if (const auto kept = state.body->kept.find({measure, name}); kept != state.body->kept.end())
      return "#" + std::to_string(kept->second);
  if (state.body == nullptr) {
    state.refuse<diag::ResultUnknown>(range, state.macros.title, resultName(name));
    return "#0";
  }
  const auto variable = variableOf(state, name, measure, range);
  return variable ? "#" + std::to_string(*variable) : "#0";
}

} // namespace dotek::backends::fanuc
