// Cycles for the tests of the Fanuc back end, and reading back what it writes.
#pragma once

#include "IrHelper.h"
#include "backends/fanuc/Emit.h"
#include "ir/Fold.h"
#include "stdlib/DataFiles.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <set>

namespace dotek::tests {

using ir::BinaryOp;
using ir::ConditionPtr;
using ir::ExpressionPtr;
using ir::Relation;
using ir::UnaryOp;
using ir::VariableId;

inline stdlib::Control loadControl(std::string_view name) {
  auto out = stdlib::Control::load(stdlib::DataFiles(), name);
  REQUIRE(out);
  return std::move(*out);
}

inline stdlib::MacroSet loadMacros(std::string_view name) {
  auto out = stdlib::MacroSet::load(stdlib::DataFiles(), name);
  REQUIRE(out);
  return std::move(*out);
}

inline ExpressionPtr number(double value) {
  return ir::constant(value);
}
inline ExpressionPtr use(VariableId id) {
  return ir::variable(id);
}
inline ExpressionPtr plus(ExpressionPtr a, ExpressionPtr b) {
  return ir::binary(BinaryOp::Add, std::move(a), std::move(b));
}
inline ExpressionPtr minus(ExpressionPtr a, ExpressionPtr b) {
  return ir::binary(BinaryOp::Subtract, std::move(a), std::move(b));
}

// Writes a cycle step by step.
class Maker {
public:
  ir::Cycle cycle;

  VariableId field(std::string name, double value, ir::Kind kind = ir::Kind::Length) {
    ir::Variable out = parameter(std::move(name), kind);
    out.defaultValue = value;
    return cycle.add(std::move(out));
  }
  VariableId host(std::string name) {
    return cycle.add(named(std::move(name), ir::Role::Host, ir::Kind::Length));
  }
  ir::CycleStatement& add(ir::CycleStatement statement) {
    cycle.body.push_back(std::move(statement));
    return cycle.body.back();
  }
  template <class Node> ir::CycleStatement& add(Node node) { return add(statement(std::move(node))); }

  ir::CycleStatement& move(ir::Motion motion, ir::Axis axis, ExpressionPtr value,
                           ExpressionPtr feed = nullptr, ir::Frame frame = ir::Frame::Work) {
    ir::Move out;
    out.motion = motion;
    out.axes[ir::indexOf(axis)] = ir::Coordinate{std::move(value), frame, nullptr};
    out.feed = std::move(feed);
    return add(std::move(out));
  }
  ir::CycleStatement& surface(ir::Axis axis, ExpressionPtr travel, ExpressionPtr system,
                              ExpressionPtr nominal) {
    ir::Measure out;
    out.axis = axis;
    out.target = ir::Coordinate{std::move(travel), ir::Frame::Here, nullptr};
    if (system != nullptr) {
      out.setting.emplace();
      out.setting->system = std::move(system);
      out.setting->nominal[ir::indexOf(axis)] = std::move(nominal);
    }
    return add(std::move(out));
  }
  // Checks: an alarm where the condition holds.
  void refuseIf(const ConditionPtr& wrong, std::string message) {
    const ir::LabelId next = cycle.addLabel({"next", {}});
    cycle.checks.push_back(statement(ir::Branch{ir::negate(wrong), next}));
    cycle.checks.push_back(statement(ir::Alarm{std::move(message)}));
    cycle.checks.push_back(statement(ir::Label{next}));
  }
};

// One surface: travel, nominal, work offset, retract height and touch height are fields, as the source of
// `required-x.nc` has them.
struct SurfaceCycle : Maker {
  VariableId travel, nominal, system, back, depth, clearance, radius;

  explicit SurfaceCycle(ir::Axis axis = ir::Axis::X) {
    cycle.name = "surface";
    cycle.title = "One surface";
    travel = field("a", 10);
    nominal = field("I", 0);
    system = field("G", 56, ir::Kind::WorkOffset);
    back = field("Zb", 50);
    depth = field("Z", -5);
    clearance = host("clearance");
    radius = host("tool_radius");
    refuseIf(ir::join(ir::Connective::Or, ir::compare(Relation::Less, use(system), number(54)),
                      ir::compare(Relation::Greater, use(system), number(59))),
             "The work offset is 54 to 59");
    refuseIf(ir::compare(Relation::Less, ir::unary(UnaryOp::Absolute, use(travel)), use(radius)),
             "Travel too short");
    move(ir::Motion::Protected, ir::Axis::Z, use(clearance)).origin.addresses = "GPZ";
    add(ir::Spindle{});
    add(ir::Coolant{});
    add(ir::ProbePower{true});
    move(ir::Motion::Protected, ir::Axis::Z, number(5), number(1000)).origin.addresses = "GPZF";
    auto& down = move(ir::Motion::Protected, ir::Axis::Z, use(depth), number(200));
    down.origin.addresses = "GPZF";
    down.origin.arguments = {{'Z', depth}};
    auto& touch = surface(axis, use(travel), use(system), use(nominal));
    const char letter = ir::letterOf(axis);
    const char coordinate = "IJK"[ir::indexOf(axis)];
    touch.origin.addresses = std::string("GPS") + letter + coordinate;
    touch.origin.arguments = {{'S', system}, {letter, travel}, {coordinate, nominal}};
    add(ir::Store{number(550), ir::result(ir::ResultName::Main)});
    auto& away = move(ir::Motion::Rapid, ir::Axis::Z, use(back), number(5000));
    away.origin.addresses = "GZF";
    away.origin.block = 9;
    add(ir::ProbePower{false});
  }
  void fixAll(double wanted = 0) {
    ir::fold(cycle, {{travel, 10},
                     {nominal, wanted},
                     {system, 56},
                     {back, 50},
                     {depth, -5},
                     {clearance, 50},
                     {radius, 3}});
  }
};

struct Emission {
  std::optional<std::vector<backends::EmittedLine>> lines;
  Diagnostics diagnostics;

