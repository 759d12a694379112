// The comments before the first block: what a machinist needs to call the program.
#include "backends/common/MacroCall.h"
#include "backends/common/PlainText.h"
#include "backends/fanuc/Example.h"
#include "backends/fanuc/State.h"
#include "backends/fanuc/Uses.h"
#include "ir/Walk.h"
#include "stdlib/HostInputs.h"
#include "support/Decimal.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace dotek::backends::fanuc {

namespace {

constexpr std::size_t kTitleWidth = 24;
constexpr std::size_t kLeastMeaning = 16;

using Row = std::vector<std::string>;

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

std::string withPoint(double value) {
  std::string text = numberText(Decimal::of(value).rounded(6).value());
  if (text.find('.') == std::string::npos) text += '.';
  return text;
}

class Header {
public:
  explicit Header(State& state) : state_(state) {}

  Sheet write() {
    if (!state_.options.calledFrom) out_.add("%", origin("begin of the file"));
    out_.add("O" + number() + "(" + title() + ")", origin("program number"));
    if (isCut()) say(wholeTitle());
    if (!state_.cycle.title.empty()) say("CYCLE " + state_.cycle.name);
    if (state_.options.calledFrom) return writeCalled();
    say("FOR " + state_.control.title +
        (state_.macros.name.empty() ? "" : ", MACROS OF " + state_.macros.title));
    if (!state_.cycle.measurementStated)
      say("THE SOURCE STATES A PATH ONLY: NO OFFSET IS SET BY THIS PROGRAM");
    table();
    legends();
    effects();
    computed();
    call();
    fixed();
    requirements();
    return end();
  }

private:
  Sheet end() {
    alarms();
    for (const std::string& remark : state_.options.remarks)
      say(remark);
    for (const std::string& remark : state_.remarks)
      say(remark);
    return std::move(out_);
  }
  // Who calls it by hand reads what the program before it says of the machine.
  Sheet writeCalled() {
    say(fmt::format("PART OF O{:04}, WHICH CHECKS WHAT THE CALLER PROVIDES", *state_.options.calledFrom));
    table();
    effects();
    fixed();
    return end();
  }
  static ir::Origin origin(std::string reason) {
    ir::Origin out;
    out.reason = std::move(reason);
    return out;
  }
  void say(std::string_view text) { out_.comment(headerText(text), origin("header")); }
  // as it is: columns.
  void raw(std::string text, const ir::Origin& from) {
    while (text.ends_with(' '))
      text.pop_back();
    out_.add("(" + text + ")", from);
  }

  std::string number() const {
    const std::string digits = std::to_string(state_.options.programNumber);
    return std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits;
  }

  std::string wholeTitle() const {
    return headerText(state_.cycle.title.empty() ? state_.cycle.name : state_.cycle.title);
  }
  bool isCut() const { return wrapWords(wholeTitle(), kTitleWidth).size() > 1; }

  // Two points where it is cut: the next comment then has all of it.
  std::string title() const {
    const auto lines = wrapWords(wholeTitle(), kTitleWidth);
    std::string out = lines.empty() ? "" : lines.front();
    while (!out.empty() && std::string_view(" ,-.:/").find(out.back()) != std::string_view::npos)
      out.pop_back();
    return out.empty() ? "PROBE CYCLE" : isCut() ? out + ".." : out;
  }

  std::string meaning(const ir::Variable& variable) const {
    if (!variable.meaning.empty()) return headerText(variable.meaning);
    if (variable.role != ir::Role::Host) return "";
    for (const stdlib::HostInput& host : stdlib::kHostInputs)
      if (host.name == variable.name) return headerText(host.meaning);
    return "";
  }

  std::string defaultText(ir::VariableId id) const {
    const ir::Variable& variable = state_.cycle.variable(id);
    if (mayBeOmitted(state_, id)) return variable.defaultValue ? numberText(*variable.defaultValue) : "NONE";
    return "GIVE";
  }

