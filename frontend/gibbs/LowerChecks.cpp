#include "frontend/gibbs/Lower.h"
#include "frontend/gibbs/LowerEmit.h"
#include "frontend/gibbs/LowerFlatten.h"
#include "support/messages/Gibbs.h"

#include <algorithm>
#include <map>

namespace dotek::frontend::gibbs {

namespace {

// A text of the dialog without its quotes, the unit in brackets at its end, and blanks.
std::string withoutUnit(std::string text) {
  const auto trim = [&] {
    const std::size_t from = text.find_first_not_of(" \t\""), to = text.find_last_not_of(" \t\"");
    text = from == std::string::npos ? "" : text.substr(from, to - from + 1);
  };
  trim();
  if (const std::size_t open = text.rfind('['); text.ends_with(']') && open != std::string::npos)
    text.resize(open);
  trim();
  return text;
}

// What both labels of an input say, UTF-8; the left one where it is more than the field's name or a symbol.
std::string meaningOf(const Field& field, std::string meaning, const SourceMap& sources) {
  constexpr std::size_t kSymbol = 2; // characters
  const InputLabel& label = *field.label;
  if (label.name.size() <= kSymbol || foldCase(label.name) == foldCase(field.name.text) ||
      !label.nameRange.hasPlace())
    return meaning;
  const std::string left = withoutUnit(sources.textUtf8(label.nameRange));
  return meaning.empty() || left.empty() ? left + meaning : left + ", " + meaning;
}

// Where the dialog says the same at the right of two fields, what it says at the left belongs to the meaning:
// X and Y of a point.
void addLeftLabels(ir::Cycle& cycle, const std::vector<Field>& fields, const SourceMap& sources) {
  std::map<std::string, std::size_t> said;
  for (const ir::Variable& variable : cycle.variables)
    ++said[variable.meaning];
  for (std::size_t i = 0; i < fields.size() && i < cycle.variables.size(); ++i) {
    ir::Variable& variable = cycle.variables[i];
    if (variable.meaning.empty() || said[variable.meaning] < 2) continue;
    const Field& field = fields[i];
    const std::string left = field.label && field.label->nameRange.hasPlace()
                                 ? withoutUnit(sources.textUtf8(field.label->nameRange))
                                 : "";
    variable.meaning = (left.empty() ? variable.name : left) + ", " + variable.meaning;
  }
}

} // namespace

ir::Cycle declareCycle(const Cycle& source, const SourceMap& sources) {
  ir::Cycle cycle;
  cycle.name = source.name;
  const auto utf8 = [&](const std::string& bytes) {
    return source.dialog ? toUtf8(bytes, sources.file(source.dialog->file).encoding()) : bytes;
  };
  if (source.dialog) {
    for (const Control& control : source.dialog->controls) {
      if (foldCase(control.kind.text) != "DIALOG" || !control.text) continue;
      cycle.title = utf8(*control.text);
      break;
    }
  }
  const std::vector<Field> fields = declaredFields(source);
  for (const Field& field : fields) {
    ir::Variable parameter;
    parameter.name = field.name.text;
    parameter.role = ir::Role::Parameter;
    parameter.defaultValue = field.value;
    // Digits that only an assumption makes a number are no layout to keep.
    if (field.value && field.assumption.empty()) parameter.defaultDigits = sources.textUtf8(field.valueRange);
    if (field.label) {
      parameter.unit = utf8(field.label->unit);
      parameter.meaning = meaningOf(field, utf8(field.label->meaning), sources);
    }
    parameter.range = field.name.range;
    cycle.add(std::move(parameter));
  }
  addLeftLabels(cycle, fields, sources);
  for (const auto* macro :
       {source.toolPath ? &*source.toolPath : nullptr, source.cycleData ? &*source.cycleData : nullptr})
    if (macro != nullptr && !cycle.range.hasPlace()) cycle.range = {macro->file, 0, 0};
  return cycle;
}

namespace {

// Reports what cannot be translated; false where something is.
bool report(const WalkResult& walk, LowerContext& context) {
  for (const Diagnostic& refusal : walk.refusals)
    context.diagnostics.add(refusal);
  return walk.refusals.empty();
}

// A macro that calls itself without a condition: place of the CALL that shows the dialog a second time. One
// under a condition rejects values. kNowhere: some path passes, or none is such.
std::size_t selfCall(const Flat& flat, const WalkResult& walk) {
  std::size_t found = kNowhere;
  for (std::size_t at = 0; at < flat.steps.size(); ++at) {
    const auto* end = std::get_if<FlatEnd>(&flat.steps[at].step);
    if (!walk.reached[at] || end == nullptr) continue;
    if (!end->rejects) return kNowhere;
    if (end->again && found == kNowhere) found = at;
  }
  const bool passes =
      std::any_of(walk.ends.begin(), walk.ends.end(), [](const auto& end) { return end.second.passes; });
  return passes ? kNowhere : found;
}

} // namespace

bool lowerChecks(const Macro& cycleData, ir::Cycle& cycle, LowerContext& context) {
  const Flat flat = Flattener(cycle, context, Purpose::Checks).flatten(cycleData);
  WalkOptions options;
  options.unsetZero = context.assumptions.contains("unset-zero");
  WalkResult walk = Walk(flat, cycle, context.limits, options).run();
  if (!walk.complete) {
    // Too many paths with all that the conditions tell; the values that the macro sets are often enough.
    options.facts = false;
    walk = Walk(flat, cycle, context.limits, options).run();
  }
  if (!walk.complete) {
    context.diagnostics.report<diag::TooManyPaths>({cycleData.file, 0, 0}, context.limits.paths);
    return false;
  }
  if (!report(walk, context)) return false;
  if (const std::size_t call = selfCall(flat, walk); call != kNowhere) {
    context.diagnostics.report<diag::CallTooDeep>(flat.steps[call].range, context.limits.callDepth);
    return false;
  }
  // Nothing gets past an alarm, so that after one fewer paths are left for the messages that follow.
  for (bool found = true; found && walk.complete;) {
    found = false;
    for (const auto& [at, ends] : walk.behind)
      if (!ends.passes && options.alarms.insert(at).second) found = true;
    if (found) walk = Walk(flat, cycle, context.limits, options).run();
  }
  bool ok = true;
  for (const auto& [at, ends] : walk.behind) {
    if (options.alarms.contains(at) || !ends.rejects) continue;
    context.diagnostics.report<diag::MessagePaths>(flat.steps[at].range);
    ok = false;
  }
  if (!ok) return false;
  if (const std::size_t endless = endlessStep(flat, walk, options.alarms); endless != kNowhere) {
    context.diagnostics.report<diag::GoesRoundForEver>(flat.steps[endless].range);
    return false;
  }
  for (const auto& [at, ends] : walk.behind) {
    const auto& message = std::get<FlatMessage>(flat.steps[at].step);
    const SourceRange range = flat.steps[at].range;
    if (!options.alarms.contains(at)) {
      context.diagnostics.report<diag::MessageInforms>(range, message.text);
    } else if (message.computed) {
      context.diagnostics.report<diag::MessageComputed>(range, message.text);
    }
  }
  cycle.checks = emitStatements(flat, walk, {options.alarms, options.unsetZero, nullptr}, cycle);
  return true;
}

} // namespace dotek::frontend::gibbs