  std::vector<std::string> texts() const {
    std::vector<std::string> out;
    if (lines)
      for (const auto& line : *lines)
        out.push_back(line.text);
    return out;
  }
  bool has(std::string_view text) const {
    const auto all = texts();
    return std::find(all.begin(), all.end(), text) != all.end();
  }
  // Index of the first line that holds `part`; the number of lines where none does.
  std::size_t find(std::string_view part, std::size_t from = 0) const {
    const auto all = texts();
    for (std::size_t i = from; i < all.size(); ++i)
      if (all[i].find(part) != std::string::npos) return i;
    return all.size();
  }
  bool holds(std::string_view part) const { return find(part) < texts().size(); }
  std::set<std::string> codes() const {
    std::set<std::string> out;
    for (const Diagnostic& d : diagnostics.all())
      out.emplace(d.code);
    return out;
  }
  std::string all() const {
    std::string out;
    for (const std::string& text : texts())
      out += text + "\n";
    for (const Diagnostic& d : diagnostics.all())
      out += std::string(d.code) + ": " + d.message + "\n";
    return out;
  }
  // Lines between the modes and their restoring, comments aside.
  std::vector<std::string> body() const {
    std::vector<std::string> out;
    bool inside = false;
    for (const std::string& text : texts()) {
      if (text.find("G#") != std::string::npos) break;
      if (inside && !text.starts_with("(")) out.push_back(text);
      inside = inside || text.starts_with("G90 G94");
    }
    return out;
  }
};

// What to emit with; the sets live as long as it does.
struct Target {
  stdlib::Control control, source;
  stdlib::MacroSet macros;
  backends::fanuc::EmitOptions options;

  explicit Target(std::string_view set = "easyprobe", std::string_view name = "fanuc-0i-md")
      : control(loadControl(name)), source(loadControl("fanuc-0i-md")),
        macros(loadMacros(set)), options{control, macros, source, 8000, {}, {}, {}, {}, false} {
    options.source = &macros; // what a cycle states is a call of this set
  }
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;

  Emission emit(const ir::Cycle& cycle) const {
    Emission out;
    out.lines = backends::fanuc::emit(cycle, options, SourceMap(), out.diagnostics);
    CHECK(out.lines.has_value() == !out.diagnostics.hasErrors());
    return out;
  }
};

// Reads a program back: brackets balance and lie no deeper than the control takes, jumps have one target,
// everything is ASCII of a bearable length, lengths have a point.
inline void checkProgram(const Emission& emission, std::uint32_t bracketDepth = 5) {
  REQUIRE_MESSAGE(emission.lines.has_value(), emission.all());
  std::multiset<std::string> numbers;
  std::set<std::string> targets;
  const auto digitsAt = [](const std::string& text, std::size_t at) {
    return text.substr(at, text.find_first_not_of("0123456789", at) - at);
  };
  for (std::string text : emission.texts()) {
    CAPTURE(text);
    CHECK(text.size() <= 90);
    CHECK(std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c < 127; }));
    if (text.starts_with("(")) {
      CHECK(text.ends_with(")"));
      CHECK(text.find_first_of("()%", 1) == text.size() - 1);
      continue;
    }
    if (text.starts_with("N")) {
      numbers.insert(digitsAt(text, 1));
      text = text.substr(text.find(' ') + 1);
    }
    if (const auto at = text.find("GOTO "); at != std::string::npos) targets.insert(digitsAt(text, at + 5));
    std::uint32_t depth = 0, deepest = 0;
    for (const char c : text) {
      if (c == '[') deepest = std::max(deepest, ++depth);
      if (c == ']') --depth;
    }
    CHECK(depth == 0);
    CHECK(deepest <= bracketDepth);
    if (!text.starts_with("G") || text.find('=') != std::string::npos) continue;
    for (std::size_t at = text.find(' '); at != std::string::npos; at = text.find(' ', at + 1)) {
      const char address = text[at + 1];
      const char value = text[at + 2];
      if (std::string_view("XYZIJKDF").find(address) == std::string_view::npos) continue;
      const std::string word = text.substr(at + 1, text.find(' ', at + 1) - at - 1);
      if (value != '#' && value != '[' && !word.starts_with(std::string(1, address) + "-#"))
        CHECK_MESSAGE(word.find('.') != std::string::npos, word);
    }
  }
  for (const std::string& target : targets)
    CHECK_MESSAGE(numbers.count(target) == 1, "GOTO " << target);
  for (const std::string& given : numbers)
    CHECK_MESSAGE(targets.contains(given), "N" << given << " is no target");
  CHECK(emission.texts().front() == "%");
  CHECK(emission.texts().back() == "%");
}

} // namespace dotek::tests