  void table() {
    if (state_.arguments.empty()) return say("NO ARGUMENTS");
    std::vector<Row> rows = {{"", "", "NAME", "UNIT", "DEFAULT", "RANGE", "MEANING"}};
    for (const Argument& argument : state_.arguments) {
      const ir::Variable& variable = state_.cycle.variable(argument.variable);
      const std::string unit =
          variable.unit.empty() ? std::string(ir::kindUnit(variable.kind)) : variable.unit;
      rows.push_back({std::string(1, argument.letter), "#" + std::to_string(argument.local),
                      headerText(variable.name), headerText(unit), defaultText(argument.variable),
                      rangeText(state_, argument.variable), meaning(variable)});
    }
    std::vector<std::size_t> widths(6, 0);
    for (const Row& row : rows)
      for (std::size_t i = 0; i < widths.size(); ++i)
        widths[i] = std::max(widths[i], row[i].size());
    say("ARGUMENTS. GIVE: AN ALARM WHERE IT IS OMITTED");
    for (std::size_t i = 0; i < rows.size(); ++i) {
      ir::Origin from = origin("header");
      if (i > 0)
        if (const auto& range = state_.cycle.variable(state_.arguments[i - 1].variable).range;
            range.hasPlace())
          from.ranges.push_back(range);
      row(rows[i], widths, from);
    }
  }

  // What the values of lists mean.
  void legends() {
    for (const Argument& argument : state_.arguments) {
      const auto found = state_.options.choices.find(argument.variable);
      if (found == state_.options.choices.end() || found->second.empty()) continue;
      std::string text;
      for (const Choice& choice : found->second)
        text += (text.empty() ? "" : ", ") + numberText(choice.value) + " = " + choice.title;
      say(std::string(1, argument.letter) + " IS A LIST: " + text);
    }
  }

  // Which arguments move the probe, which only set or decide something, and which only feed checks.
  void effects() {
    const ir::Cycle* const unshared = state_.options.unshared;
    const std::set<ir::VariableId> used = bodyVariables(unshared != nullptr ? *unshared : state_.cycle);
    std::string moving, setting, checking, late;
    for (const Argument& argument : state_.arguments) {
      const ir::VariableId id = argument.variable;
      if (state_.moving.contains(id)) moving += std::string(" ") + argument.letter;
      if (used.contains(id) && !state_.moving.contains(id)) setting += std::string(" ") + argument.letter;
      if (!used.contains(id)) checking += std::string(" ") + argument.letter;
      if (state_.late.contains(id)) late += std::string(" ") + argument.letter;
    }
    if (!moving.empty()) say("MOVE THE PROBE:" + moving);
    if (!setting.empty()) say("SET OR COMPARE, MOVE NOTHING:" + setting);
    if (!checking.empty()) say("ONLY CHECKED, MOVE AND SET NOTHING:" + checking);
    if (!late.empty()) say("NO ALARM WHERE NO CHECK COMES TO READ THEM:" + late);
  }

  void computed() {
    std::string text;
    for (auto [id, formula] : state_.options.computed) {
      // Round brackets would end the comment.
      std::replace(formula.begin(), formula.end(), '(', '[');
      std::replace(formula.begin(), formula.end(), ')', ']');
      if (state_.locals.contains(id)) text += (text.empty() ? "COMPUTED, NO ARGUMENTS: " : ", ") + formula;
    }
    if (!text.empty()) say(text);
  }

  void row(const Row& cells, const std::vector<std::size_t>& widths, const ir::Origin& from) {
    std::string text;
    for (std::size_t i = 0; i < widths.size(); ++i)
      if (widths[i] > 0) text += padded(cells[i], widths[i]) + " ";
    const std::size_t indent = text.size();
    const bool beside = indent + kLeastMeaning <= Sheet::kCommentWidth;
    const auto lines =
        wrapWords(cells.back(), beside ? Sheet::kCommentWidth - indent : Sheet::kCommentWidth - 4);
    raw(text + (beside && !lines.empty() ? lines.front() : ""), from);
    for (std::size_t i = beside ? 1 : 0; i < lines.size(); ++i)
      raw(std::string(beside ? indent : 4, ' ') + lines[i], from);
  }

  void call() {
    std::string text = "CALL: G65 P" + std::to_string(state_.options.programNumber);
    std::string made;
    std::vector<Argument> order = state_.arguments;
    std::stable_sort(order.begin(), order.end(),
                     [](const Argument& a, const Argument& b) { return a.letter < b.letter; });
    const std::map<ir::VariableId, double> values = exampleValues(state_);
    for (const Argument& argument : order) {
      const ir::Variable& variable = state_.cycle.variable(argument.variable);
      if (!variable.defaultValue && variable.optional) continue;
      text += std::string(" ") + argument.letter + withPoint(values.at(argument.variable));
      if (!variable.defaultValue) made += std::string(" ") + argument.letter;
    }
    say(text);
    if (!made.empty()) say("EXAMPLES ONLY, SET YOUR OWN:" + made);
  }

