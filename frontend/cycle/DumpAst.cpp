// The tree as text: a statement a line with its place, expressions in prefix form.
#include "frontend/cycle/Parse.h"
#include "ir/Match.h"

#include <fmt/format.h>

namespace dotek::frontend::cycle {
namespace {

std::string dump(const Expression& expression) {
  return std::visit(
      ir::Overloaded{[](const Missing&) { return std::string("missing"); },
                     [](const Number& n) { return n.digits + std::string(unitText(n.unit)); },
                     [](const NameUse& use) { return use.name; },
                     [](const Member& member) {
                       return fmt::format("(. {} {})", member.object.text, member.member.text);
                     },
                     [](const WorkOffset& offset) {
                       return offset.extended == 0 ? fmt::format("G{}", offset.number)
                                                   : fmt::format("G54.1P{}", offset.extended);
                     },
                     [](const Text& text) { return "\"" + text.text + "\""; },
                     [](const Unary& unary) {
                       return fmt::format("({} {})", unary.op == UnaryOp::Not ? "not" : "-",
                                          dump(*unary.operand));
                     },
                     [](const Binary& binary) {
                       const std::string_view op = operatorText(binary.op);
                       return fmt::format("({} {} {})", op.substr(1, op.size() - 2), dump(*binary.left),
                                          dump(*binary.right));
                     },
                     [](const Function& function) {
                       std::string out = "(" + function.name.text;
                       for (const ExpressionPtr& argument : function.arguments)
                         out += " " + dump(*argument);
                       return out + ")";
                     },
                     [](const Given& given) { return "(given " + given.name.text + ")"; },
                     [](const Bracketed& bracketed) { return "[" + dump(*bracketed.inner) + "]"; }},
      expression.node);
}

std::string dump(const ExpressionPtr& expression) {
  return expression == nullptr ? "-" : dump(*expression);
}

std::string dump(const std::optional<Text>& text) {
  return text ? "\"" + text->text + "\"" : "-";
}

std::string dump(const std::vector<Name>& names) {
  std::string out;
  for (const Name& name : names)
    out += (out.empty() ? "" : ",") + name.text;
  return out;
}

class Dump {
public:
  Dump(const File& file, const SourceMap& sources) : source_(sources.file(file.file)) { block(file.body); }
  std::string out;

private:
  void line(SourceRange range, const std::string& text) {
    const LineColumn place = source_.place(range.begin);
    out.append(depth_ * 2, ' ');
    out += fmt::format("{}:{} {}\n", place.line, place.column, text);
  }
  void comments(const std::vector<Comment>& all) {
    for (const Comment& comment : all)
      line(comment.range, "comment" + comment.text);
  }
  void block(const Block& block) {
    for (const Statement& statement : block.statements) {
      comments(statement.before);
      this->statement(statement);
      if (statement.after) line(statement.after->range, "comment" + statement.after->text);
    }
    comments(block.comments);
  }
  void inner(const Block& body) {
    ++depth_;
    block(body);
    --depth_;
  }
  static std::string places(const std::vector<Coordinate>& all) {
    std::string text;
    for (const Coordinate& one : all) {
      const std::string frame = one.frame == Coordinate::Frame::Machine ? "machine "
                                : one.frame == Coordinate::Frame::Work  ? "work " + dump(one.system) + " "
                                                                        : "";
      text += fmt::format(" ({}{} {})", frame, axisLetter(one.axis), dump(one.value));
    }
    return text;
  }

