// Head, properties, and what the function reads at its beginning.
#include "backends/fusion/State.h"
#include "ir/Kind.h"
#include "support/Decimal.h"
#include "support/messages/Fusion.h"

#include <algorithm>
#include <cctype>

namespace dotek::backends::fusion {

namespace {

constexpr int kFirstRevision = 45811; // properties as objects, of operations too

// What stands for a host input when the post runs. nullptr: nothing does.
struct HostText {
  std::string_view host;
  std::string_view text;
  std::string_view local;
};
constexpr HostText kHosts[] = {
    {"start_x", "x", "x"},
    {"start_y", "y", "y"},
    {"start_z", "z", "z"},
    {"tool_radius", "tool.diameter / 2", "toolRadius"},
    {"tool_number", "tool.number", "toolNumber"},
    {"tool_offset", "tool.lengthOffset", "toolOffset"},
    {"clearance", "cycle.clearance", "clearance"},
    {"retract", "cycle.retract", "retract"},
};

const HostText* hostText(const std::string& name) {
  const auto found = std::find_if(std::begin(kHosts), std::end(kHosts),
                                  [&](const HostText& one) { return one.host == name; });
  return found == std::end(kHosts) ? nullptr : found;
}

bool isWhole(ir::Kind kind) {
  return kind == ir::Kind::WorkOffset || kind == ir::Kind::ToolOffset || kind == ir::Kind::Count;
}

bool isField(const State& state, ir::VariableId id) {
  if (state.cycle.variable(id).role != ir::Role::Parameter || state.options.fixed.contains(id)) return false;
  const auto& call = state.options.call;
  return !call || std::any_of(call->arguments.begin(), call->arguments.end(),
                              [&](const ProgramCall::Argument& one) { return one.variable == id; });
}

// The key of a field's group: that of the cycle, or one of its own.
std::string groupKey(const State& state, ir::VariableId id) {
  const auto found = state.options.groups.find(id);
  if (found == state.options.groups.end() || found->second.empty()) return state.prefix;
  std::set<std::string> names;
  for (const auto& [other, name] : state.options.groups)
    if (!name.empty()) names.insert(name);
  return state.prefix + "Group" + std::to_string(std::distance(names.begin(), names.find(found->second)) + 1);
}

const std::vector<Choice>* choicesOf(const State& state, ir::VariableId id) {
  const auto found = state.options.choices.find(id);
  return found == state.options.choices.end() || found->second.empty() ? nullptr : &found->second;
}

std::string propertyName(const State& state, const ir::Variable& variable) {
  return propertyOf(state.prefix, variable.name);
}

void writeProperty(State& state, ir::VariableId id) {
  const ir::Variable& variable = state.cycle.variable(id);
  ir::Origin origin;
  origin.ranges = {variable.range};
  const auto* choices = choicesOf(state, id);
  const auto given = state.options.defaults.find(id);
  const auto value =
      given == state.options.defaults.end() ? variable.defaultValue : std::optional(given->second);
  const std::string unit = !variable.unit.empty() ? variable.unit
                           : state.options.call   ? std::string(ir::kindUnit(variable.kind))
                                                  : std::string();
  if (isReserved(variable.name)) state.diagnostics.report<diag::ReservedName>(variable.range, variable.name);
  if (isWhole(variable.kind) && value && *value != static_cast<double>(static_cast<long long>(*value)))
    state.refuse<diag::NotWhole>(variable.range, variable.name, numberText(*value));
  const std::string group = groupKey(state, id);
  if (mayBeLeftOut(state, id)) {
    state.script.open("properties." + givingPropertyOf(state.prefix, variable.name) + " = {", origin);
    state.script.add(
        "title: " + quoted("Give: " + (variable.meaning.empty() ? variable.name : variable.meaning)) + ",");
    state.script.add("description: " +
                     quoted("Whether " + variable.name + " of " + state.cycle.name +
                            " is given; else it is left out of the call") +
                     ",");
    state.script.add("group: " + quoted(group) + ",");
    state.script.add("type: \"enum\",");
    state.script.add("values: [{title: \"no\", id: \"0\"}, {title: \"yes\", id: \"1\"}],");
    state.script.add("value: \"0\",");
    state.script.add("scope: \"operation\"");
    state.script.close("};");
  }
  state.script.open("properties." + propertyName(state, variable) + " = {", origin);
  state.script.add("title: " + quoted(variable.meaning.empty() ? variable.name : variable.meaning) + ",");
  state.script.add(
      "description: " +
      quoted(variable.name + " of " + state.cycle.name + (unit.empty() ? std::string() : ", " + unit)) + ",");
  state.script.add("group: " + quoted(group) + ",");
  state.script.add(std::string("type: ") +
                   (choices != nullptr       ? "\"enum\""
                    : isWhole(variable.kind) ? "\"integer\""
                                             : "\"number\"") +
                   ",");
  if (choices != nullptr) {
    state.script.open("values: [");
    for (std::size_t i = 0; i < choices->size(); ++i)
      state.script.add("{title: " + quoted((*choices)[i].title) + ", id: " +
                       quoted(numberText((*choices)[i].value)) + "}" + (i + 1 < choices->size() ? "," : ""));
    state.script.close("],");
  }
  if (value)
    state.script.add(
        "value: " + (choices != nullptr ? quoted(numberText(*value)) : numberLiteral(*value)) + ",", origin);
  state.script.add("scope: \"operation\"");
  state.script.close("};");
}

} // namespace

std::string propertyOf(std::string_view prefix, std::string_view field) {
  std::string name;
  for (const char c : field)
    name +=
        static_cast<unsigned char>(c) < 0x80 && std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return std::string(prefix) + "_" + name;
}

std::string givingPropertyOf(std::string_view prefix, std::string_view field) {
  return propertyOf(prefix, "give_" + std::string(field));
}

ir::VariableId State::host(std::string_view wanted) {
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id)
    if (cycle.variable(id).role == ir::Role::Host && cycle.variable(id).name == wanted) return id;
  ir::Variable added;
  added.name = std::string(wanted);
  added.role = ir::Role::Host;
  added.kind = ir::Kind::Length;
  return cycle.add(std::move(added));
}

