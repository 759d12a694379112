#include "backends/cycle/Emit.h"

#include "backends/cycle/Idioms.h"
#include "ir/Fold.h"
#include "ir/Positions.h"
#include "ir/Walk.h"
#include "support/Decimal.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::backends::cycle {

namespace {

std::string lowered(std::string_view text) {
  std::string out;
  for (const char c : text)
    out += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}

bool hasPlaceInLanguage(const State& state, ir::VariableId id) {
  const std::string& name = state.names.at(id);
  static constexpr std::string_view kOwn[] = {"ball_radius", "overtravel", "approach_feed", "measuring_feed",
                                              "retract",     "start.x",    "start.y",       "start.z",
                                              "here.x",      "here.y",     "here.z"};
  return std::find(std::begin(kOwn), std::end(kOwn), name) != std::end(kOwn);
}

// What the dialog offers: "1 from the left, 2 from the right".
std::string offered(const std::vector<Choice>& choices) {
  std::string out;
  for (const Choice& one : choices)
    out += fmt::format("{}{} {}", out.empty() ? "" : ", ", numberText(one.value), one.title);
  return out;
}

EmittedLine parameterLine(State& state, ir::VariableId id, Emitted& out) {
  const ir::Variable& variable = state.cycle.variable(id);
  const std::string& name = state.names.at(id);
  ir::Kind kind = variable.kind == ir::Kind::Number ? ir::Kind::Ratio : variable.kind;
  if (kind == ir::Kind::Text)
    state.refuse(variable.range, "a text as a parameter", "make a choice of names of it");
  const auto found = state.shifts.find(id);
  const double shift = found == state.shifts.end() ? 0 : found->second;
  const auto chosen = state.choices.find(id);
  const bool named = chosen != state.choices.end();
  out.parameters[variable.name] = {name, shift, named ? chosen->second.size() : 0};
  std::string initial;
  if (named && variable.defaultValue) {
    initial = " = " + chosen->second[static_cast<std::size_t>(*variable.defaultValue) - 1];
  } else if (variable.defaultValue) {
    const double value = *variable.defaultValue + shift;
    const bool fits =
        kind != ir::Kind::WorkOffset || (value >= 54 && value <= 59 && value == std::floor(value));
    if (fits)
      initial = " = " + literal(value, kind, shift == 0 ? variable.defaultDigits : "");
    else
      state.note(variable.range, fmt::format("the first value of `{}`", variable.name),
                 "it is none of G54 to G59, so the caller has to give one");
  }
  std::string title = variable.meaning;
  const auto choices = state.options.choices.find(id);
  const bool list = !named && choices != state.options.choices.end() && kind != ir::Kind::Flag &&
                    kind != ir::Kind::WorkOffset;
  if (list) title += (title.empty() ? "" : ": ") + offered(choices->second);
  const bool renamed = lowered(variable.name) != name && variable.role == ir::Role::Parameter;
  if (renamed) title += fmt::format("{}({})", title.empty() ? "" : " ", variable.name);
  std::string type = typeOf(kind);
  if (named) {
    type = "choice of ";
    for (const std::string& one : chosen->second)
      type += (type.ends_with("of ") ? "" : ", ") + one;
  }
  std::string line = fmt::format("parameter {} : {}{}{}", name, type, initial, quoted(title));
  if (list) {
    std::string condition;
    for (const Choice& one : choices->second)
      condition += fmt::format("{}{} is {}", condition.empty() ? "" : " or ", name, literal(one.value, kind));
    line += " require " + condition;
  }
  return {line, {variable.range}, ""};
}

// Parameters that nobody reads stay: their caller gives them.
void writeParameters(State& state, Emitted& out, std::vector<EmittedLine>& lines) {
  for (const ir::Role role : {ir::Role::Parameter, ir::Role::Host})
    for (ir::VariableId id = 0; id < state.cycle.variables.size(); ++id) {
      if (state.cycle.variable(id).role != role) continue;
      const bool used = ir::uses(state.cycle, id);
      if (role == ir::Role::Host && (!used || hasPlaceInLanguage(state, id))) continue;
      if (!used && state.options.fixed.contains(id)) continue;
      lines.push_back(parameterLine(state, id, out));
    }
}

void append(std::vector<EmittedLine>& to, std::vector<EmittedLine>& from, bool blank) {
  if (from.empty()) return;
  if (blank && !to.empty()) to.push_back({"", {}, ""});
  std::move(from.begin(), from.end(), std::back_inserter(to));
  from.clear();
}

std::vector<EmittedLine> requirements(State& state, const Checked& checked) {
  std::vector<EmittedLine> out;
  for (const Requirement& one : checked.requirements) {
    const ir::Origin& origin = one.alarm->origin;
    const std::string condition = conditionText(state, one.condition, origin.range());
    if (condition.empty()) continue;
    std::vector<SourceRange> ranges = origin.ranges;
    if (one.range.hasPlace()) ranges.push_back(one.range);
    out.push_back(
        {fmt::format("require {}{}", condition, quoted(std::get<ir::Alarm>(one.alarm->node).message)),
         std::move(ranges), ""});
  }
  return out;
}

// What lists offer of the work offsets: the type is G54 to G59, so a list of all six says nothing. They come
// after the checks, as the values of a list do in the dialog.
void offeredSystems(State& state, const Emitted& out, std::vector<EmittedLine>& lines) {
  for (const auto& [id, choices] : state.options.choices) {
    const ir::Variable& variable = state.cycle.variable(id);
    if (variable.kind != ir::Kind::WorkOffset || variable.role != ir::Role::Parameter) continue;
    const auto found = out.parameters.find(variable.name);
    if (found == out.parameters.end()) continue;
    const auto counted = state.shifts.find(id);
    std::set<double> systems;
    for (const Choice& one : choices) {
      const double value = one.value + (counted == state.shifts.end() ? 0 : counted->second);
      if (value >= 54 && value <= 59 && value == std::floor(value)) systems.insert(value);
    }
    if (systems.empty() || systems.size() == 6) continue;
    std::string condition;
    for (const double value : systems)
      condition += fmt::format("{}{} is {}", condition.empty() ? "" : " or ", state.names.at(id),
                               literal(value, ir::Kind::WorkOffset));
    lines.push_back({fmt::format("require {}{}", condition, quoted(variable.name + " is not in its list")),
                     {variable.range},
                     ""});
  }
}

// What the checks compute for the body.
std::vector<EmittedLine> locals(State& state, const Checked& checked) {
  std::set<ir::VariableId> read;
  for (const ir::CycleStatement& statement : state.cycle.body)
    ir::eachNode(statement, [&](const ir::Expression& node) {
      if (const auto* use = std::get_if<ir::VariableUse>(&node.node)) read.insert(use->variable);
    });
  std::vector<EmittedLine> out;
  for (const auto& [id, value] : checked.locals) {
    if (!read.contains(id)) continue;
    const std::string text = valueText(state, value, state.cycle.variable(id).kind, value->range);
    if (!text.empty()) out.push_back({fmt::format("{} = {}", state.names.at(id), text), {value->range}, ""});
  }
  return out;
}

bool names(const std::string& text, const std::string& name) {
  const auto isName = [](char c) { return c == '_' || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); };
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at == 0 || !isName(text[at - 1])) && (end == text.size() || !isName(text[end]))) return true;
  }
  return false;
}