  void statement(const Statement& s) {
    const auto put = [&](const std::string& text) { line(s.range, text); };
    const auto reach = [](Reach r) { return r == Reach::By ? "by" : "to"; };
    std::visit(
        ir::Overloaded{
            [&](const ErrorStatement&) { put("error"); },
            [&](const Header& h) {
              put((h.options ? "options " : "cycle ") + h.name.text + " " + dump(h.title));
            },
            [&](const Use& use) { put("use " + use.name.text); },
            [&](const Needs&) { put("needs probe"); },
            [&](const Parameter& p) {
              put(fmt::format("parameter {} {}{}{} default {} title {}", dump(p.names), typeText(p.type.name),
                              p.type.choices.empty() ? "" : "(" + dump(p.type.choices) + ")",
                              p.optional ? " optional" : "", dump(p.value), dump(p.title)));
              ++depth_;
              for (const Clause& c : p.clauses)
                line(c.range, fmt::format("clause {} {} {} {} {}", static_cast<int>(c.kind), dump(c.first),
                                          dump(c.second), dump(c.text), c.letter ? c.letter->text : "-"));
              --depth_;
            },
            [&](const Result& r) {
              put(fmt::format("result {} {} title {}", dump(r.names), typeText(r.type.name), dump(r.title)));
            },
            [&](const Require& r) { put("require " + dump(r.condition) + " " + dump(r.message)); },
            [&](const ProbeSwitch& p) { put(p.on ? "probe on" : "probe off"); },
            [&](const SpindleOff&) { put("spindle off"); },
            [&](const Coolant& c) { put(fmt::format("coolant {}", static_cast<int>(c.state))); },
            [&](const Dwell& d) { put("dwell " + dump(d.time)); },
            [&](const Stop& one) { put("stop " + dump(std::optional(one.text))); },
            [&](const Alarm& a) { put("alarm " + dump(std::optional(a.text))); },
            [&](const Report& r) {
              put(fmt::format("report {} nominal {} measured {} tolerance {}", dump(std::optional(r.name)),
                              dump(r.nominal), dump(r.measured), dump(r.tolerance)));
            },
            [&](const Move& m) {
              const char* kind = m.kind == Move::Kind::Feed        ? "feed"
                                 : m.kind == Move::Kind::Protected ? "protected"
                                 : m.kindSaid                      ? "rapid"
                                                                   : "-";
              put(fmt::format("move {} {}{} feed {}", kind, m.toStart ? "start" : reach(m.reach),
                              places(m.axes), dump(m.feed)));
            },
            [&](const Touch& t) {
              put(fmt::format(
                  "touch {}{} {} {} overtravel {} -> {}", t.once ? "once " : "",
                  t.along.empty() ? std::string(1, axisLetter(t.axis)) : "along" + places(t.along),
                  reach(t.reach), dump(t.value), dump(t.overtravel), t.name ? t.name->text : "-"));
              if (t.otherwise != nullptr) inner(*t.otherwise);
            },
            [&](const SetOffset& set) {
              std::string items;
              for (const Becomes& item : set.items)
                items += fmt::format(" ({} {} {})", dump(item.value), axisLetter(item.axis),
                                     dump(item.coordinate));
              put("set " + dump(set.system) + items);
            },
            [&](const SetTool& set) {
              put(fmt::format("set tool {} {} {}", dump(set.tool), toolPartText(set.part), dump(set.value)));
            },
            [&](const SetStored& set) { put("set stored " + set.name.text + " " + dump(set.value)); },
            [&](const Assign& a) { put("assign " + a.name.text + " " + dump(a.value)); },
            [&](const If& choice) {
              for (const If::Part& part : choice.parts) {
                comments(part.comments);
                put("if " + dump(part.condition));
                inner(part.body);
              }
              if (choice.otherwise == nullptr) return;
              comments(choice.elseComments);
              put("else");
              inner(*choice.otherwise);
            },
            [&](const Repeat& r) {
              put("repeat " + dump(r.count));
              inner(r.body);
            },
            [&](const For& f) {
              put(fmt::format("for {} {} {} step {}", f.name.text, dump(f.first), dump(f.last),
                              dump(f.step)));
              inner(f.body);
            },
            [&](const While& w) {
              put("while " + dump(w.condition) + " most " + dump(w.most));
              inner(w.body);
            },
            [&](const Call& c) {
              std::string arguments;
              for (const Argument& argument : c.arguments)
                arguments += " (" + argument.name.text + " " + dump(argument.value) + ")";
              for (const Name& options : c.uses)
                arguments += " (use " + options.text + ")";
              put("call " + c.cycle.text + arguments + " -> " + (c.result ? c.result->text : "-"));
            }},
        s.node);
  }

  const SourceFile& source_;
  std::size_t depth_ = 0;
};

} // namespace

std::string dumpAst(const File& file, const SourceMap& sources) {
  return Dump(file, sources).out;
}

} // namespace dotek::frontend::cycle
