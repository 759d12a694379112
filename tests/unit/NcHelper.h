// NC blocks with holes in a test: `G65 P9770 Z{Zb} F200`, `X{a|###}` with a picture, `X{a|}` without one.
#pragma once

#include "frontend/nc/Lift.h"
#include "frontend/nc/Parse.h"
#include "ir/PrintStatement.h"
#include "stdlib/DataFiles.h"
#include "support/Decimal.h"

#include <deque>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace dotek::tests {

// Statements in a form of the tests: nothing of ir/Print.h is tested here.
inline std::string show(const ir::ExpressionPtr& e, const ir::Cycle& cycle) {
  if (!e) return "none";
  if (const auto* c = std::get_if<ir::Constant>(&e->node)) return numberText(c->value);
  if (std::holds_alternative<ir::NullValue>(e->node)) return "null";
  if (const auto* v = std::get_if<ir::VariableUse>(&e->node)) return cycle.variable(v->variable).name;
  if (const auto* m = std::get_if<ir::MachineVariable>(&e->node)) return "#" + show(m->number, cycle);
  if (const auto* r = std::get_if<ir::MeasuredResult>(&e->node))
    return "result" + std::to_string(static_cast<int>(r->name));
  if (const auto* u = std::get_if<ir::Unary>(&e->node))
    return "u" + std::to_string(static_cast<int>(u->op)) + "(" + show(u->operand, cycle) + ")";
  const auto& b = std::get<ir::Binary>(e->node);
  static const char* const kNames[] = {"+", "-", "*", "/", "mod", "dir", "and", "or", "xor", "else"};
  return "(" + show(b.left, cycle) + kNames[static_cast<int>(b.op)] + show(b.right, cycle) + ")";
}

inline std::string show(const ir::Coordinate& c, const ir::Cycle& cycle) {
  static const char* const kNames[] = {"machine", "work", "start", "retract", "here"};
  return std::string(kNames[static_cast<int>(c.frame)]) + ":" + show(c.value, cycle);
}

inline std::string show(const ir::CycleStatement& s, const ir::Cycle& cycle) {
  const auto number = [](auto value) { return std::to_string(static_cast<int>(value)); };
  if (const auto* m = std::get_if<ir::Move>(&s.node)) {
    static const char* const kNames[] = {"rapid", "feed", "protected"};
    std::string out = kNames[static_cast<int>(m->motion)];
    for (const ir::Axis axis : ir::kAxes)
      if (const auto& c = m->axes[ir::indexOf(axis)])
        out += std::string(" ") + ir::letterOf(axis) + "=" + show(*c, cycle);
    return m->feed ? out + " F=" + show(m->feed, cycle) : out;
  }
  if (const auto* m = std::get_if<ir::Measure>(&s.node)) {
    std::string out = m->feature == ir::Feature::Bore
                          ? "bore D=" + show(m->diameter, cycle)
                          : std::string("surface ") + ir::letterOf(m->axis) + "=" + show(*m->target, cycle);
    if (!m->setting) return out;
    out += " sets " + show(m->setting->system, cycle);
    for (const ir::Axis axis : ir::kAxes)
      if (const auto& n = m->setting->nominal[ir::indexOf(axis)])
        out += std::string(" ") + ir::letterOf(axis) + "=" + show(n, cycle);
    return out;
  }
  if (const auto* n = std::get_if<ir::CallCycle>(&s.node)) {
    std::string out = "cycle " + n->cycle;
    if (n->axis) out += std::string(" ") + ir::letterOf(*n->axis);
    for (const ir::CycleArgument& one : n->arguments)
      out +=
          " " + one.parameter + "=" +
          (one.frame ? show(ir::Coordinate{one.value, *one.frame, nullptr}, cycle) : show(one.value, cycle));
    if (n->setting) {
      out += " sets " + show(n->setting->system, cycle) + " ";
      for (const ir::Axis axis : ir::kAxes)
        if (n->setting->axes[ir::indexOf(axis)]) out += ir::letterOf(axis);
    }
    return out + (!n->moves ? ", no move" : !n->returns ? ", stays there" : "");
  }
  if (const auto* n = std::get_if<ir::Label>(&s.node)) return cycle.labels[n->label].name + ":";
  if (const auto* n = std::get_if<ir::Jump>(&s.node)) return "goto " + cycle.labels[n->target].name;
  if (const auto* n = std::get_if<ir::Branch>(&s.node)) {
    std::string out;
    ir::write(*n->condition, ir::Names(cycle), out);
    return "if " + out + " goto " + cycle.labels[n->target].name;
  }
  if (const auto* n = std::get_if<ir::Store>(&s.node))
    return "store " + show(n->number, cycle) + "=" + show(n->value, cycle);
  if (const auto* n = std::get_if<ir::ProbePower>(&s.node)) return n->on ? "probe on" : "probe off";
  if (const auto* n = std::get_if<ir::Spindle>(&s.node))
    return "spindle " + number(n->state) + (n->speed ? " S=" + show(n->speed, cycle) : "");
  if (const auto* n = std::get_if<ir::Coolant>(&s.node)) return "coolant " + number(n->state);
  if (const auto* n = std::get_if<ir::SetMode>(&s.node)) {
    static const char* const kNames[] = {"G90", "G91", "G94", "G95", "G17", "G18",
                                         "G19", "G40", "G80", "G",   "G0",  "G1"};
    return std::string("mode ") + kNames[static_cast<int>(n->mode)] +
           (n->system ? show(n->system, cycle) : "");
  }
  if (const auto* n = std::get_if<ir::Dwell>(&s.node)) return "dwell " + show(n->seconds, cycle);
  if (const auto* n = std::get_if<ir::Stop>(&s.node))
    return std::string(n->optional ? "optional stop" : "stop") +
           (n->number == 1 ? "" : " " + numberText(n->number)) + (n->message.empty() ? "" : " " + n->message);
  if (const auto* n = std::get_if<ir::Alarm>(&s.node)) return "alarm " + n->message;
  if (const auto* n = std::get_if<ir::Comment>(&s.node)) return "(" + n->text + ")";
  if (const auto* n = std::get_if<ir::OpaqueBlock>(&s.node)) {
    std::string out = "opaque";
    for (const ir::Word& word : n->words)
      out += std::string(" ") + word.address + show(word.value, cycle);
    return out;
  }
  return "?";
}

