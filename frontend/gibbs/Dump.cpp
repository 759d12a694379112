// `dump --stage ast`: one node a line, indented, each with its place.
#include "frontend/gibbs/Parse.h"

#include <algorithm>

namespace dotek::frontend::gibbs {

namespace {

// Long sums nest as deep as they are long; indentation stops there.
constexpr std::size_t kDeepest = 40;

const char* operatorText(BinaryOperator op) {
  switch (op) {
  case BinaryOperator::Add: return "+";
  case BinaryOperator::Subtract: return "-";
  case BinaryOperator::Multiply: return "*";
  case BinaryOperator::Divide: return "/";
  }
  return "";
}

const char* relationText(Relation relation) {
  switch (relation) {
  case Relation::Equal: return "=";
  case Relation::NotEqual: return "<>";
  case Relation::Less: return "<";
  case Relation::Greater: return ">";
  case Relation::LessEqual: return "<=";
  case Relation::GreaterEqual: return ">=";
  }
  return "";
}

class Dumper {
public:
  explicit Dumper(const SourceMap& sources) : sources_(sources) {}

  std::string take() { return std::move(out_); }

  void line(SourceRange range, const std::string& text) {
    const LineColumn place = sources_.file(range.file).place(range.begin);
    out_ +=
        fmt::format("{:>{}}{} @{}:{}\n", "", std::min(depth_, kDeepest) * 2, text, place.line, place.column);
  }

  void lines(const std::vector<Line>& all) {
    for (const Line& each : all) {
      if (each.label) line(each.label->name.range, "label " + utf8(each.label->name));
      if (each.statement != nullptr) statement(*each.statement);
    }
  }

  void statement(const Statement& statement) {
    std::visit([&](const auto& node) { show(node, statement.range); }, statement.node);
  }

  void control(const Control& control) {
    std::string text = "control " + utf8(control.kind);
    if (control.box)
      text += fmt::format(" box {},{} {}x{}", control.box->left, control.box->top, control.box->width,
                          control.box->height);
    if (control.variable) text += " variable " + control.variable->text;
    line(control.range, text);
    const Indent indent(*this);
    if (control.condition) comparison(*control.condition);
    expressions(control.arguments);
  }

  void definition(const Definition& definition) {
    line(definition.range, "field " + utf8(definition.name));
    const Indent indent(*this);
    expression(*definition.value);
  }

  void comment(const Comment& comment) { line(comment.range, "comment " + sources_.textUtf8(comment.range)); }

private:
  struct Indent {
    explicit Indent(Dumper& owner) : dumper(owner) { ++dumper.depth_; }
    ~Indent() { --dumper.depth_; }
    Indent(const Indent&) = delete;
    Indent& operator=(const Indent&) = delete;
    Dumper& dumper;
  };

  std::string utf8(const Name& name) const { return name.text; }

  void part(const char* title, SourceRange range, const Expression& inner) {
    line(range, title);
    const Indent indent(*this);
    expression(inner);
  }

  void expressions(const std::vector<ExpressionPtr>& all) {
    for (const ExpressionPtr& each : all)
      expression(*each);
  }

  void reference(const char* title, const VariableRef& target, SourceRange range) {
    line(range, std::string(title) + " " + utf8(target.name) +
                    (target.index == nullptr ? ""
                     : target.bracket == '(' ? " ()"
                                             : " []"));
    if (target.index == nullptr) return;
    const Indent indent(*this);
    expression(*target.index);
  }

  void expression(const Expression& each) {
    if (const auto* number = std::get_if<NumberLiteral>(&each.node)) {
      line(each.range, "number " + number->text);
    } else if (std::holds_alternative<TextLiteral>(each.node)) {
      line(each.range, "text " + sources_.textUtf8(each.range));
    } else if (const auto* target = std::get_if<VariableRef>(&each.node)) {
      reference("variable", *target, each.range);
    } else if (const auto* call = std::get_if<FunctionCall>(&each.node)) {
      line(each.range, "function " + utf8(call->name));
      const Indent indent(*this);
      expressions(call->arguments);
    } else if (const auto* unary = std::get_if<Unary>(&each.node)) {
      part(unary->op == UnaryOperator::Minus ? "negative" : "positive", each.range, *unary->operand);
    } else if (const auto* binary = std::get_if<Binary>(&each.node)) {
      line(each.range, operatorText(binary->op));
      const Indent indent(*this);
      expression(*binary->left);
      expression(*binary->right);
    } else if (const auto* bracketed = std::get_if<Bracketed>(&each.node)) {
      part("brackets", each.range, *bracketed->inner);
    } else {
      line(each.range, "error");
    }
  }