// Values that were named in case something reads them, and nothing does.
void dropUnread(State& state) {
  for (const std::string& name : state.helpers) {
    const auto reads = std::count_if(state.lines.begin(), state.lines.end(),
                                     [&](const EmittedLine& one) { return names(one.text, name); });
    if (reads == 1) std::erase_if(state.lines, [&](const EmittedLine& one) { return names(one.text, name); });
  }
}

} // namespace

std::optional<Emitted> emit(const ir::Cycle& cycle, const EmitOptions& options, Diagnostics& diagnostics) {
  State state(cycle, options, diagnostics);
  if (!cycle.measurementStated)
    state.refuse(cycle.range, "a drawn path without its branch of a post",
                 "a path does not say what is measured; give the post with `--prog PROG.txt`");
  readIdioms(state);
  findChoices(state);
  nameVariables(state);
  Emitted out;
  out.name = options.proposeName(cycle.name);
  const std::optional<Checked> checked = readChecks(state);
  if (checked) nameSystems(state, *checked);
  std::vector<EmittedLine> parameters;
  writeParameters(state, out, parameters);
  std::vector<EmittedLine> required, computed;
  if (checked) {
    required = requirements(state, *checked);
    computed = locals(state, *checked);
  }
  offeredSystems(state, out, required);
  writeBody(state);
  dropUnread(state);
  if (state.failed) return std::nullopt;

  std::vector<EmittedLine>& lines = out.lines;
  const bool switches = std::any_of(cycle.body.begin(), cycle.body.end(), [](const ir::CycleStatement& one) {
    const auto* power = std::get_if<ir::ProbePower>(&one.node);
    return power != nullptr && power->on;
  });
  const bool probes = std::any_of(cycle.body.begin(), cycle.body.end(),
                                  [](const ir::CycleStatement& one) { return ir::probes(one); });
  const std::string title = cycle.title.empty() ? cycle.name : cycle.title;
  lines.push_back(
      {fmt::format("// {}: the cycle {} of the CAM with its branch of the post.", title, cycle.name),
       {cycle.range},
       ""});
  lines.push_back({fmt::format("cycle {}{}", out.name, quoted(title)), {cycle.range}, ""});
  if (probes && !switches) lines.push_back({"", {}, ""});
  if (probes && !switches) lines.push_back({"needs probe", {}, "the source leaves the probe to its caller"});
  append(lines, parameters, true);
  std::vector<EmittedLine> results;
  for (const auto& [name, kind] : state.results)
    results.push_back(
        {fmt::format("result {} : {}{}", name, typeOf(kind), quoted(state.resultTitles[name])), {}, ""});
  append(lines, results, true);
  append(lines, required, true);
  std::sort(state.named.begin(), state.named.end(),
            [](const EmittedLine& a, const EmittedLine& b) { return a.text < b.text; });
  std::vector<EmittedLine> values = std::move(state.named);
  append(values, computed, false);
  append(lines, values, true);
  append(lines, state.lines, true);
  for (const auto& [number, name] : state.kept)
    out.kept.emplace_back(name, number);
  return out;
}

} // namespace dotek::backends::cycle