const std::string& State::name(ir::VariableId id) {
  const ir::Variable& variable = cycle.variable(id);
  if (variable.role != ir::Role::Local) read.insert(id);
  if (const auto found = named.find(id); found != named.end()) return found->second;
  const HostText* known = variable.role == ir::Role::Host ? hostText(variable.name) : nullptr;
  if (known != nullptr && known->text == known->local) return named.emplace(id, known->text).first->second;
  const std::string wanted(known != nullptr ? known->local : std::string_view(variable.name));
  return named.emplace(id, names.take(wanted)).first->second;
}

void State::errorIf(const std::string& condition, std::string_view text, const ir::Origin& origin) {
  script.open("if (" + condition + ") {", origin);
  script.add("error(localize(" + quoted(cycle.name + ": " + std::string(text)) + "));", origin);
  script.add("return;", origin);
  script.close();
}

void writeHead(State& state) {
  Script& script = state.script;
  const ir::Cycle& cycle = state.cycle;
  script.comment(cycle.name + (cycle.title.empty() ? "" : " (" + cycle.title + ")") +
                 ": a probing cycle as a part of a Fusion post. Macros of " + state.options.macros.title +
                 ". Millimetres.");
  if (state.options.call) {
    const std::string program = "O" + std::to_string(state.options.call->number);
    script.comment("The blocks go to the point and call the program " + program + ", written for " +
                   state.options.control.title + ". onClose ends, after M30, with  " + state.prefix +
                   "_close();  which writes that program into the same file where an operation calls it. A "
                   "control that runs the file without taking it into its memory needs " +
                   program + " there beforehand.");
  }
  script.comment("minimumRevision: " + std::to_string(kFirstRevision));
  script.comment(
      "Needs of the post: writeBlock(text), which puts the block number before; xOutput, yOutput, zOutput, "
      "feedOutput, gMotionModal, which are reset after the macros. Comments go through writeComment(text) "
      "where the post has it. Kernel: writeln, error, warning, "
      "localize, createFormat" +
      std::string(state.options.call ? "." : ", isFirstCyclePoint."));
  script.comment("Dispatch: onCyclePoint(x, y, z) begins with  if (" + state.prefix +
                 "_dispatch(x, y, z)) { return; }");
  script.comment(
      "The operation is a drilling operation with the probe as its tool; a probing operation is an "
      "error. It chooses the cycle "
      "with the property "
      "dotekCycle. Its point is where the cycle starts, in "
      "the work system of the operation.");
  if (state.options.helpersApart)
    script.comment(
        "The functions dotekShared_.. are in the file of --helpers, pasted once before this part.");
  if (!state.options.macros.needs.empty())
    script.comment("Set before the first call of a macro: " + state.options.macros.needs);
  if (!state.options.fixedByName.empty()) {
    std::string fixed;
    for (const auto& [name, value] : state.options.fixedByName)
      fixed += (fixed.empty() ? "" : ", ") + name + " = " + numberText(value);
    script.comment("Fixed when converted: " + fixed);
  }
  script.blank();
}