  void fixed() {
    std::string text;
    for (const auto& [name, value] : state_.options.fixed)
      text += (text.empty() ? "FIXED WHEN CONVERTED: " : ", ") + name + " = " + numberText(value);
    if (!text.empty()) say(text);
  }

  // "#530, #600": common variables of the shop that the body reads and never sets; those below are the
  // macros'.
  std::string readFromOutside() const {
    constexpr double kFirst = 500, kLast = 999;
    if (!state_.options.programs.empty()) return ""; // results of called programs are among them
    std::set<double> read, stored;
    for (const ir::CycleStatement& one : state_.cycle.body) {
      if (const auto* store = std::get_if<ir::Store>(&one.node)) {
        const double* number = ir::constantValue(store->number);
        if (number == nullptr) return ""; // it may be any
        stored.insert(*number);
      }
      ir::eachNode(one, [&](const ir::Expression& node) {
        const auto* variable = std::get_if<ir::MachineVariable>(&node.node);
        const double* number = variable == nullptr ? nullptr : ir::constantValue(variable->number);
        if (number != nullptr && *number >= kFirst && *number <= kLast) read.insert(*number);
      });
    }
    std::string out;
    for (const double number : read)
      if (!stored.contains(number)) out += fmt::format("{}#{:.0f}", out.empty() ? "" : ", ", number);
    return out;
  }

  void requirements() {
    const Guards& guards = state_.guards;
    std::string checked, unchecked, noted;
    const auto put = [&](Guard guard, std::string_view text) {
      if (guard == Guard::Absent) return;
      std::string& into = guard == Guard::Checked ? checked : unchecked;
      into += (into.empty() ? "" : ", ") + std::string(text);
    };
    put(guards.metric, "METRIC");
    put(guards.rotation, "NO ROTATION");
    put(guards.scaling, "NO SCALING");
    put(guards.shift, state_.shiftOfZ ? "NO LOCAL SHIFT" : "NO LOCAL SHIFT OF X AND Y");
    if (!state_.shiftOfZ && guards.shift == Guard::Checked) put(Guard::Unchecked, "NO LOCAL SHIFT OF Z");
    put(guards.extended, "G54 TO G59");
    put(guards.cutterComp, "CUTTER COMPENSATION OFF");
    put(guards.cannedCycle, "CANNED CYCLES OFF");
    put(guards.toolLength, "TOOL LENGTH ACTIVE");
    put(Guard::Unchecked, "NO MIRROR IMAGE");
    put(Guard::Unchecked, "CALIBRATED PROBE IN THE SPINDLE");
    if (!checked.empty()) say("THE CALLER PROVIDES, ELSE AN ALARM: " + checked);
    say("THE CALLER PROVIDES, NOT CHECKED: " + unchecked);
    if (!state_.macros.needs.empty() && callsMacros(state_.cycle))
      say("SET BEFORE THE FIRST CALL: " + state_.macros.needs);
    if (const auto ball = state_.findHost("tool_radius");
        ball && state_.isArgument(*ball) && callsMacros(state_.cycle))
      say("TOOL_RADIUS: THE CALIBRATED RADIUS THAT THE MACROS MEASURE WITH" +
          (state_.macros.probing.radiusX ? fmt::format(", IN #{}", *state_.macros.probing.radiusX) : ""));
    if (const std::string read = readFromOutside(); !read.empty())
      say("READ HERE AND SET ELSEWHERE: " + read);
    std::string starts;
    for (const ir::Axis axis : ir::kAxes) {
      const auto id = state_.findHost(std::string("start_") + static_cast<char>('x' + ir::indexOf(axis)));
      if (id && !state_.isArgument(*id) && state_.locals.contains(*id))
        starts += std::string(" ") + ir::letterOf(axis);
    }
    if (!starts.empty()) say("MEASURES FROM WHERE THE PROBE IS AT THE CALL IN" + starts);
  }

  void alarms() {
    for (const AlarmText& alarm : state_.alarms)
      out_.comment("ALARM " + std::to_string(alarm.number) + " " +
                       (!alarm.full.empty()    ? alarm.full
                        : !alarm.shown.empty() ? alarm.shown
                                               : "WITHOUT A TEXT"),
                   origin("header"));
  }

  State& state_;
  Sheet out_;
};

} // namespace

Sheet header(State& state) {
  return Header(state).write();
}

} // namespace dotek::backends::fanuc
