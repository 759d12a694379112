// A cycle in memory that is lowered, and run on values beside the interpreter.
#pragma once

#include "frontend/gibbs/Lower.h"
#include "ir/Evaluate.h"
#include "ir/Verify.h"
#include "support/Decimal.h"
#include "tests/unit/GibbsRunProject.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <random>

namespace dotek::tests {

// Files: DefineData.txt, CycleData.dlg, CycleData.mac, ToolPath.mac, and what they call.
struct LowerProject : GibbsProject {
  gibbs::Cycle source;
  ir::Cycle cycle;
  std::map<std::string, ir::VariableId> hostIds;
  std::vector<std::string> touches; // lines of ToolPath.mac that are said to be touches

  LowerProject() { files["DefineData.txt"] = ""; }
  // `fields`: DefineData.txt.
  LowerProject(const std::string& declared, const std::string& checks) {
    files["DefineData.txt"] = declared;
    files["CycleData.mac"] = checks;
  }

  void readFolder(const std::filesystem::path& folder) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (!entry.is_regular_file()) continue;
      std::ifstream in(entry.path(), std::ios::binary);
      std::ostringstream bytes;
      bytes << in.rdbuf();
      files[entry.path().filename().string()] = bytes.str();
    }
  }

  void declare() {
    source.name = "T";
    if (const auto id = add("DefineData.txt")) source.defineData = gibbs::parseDefineData(*id, parsing());
    if (const auto id = add("CycleData.dlg")) source.dialog = gibbs::parseDialog(*id, parsing());
    cycle = gibbs::declareCycle(source, sources);
  }

  gibbs::LowerContext lowering() {
    gibbs::LowerContext made{sources, gibbsKeywords(), limits,  diagnostics, assumptions,
                             {},      nullptr,         nullptr, nullptr};
    made.load = [this](const std::string& name, SourceRange) { return load(name); };
    made.loadDialog = [this](const std::string& name, SourceRange) { return loadDialog(name); };
    made.host = [this](const std::string& name) {
      const auto known = hostIds.find(name);
      if (known != hostIds.end()) return known->second;
      ir::Variable host;
      host.name = name;
      host.role = ir::Role::Host;
      return hostIds[name] = cycle.add(std::move(host));
    };
    return made;
  }

  bool lowerChecks() {
    declare();
    auto context = lowering();
    return gibbs::lowerChecks(*load("CycleData.mac"), cycle, context);
  }

  bool lowerPath() {
    declare();
    auto context = lowering();
    const gibbs::Macro* macro = load("ToolPath.mac");
    for (const std::string& line : touches) {
      const SourceFile& file = sources.file(macro->file);
      for (std::uint32_t i = 1; i <= file.lineCount(); ++i) {
        if (file.line(i).find(line) == std::string_view::npos) continue;
        const std::uint32_t begin = file.lineStart(i);
        context.touches.push_back(
            {macro->file, begin, begin + static_cast<std::uint32_t>(file.line(i).size())});
      }
    }
    return gibbs::lowerToolPath(*macro, cycle, context);
  }

  // What does not hold of every cycle; "" for nothing.
  std::string violations() const {
    std::string out;
    for (const ir::Violation& each : ir::verify(cycle))
      out += "violation: " + each.message + "\n";
    return out;
  }

  std::string text(const ir::ExpressionPtr& e) const {
    if (const auto* c = std::get_if<ir::Constant>(&e->node)) return numberText(c->value);
    if (const auto* use = std::get_if<ir::VariableUse>(&e->node)) return cycle.variables[use->variable].name;
    if (const auto* unary = std::get_if<ir::Unary>(&e->node))
      return (unary->op == ir::UnaryOp::Negate ? "-" : "f" + std::to_string(static_cast<int>(unary->op))) +
             "(" + text(unary->operand) + ")";
    if (const auto* b = std::get_if<ir::Binary>(&e->node)) {
      constexpr const char* kSigns = "+-*/%<";
      return "(" + text(b->left) + kSigns[std::min(static_cast<int>(b->op), 5)] + text(b->right) + ")";
    }
    return "?";
  }
  std::string text(const ir::ConditionPtr& c) const {
    constexpr const char* kRelations[] = {"=", "<>", "<", ">", "<=", ">="};
    if (const auto* comparison = std::get_if<ir::Comparison>(&c->node))
      return text(comparison->left) + kRelations[static_cast<int>(comparison->relation)] +
             text(comparison->right);
    if (const auto* junction = std::get_if<ir::Junction>(&c->node))
      return "(" + text(junction->left) + (junction->op == ir::Connective::And ? " and " : " or ") +
             text(junction->right) + ")";
    return "?";
  }
  std::string text(const ir::Coordinate& c) const {
    return std::string(1, "MWSRH"[static_cast<int>(c.frame)]) + " " + text(c.value);
  }
  // One statement a line: `G<54 -> L1`, `L1:`, `alarm [text]`, `move X S a Z R (Z-5)`, `measure X W a`.
  std::string text(const std::vector<ir::CycleStatement>& list) const {
    std::string out;
    for (const ir::CycleStatement& each : list) {
      if (const auto* s = std::get_if<ir::Assign>(&each.node))
        out += cycle.variables[s->variable].name + " = " + text(s->value);
      if (const auto* s = std::get_if<ir::Label>(&each.node)) out += cycle.labels[s->label].name + ":";
      if (const auto* s = std::get_if<ir::Jump>(&each.node)) out += "-> " + cycle.labels[s->target].name;
      if (const auto* s = std::get_if<ir::Branch>(&each.node))
        out += text(s->condition) + " -> " + cycle.labels[s->target].name;
      if (const auto* s = std::get_if<ir::Alarm>(&each.node)) out += "alarm [" + s->message + "]";
      if (const auto* s = std::get_if<ir::Comment>(&each.node)) out += "comment [" + s->text + "]";
      if (const auto* s = std::get_if<ir::Move>(&each.node)) {
        out += s->motion == ir::Motion::Protected ? "move" : "unprotected";
        for (const ir::Axis axis : ir::kAxes)
          if (s->axes[ir::indexOf(axis)])
            out += std::string(" ") + ir::letterOf(axis) + " " + text(*s->axes[ir::indexOf(axis)]);
      }
      if (const auto* s = std::get_if<ir::Measure>(&each.node))
        out += std::string("measure ") + ir::letterOf(s->axis) + " " + text(*s->target);
      out += '\n';
    }
    return out;
  }

  // Where the body takes the probe, as the interpreter says it: positions from entry and retract plane,
  // without repetition. "" where the body does not come to its end.
  std::string bodyPath(const std::map<std::string, double>& values) {
    ir::Environment environment(cycle.variables.size());
    const auto given = [&](const std::string& name) {
      const auto found = values.find(name);
      return found == values.end() ? 0 : found->second;
    };
    for (ir::VariableId id = 0; id < cycle.variables.size(); ++id) {
      if (cycle.variables[id].role != ir::Role::Local)
        environment[id] = {ir::Scalar::State::Known, given(cycle.variables[id].name), {}};
    }
    std::array<double, 3> at{};
    std::string out = positionText(at);
    std::string last = out;
    const auto visit = [&] {
      if (positionText(at) != last) out += last = positionText(at);
    };
    const std::array<double, 3> origin = {given("start_x"), given("start_y"), given("retract")};
    const auto valueOf = [&](const ir::Coordinate& c, std::size_t axis) {
      return ir::evaluate(*c.value, environment).value - (c.frame == ir::Frame::Work ? origin[axis] : 0);
    };
    std::size_t place = 0;
    const auto go = [&](ir::LabelId label) {
      for (place = 0; place < cycle.body.size(); ++place) {
        const auto* there = std::get_if<ir::Label>(&cycle.body[place].node);
        if (there != nullptr && there->label == label) return;
      }
    };
    for (int steps = 0; place < cycle.body.size() && steps < 10000; ++steps) {
      const ir::CycleStatement& each = cycle.body[place++];
      if (const auto* s = std::get_if<ir::Assign>(&each.node))
        environment[s->variable] = ir::evaluate(*s->value, environment);
      if (const auto* s = std::get_if<ir::Jump>(&each.node)) go(s->target);
      if (const auto* s = std::get_if<ir::Branch>(&each.node)) {
        const auto holds = ir::holds(*s->condition, environment);
        if (!holds) return "";
        if (*holds) go(s->target);
      }
      if (const auto* s = std::get_if<ir::Move>(&each.node)) {
        for (std::size_t axis = 0; axis < 3; ++axis)
          if (s->axes[axis]) at[axis] = valueOf(*s->axes[axis], axis);
        visit();
      }
      if (const auto* s = std::get_if<ir::Measure>(&each.node)) {
        const std::array<double, 3> begin = at;
        const std::size_t axis = ir::indexOf(s->axis);
        const double contact = valueOf(*s->target, axis);
        const double radius = s->axis == ir::Axis::Z ? 0 : given("tool_radius");
        at[axis] = contact - (contact > at[axis] ? radius : -radius);
        visit();
        at = begin;
        visit();
      }
    }
    return out;
  }
  static std::string positionText(const std::array<double, 3>& at) {
    std::string out;
    for (const double value : at)
      out += numberText(std::round(value * 1e6) / 1e6 + 0.0) + " ";
    return out + "; ";
  }

  // The same of the interpreter.
  std::string macroPath(const std::map<std::string, double>& values) {
    fields = values;
    hosts.clear();
    for (const char* name : {"tool_radius", "start_x", "start_y", "retract"})
      if (const auto found = values.find(name); found != values.end()) hosts[name] = found->second;
    hosts["tool_number"] = 1;
    auto running = context();
    const auto moves = gibbs::runToolPath(*load("ToolPath.mac"), running);
    if (!moves) return "";
    std::string out = positionText({0, 0, 0});
    std::string last = out;
    for (const gibbs::PathMove& move : *moves)
      if (const std::string next = positionText({move.x, move.y, move.z}); next != last) out += last = next;
    return out;
  }

  // Random values: the first on which body and macro lead the probe elsewhere; "" for none.
  std::string comparePaths(int rounds = 200) {
    if (const std::string broken = violations(); !broken.empty()) return broken;
    std::mt19937 random(11);
    std::uniform_int_distribution<int> pick(0, 3), small(-24, 24);
    for (int i = 0; i < rounds; ++i) {
      std::map<std::string, double> values = {{"tool_radius", 0.5 * (1 + pick(random))},
                                              {"retract", small(random)},
                                              {"start_x", small(random)},
                                              {"start_y", small(random)}};
      for (const ir::Variable& variable : cycle.variables)
        if (variable.role == ir::Role::Parameter)
          values[variable.name] = pick(random) == 0 ? 0 : small(random) / 2.0;
      const std::string wanted = macroPath(values);
      const std::string got = bodyPath(values);
      if (!wanted.empty() && wanted == got) continue;
      std::string at;
      for (const auto& [name, value] : values)
        at += name + "=" + numberText(value) + " ";
      return "macro " + wanted + "\nbody  " + got + "\n" + at + findings();
    }
    return "";
  }

  // "" where the lowered checks and the interpreter agree on the values; hosts and fields by name.
  std::string disagreement(const std::map<std::string, double>& values,
                           const std::map<std::string, double>& given) {
    ir::Environment environment(cycle.variables.size());
    fields.clear();
    for (ir::VariableId id = 0; id < cycle.variables.size(); ++id) {
      const ir::Variable& variable = cycle.variables[id];
      const auto& from = variable.role == ir::Role::Host ? given : values;
      const auto found = from.find(variable.name);
      if (variable.role == ir::Role::Local || found == from.end()) continue;
      environment[id] = {ir::Scalar::State::Known, found->second, {}};
    }
    fields = values;
    hosts = given;
    auto running = context();
    const gibbs::ChecksResult wanted = gibbs::runChecks(*load("CycleData.mac"), running);
    const ir::CheckRun got = ir::runChecks(cycle, environment, 100000);
    using Verdict = gibbs::ChecksResult::Verdict;
    using End = ir::CheckRun::End;
    if (wanted.verdict == Verdict::Passes && got.end == End::Passes) return "";
    const auto* alarm = got.at != nullptr ? std::get_if<ir::Alarm>(&got.at->node) : nullptr;
    if (wanted.verdict == Verdict::Rejected && got.end == End::Alarm && alarm != nullptr) {
      for (const gibbs::Rejection& each : wanted.rejections)
        if (each.text == alarm->message) return "";
    }
    std::string text = "interpreter " + std::to_string(static_cast<int>(wanted.verdict)) + ", lowered " +
                       std::to_string(static_cast<int>(got.end));
    if (alarm != nullptr) text += " [" + alarm->message + "]";
    for (const gibbs::Rejection& each : wanted.rejections)
      text += " wanted [" + each.text + "]";
    for (const auto& [name, value] : values)
      text += " " + name + "=" + std::to_string(value);
    for (const auto& [name, value] : given)
      text += " " + name + "=" + std::to_string(value);
    return text + "\n" + findings();
  }

  // Random values for fields and tool radius, whole and halves around what checks compare with; the first
  // disagreement, or how the values were spread: "both paths".
  std::string compareOnValues(int rounds = 400, std::uint32_t seed = 7) {
    if (const std::string broken = violations(); !broken.empty()) return broken;
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> pick(0, 9), small(-14, 14), offset(52, 61), large(-200, 200);
    int passed = 0, rejected = 0;
    for (int i = 0; i < rounds; ++i) {
      std::map<std::string, double> values;
      for (const ir::Variable& variable : cycle.variables) {
        if (variable.role != ir::Role::Parameter) continue;
        const int way = pick(random);
        values[variable.name] = way < 3 && variable.defaultValue ? *variable.defaultValue
                                : way < 6                        ? small(random) / 2.0
                                : way < 9                        ? offset(random)
                                                                 : large(random) * 1.0;
      }
      const std::map<std::string, double> given = {{"tool_radius", 0.5 * (1 + pick(random))},
                                                   {"retract", 5},
                                                   {"tool_number", 3},
                                                   {"start_x", 1},
                                                   {"start_y", -2}};
      const std::string found = disagreement(values, given);
      if (!found.empty()) return found;
      ir::Environment environment;
      for (const ir::Variable& variable : cycle.variables) {
        const auto& from = variable.role == ir::Role::Host ? given : values;
        const auto at = from.find(variable.name);
        environment.push_back(at == from.end() || variable.role == ir::Role::Local
                                  ? ir::Scalar{}
                                  : ir::Scalar{ir::Scalar::State::Known, at->second, {}});
      }
      (ir::runChecks(cycle, environment, 100000).end == ir::CheckRun::End::Passes ? passed : rejected)++;
    }
    return passed > 0 && rejected > 0 ? "both paths" : passed > 0 ? "all pass" : "all rejected";
  }
};

} // namespace dotek::tests