// One control, one macro set or none, and what is lifted with them.
class Nc {
public:
  explicit Nc(const std::string& controlName = "fanuc-0i-md", const std::string& set = "easyprobe") {
    const stdlib::DataFiles files;
    control = *stdlib::Control::load(files, controlName);
    if (!set.empty()) macros = *stdlib::MacroSet::load(files, set);
  }

  std::vector<frontend::nc::Piece> pieces(const std::string& text) {
    const FileId file = sources.add(SourceFile("b", text, Encoding::Utf8));
    std::vector<frontend::nc::Piece> out;
    const auto at = [&](std::size_t begin, std::size_t end) {
      return SourceRange{file, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
    };
    for (std::size_t i = 0; i < text.size();) {
      const std::size_t open = std::min(text.find('{', i), text.size());
      if (open > i) out.emplace_back(frontend::nc::TextPiece{text.substr(i, open - i), at(i, open)});
      if (open == text.size()) break;
      const std::size_t close = text.find('}', open);
      std::string name = text.substr(open + 1, close - open - 1);
      const Picture* picture = pictureOf("####.###;0");
      if (const std::size_t bar = name.find('|'); bar != std::string::npos) {
        picture = bar + 1 == name.size() ? nullptr : pictureOf(name.substr(bar + 1));
        name.erase(bar);
      }
      out.emplace_back(frontend::nc::HolePiece{
          {ir::variable(field(name), at(open, close + 1)), picture, "the field `" + name + "`"},
          at(open, close + 1)});
      i = close + 1;
    }
    return out;
  }

  std::optional<frontend::nc::Block> parse(const std::string& text) {
    return frontend::nc::parseBlock(pieces(text), limits, diagnostics);
  }

  // Lifts the blocks, one a line, in a fresh state; false where one is refused.
  bool lift(const std::string& text) {
    frontend::nc::LiftContext context{control, macros ? &*macros : nullptr, cycle, diagnostics};
    context.fixed = [this](ir::VariableId id) {
      const auto found = fixed.find(cycle.variable(id).name);
      return found == fixed.end() ? std::nullopt : std::optional<double>(found->second);
    };
    bool ok = true;
    std::vector<frontend::nc::Block> blocks;
    for (std::size_t i = 0; i <= text.size();) {
      const std::size_t end = std::min(text.find('\n', i), text.size());
      auto block = parse(text.substr(i, end - i));
      ok = block && ok;
      if (block) blocks.push_back(std::move(*block));
      i = end + 1;
    }
    ok = frontend::nc::liftAll(blocks, context, body) && ok;
    frontend::nc::reportPictures(context);
    state = context.state;
    return ok;
  }

  // The statements, one a line.
  std::string shown() const {
    std::string out;
    for (const ir::CycleStatement& statement : body)
      out += show(statement, cycle) + "\n";
    return out;
  }

  // Codes of all findings, in the order of reporting.
  std::string codes() const {
    std::string out;
    for (const Diagnostic& one : diagnostics.all())
      out += (out.empty() ? "[" : ", [") + std::string(one.code) + "]";
    return out;
  }
  // `text` that the only finding points at.
  std::string pointedAt() const {
    return diagnostics.all().size() == 1 ? std::string(sources.text(diagnostics.all()[0].range)) : codes();
  }
  std::string message() const { return diagnostics.all().empty() ? "" : diagnostics.all()[0].message; }

  SourceMap sources;
  Diagnostics diagnostics;
  Limits limits;
  ir::Cycle cycle;
  stdlib::Control control;
  std::optional<stdlib::MacroSet> macros;
  std::map<std::string, double> fixed; // by --set
  std::vector<ir::CycleStatement> body;
  frontend::nc::ModalState state;

private:
  ir::VariableId field(const std::string& name) {
    for (ir::VariableId id = 0; id < cycle.variables.size(); ++id)
      if (cycle.variables[id].name == name) return id;
    ir::Variable made;
    made.name = name;
    made.role = ir::Role::Parameter;
    return cycle.add(made);
  }
  const Picture* pictureOf(const std::string& text) {
    auto parsed = Picture::parse(text);
    return &pictures_.emplace_back(std::get<Picture>(std::move(parsed)));
  }
  std::deque<Picture> pictures_;
};

// The statements of blocks that are lifted without a finding, or the codes of what was found.
inline std::string lifted(const std::string& text, const std::string& set = "easyprobe",
                          const std::string& control = "fanuc-0i-md") {
  Nc nc(control, set);
  const bool ok = nc.lift(text);
  if (!nc.diagnostics.empty()) return (ok ? "with " : "refused: ") + nc.codes();
  return ok ? nc.shown() : "refused without a word";
}

} // namespace dotek::tests