  void comparison(const Comparison& each) {
    std::string text = std::string("compare ") + relationText(each.relation);
    for (std::size_t i = 0; i < each.nots.size(); ++i)
      text += " not";
    line(each.range, text);
    const Indent indent(*this);
    expression(*each.left);
    expression(*each.right);
  }

  void show(const Assignment& node, SourceRange range) {
    line(range, "assign");
    const Indent indent(*this);
    reference("to", node.target, node.target.name.range);
    expression(*node.value);
  }
  void show(const If& node, SourceRange range) {
    line(range, "if");
    const Indent indent(*this);
    for (std::size_t i = 0; i < node.condition.comparisons.size(); ++i) {
      if (i > 0)
        line(node.condition.comparisons[i].range,
             node.condition.connectives[i - 1] == Connective::And ? "and" : "or");
      comparison(node.condition.comparisons[i]);
    }
    line(node.thenRange, "then");
    {
      const Indent inner(*this);
      if (node.then != nullptr) statement(*node.then);
      lines(node.thenBlock);
    }
    if (!node.elseRange) return;
    line(*node.elseRange, "else");
    const Indent inner(*this);
    if (node.elseStatement != nullptr) statement(*node.elseStatement);
    lines(node.elseBlock);
  }
  void show(const For& node, SourceRange range) {
    line(range, "for " + utf8(node.variable));
    const Indent indent(*this);
    expression(*node.from);
    expression(*node.to);
    if (node.step != nullptr) part("step", node.step->range, *node.step);
  }
  void show(const Next& node, SourceRange range) {
    line(range, node.variable ? "next " + utf8(*node.variable) : "next");
  }
  void show(const Continue&, SourceRange range) { line(range, "continue"); }
  void show(const Goto& node, SourceRange range) { line(range, "goto " + utf8(node.label)); }
  void show(const CallMacro& node, SourceRange range) {
    line(range, node.macro == nullptr ? "call " + sources_.textUtf8(node.macroRange) : "call");
    const Indent indent(*this);
    if (node.macro != nullptr) expression(*node.macro);
    expressions(node.arguments);
  }
  void show(const Args& node, SourceRange range) { names("args", node.names, range); }
  void show(const Declaration& node, SourceRange range) {
    names(node.scope == Scope::Global  ? "global"
          : node.scope == Scope::Local ? "local"
                                       : "permanent",
          node.names, range);
  }
  void names(const char* title, const std::vector<VariableRef>& all, SourceRange range) {
    line(range, title);
    const Indent indent(*this);
    for (const VariableRef& each : all)
      reference("name", each, each.name.range);
  }
  void show(const Include& node, SourceRange range) {
    line(range, "include " + sources_.textUtf8(node.fileRange));
  }
  void show(const OnError& node, SourceRange range) { line(range, "on-error " + utf8(node.label)); }
  void show(const Command& node, SourceRange range) {
    line(range, "command " + utf8(node.name));
    const Indent indent(*this);
    expressions(node.arguments);
  }
  void show(const std::unique_ptr<GeometryBlock>& node, SourceRange range) {
    line(range, "geometry " + utf8(node->kind));
    const Indent indent(*this);
    for (std::size_t i = 0; i < node->elements.size(); ++i)
      show(node->elements[i], node->elementRanges[i]);
  }
  void show(const ErrorStatement&, SourceRange range) { line(range, "error " + sources_.textUtf8(range)); }

  const SourceMap& sources_;
  std::string out_;
  std::size_t depth_ = 0;
};

} // namespace

std::string dumpAst(const Macro& macro, const SourceMap& sources) {
  Dumper dumper(sources);
  dumper.lines(macro.lines);
  for (const Comment& comment : macro.comments)
    dumper.comment(comment);
  return dumper.take();
}

std::string dumpAst(const Dialog& dialog, const SourceMap& sources) {
  Dumper dumper(sources);
  for (const Control& control : dialog.controls)
    dumper.control(control);
  for (const Comment& comment : dialog.comments)
    dumper.comment(comment);
  return dumper.take();
}

std::string dumpAst(const DefineData& data, const SourceMap& sources) {
  Dumper dumper(sources);
  for (const Definition& definition : data.definitions)
    dumper.definition(definition);
  for (const Comment& comment : data.comments)
    dumper.comment(comment);
  return dumper.take();
}

} // namespace dotek::frontend::gibbs