void writeProperties(State& state) {
  Script& script = state.script;
  script.open("if (properties.dotekCycle === undefined) {");
  script.open("properties.dotekCycle = {");
  script.add("title: \"Probing cycle\",");
  script.add("description: \"Cycle that the operation prints\",");
  script.add("group: \"dotek\",");
  script.add("type: \"enum\",");
  script.add("values: [{title: \"none\", id: \"none\"}],");
  script.add("value: \"none\",");
  script.add("scope: \"operation\"");
  script.close("};");
  script.close();
  const std::string& title = state.cycle.title.empty() ? state.cycle.name : state.cycle.title;
  script.open("if (typeof groupDefinitions === \"undefined\") {");
  script.add("groupDefinitions = {};");
  script.close();
  script.add("groupDefinitions.dotek = {title: \"Probing cycle\", order: 100};");
  script.add("groupDefinitions." + state.prefix + " = {title: " + quoted("Probing: " + title) +
             ", order: 101};");
  script.add("properties.dotekCycle.values.push({title: " + quoted(title) + ", id: " + quoted(state.prefix) +
             "});");
  std::map<std::string, std::string> groups;
  for (const auto& [id, name] : state.options.groups)
    if (!name.empty()) groups.emplace(groupKey(state, id), name);
  int order = 101;
  for (const auto& [key, name] : groups)
    script.add("groupDefinitions." + key + " = {title: " + quoted("Probing: " + title + ", " + name) +
               ", order: " + std::to_string(++order) + "};");
  std::set<std::string> taken;
  for (ir::VariableId id = 0; id < state.cycle.variables.size(); ++id) {
    if (!isField(state, id)) continue;
    const ir::Variable& variable = state.cycle.variable(id);
    const bool alone =
        !mayBeLeftOut(state, id) || taken.insert(givingPropertyOf(state.prefix, variable.name)).second;
    if (!taken.insert(propertyName(state, variable)).second || !alone) {
      state.refuse<diag::PropertyTwice>(variable.range, variable.name, propertyName(state, variable));
      continue;
    }
    writeProperty(state, id);
  }
  script.blank();
}

void writeReading(State& state) {
  Script& script = state.script;
  // Whoever is named first keeps a name without `_` after it: the order of the declarations.
  for (const ir::VariableId id : state.read) {
    const ir::Variable& variable = state.cycle.variable(id);
    if (variable.role == ir::Role::Parameter) {
      const std::string get = "currentSection.getProperty(" + quoted(propertyName(state, variable)) + ")";
      ir::Origin origin;
      origin.ranges = {variable.range};
      const bool length = choicesOf(state, id) == nullptr && !isWhole(variable.kind);
      const std::string value = length ? state.helper(Helper::Given) + "(" + get + ")"
                                : choicesOf(state, id) != nullptr ? "Number(" + get + ")"
                                                                  : get;
      const std::string giving = "Number(currentSection.getProperty(" +
                                 quoted(givingPropertyOf(state.prefix, variable.name)) + ")) === 1";
      script.add("var " + state.name(id) + " = " +
                     (mayBeLeftOut(state, id) ? giving + " ? " + value + " : undefined" : value) + ";",
                 origin);
      if (mayBeLeftOut(state, id))
        state.errorIf(giving + " && !" + state.helper(Helper::IsNumber) + "(" + state.name(id) + ")",
                      variable.name + " is no number", {});
      continue;
    }
    const HostText* host = hostText(variable.name);
    if (host == nullptr) {
      state.refuse<diag::HostNotInPost>(state.cycle.range, variable.name);
      continue;
    }
    const bool argument = host->text == host->local;
    if (!argument || !isWhole(variable.kind))
      script.add((argument ? "" : "var ") + state.name(id) + " = " +
                 (isWhole(variable.kind)
                      ? std::string(host->text)
                      : state.helper(Helper::Given) + "(" + std::string(host->text) + ")") +
                 ";");
  }
  state.errorIf("unit !== MM", "the cycle is written in millimetres, the document is not", {});
  for (const ir::VariableId id : state.read) {
    const ir::Variable& variable = state.cycle.variable(id);
    const HostText* host = variable.role == ir::Role::Host ? hostText(variable.name) : nullptr;
    const std::string what = host != nullptr ? std::string(host->text) : variable.name;
    const bool absent = mayBeLeftOut(state, id);
    if (!absent)
      state.errorIf("!" + state.helper(Helper::IsNumber) + "(" + state.name(id) + ")", what + " is no number",
                    {});
    // A number that cannot be meant, as the command line refuses it.
    if (host != nullptr && variable.name == "tool_radius")
      state.errorIf(state.name(id) + " <= 0", what + " is not above 0", {});
    if (isWhole(variable.kind))
      state.errorIf((absent ? state.name(id) + " !== undefined && " : "") + state.name(id) + " % 1 !== 0",
                    what + " is no whole number", {});
    if (state.options.call && variable.kind == ir::Kind::WorkOffset)
      state.errorIf(state.name(id) + " < 54 || " + state.name(id) + " > 59",
                    what + " is the number of a work offset, 54 to 59", {});
  }
  for (const auto& [name, value] : state.options.fixedByName) {
    const HostText* host = hostText(name);
    if (host == nullptr || host->text != host->local) continue;
    state.errorIf("Math.abs(" + std::string(host->text) + " - " + numberLiteral(value, true) + ") > " +
                      std::string(kHalfDigit),
                  "converted for a start at " +
                      std::string(1, static_cast<char>(std::toupper(host->text[0]))) + numberText(value),
                  {});
  }
}

} // namespace dotek::backends::fusion
