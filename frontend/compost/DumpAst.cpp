#include "frontend/compost/Parse.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::frontend::compost {

namespace {

class Dumper {
public:
  explicit Dumper(const SourceMap& sources) : sources_(sources) {}

  std::string out;

  void item(const Routine& routine) {
    line(1, routine.range, fmt::format("routine {}", text(routine.nameRange)));
    body(2, routine.body);
    if (routine.returnRange)
      line(2, *routine.returnRange, "return");
    else
      plain(2, "return missing");
  }

  void item(const PictureDefinition& picture) {
    line(1, picture.range, fmt::format("picture {} {}", picture.number, text(picture.picture.range)));
  }

  void item(const FormatDirective& format) {
    line(1, format.range, fmt::format("format {} picture {}", text(format.nameRange), format.number));
  }

  void item(const ErrorItem& error) { line(1, error.range, "error"); }

  void comment(const Comment& comment) { line(1, comment.range, "comment"); }

private:
  std::string text(SourceRange range) const { return sources_.textUtf8(range); }

  void plain(int depth, std::string_view what) { out += fmt::format("{:{}}{}\n", "", depth * 2, what); }

  void line(int depth, SourceRange range, std::string_view what) {
    const SourceFile& source = sources_.file(range.file);
    const LineColumn begin = source.place(range.begin);
    const LineColumn end = source.place(range.end);
    plain(depth, fmt::format("{}:{}-{}:{} {}", begin.line, begin.column, end.line, end.column, what));
  }

  void body(int depth, const std::vector<Statement>& statements) {
    for (const Statement& one : statements)
      std::visit([&](const auto& node) { statement(depth, node); }, one);
  }

  void statement(int depth, const Literal& literal) {
    line(depth, literal.range, fmt::format("literal {}", text(literal.range)));
  }

  void statement(int depth, const Word& word) {
    static constexpr std::string_view kKinds[] = {"command", "numeric", "boolean"};
    std::string what =
        fmt::format("{} {}", kKinds[static_cast<std::size_t>(word.kind)], text(word.nameRange));
    for (const Literal& argument : word.arguments)
      what += fmt::format(" {}", text(argument.range));
    line(depth, word.range, what);
  }

  void statement(int depth, const EndOfLine& end) { line(depth, end.range, "end-of-line"); }

  void statement(int depth, const ErrorStatement& error) { line(depth, error.range, "error"); }

  void statement(int depth, const std::unique_ptr<If>& branch) {
    line(depth, branch->range, branch->endRange ? "if" : "if without end");
    condition(depth + 1, branch->condition);
    plain(depth + 1, "then");
    body(depth + 2, branch->thenBody);
    if (!branch->elseRange) return;
    line(depth + 1, *branch->elseRange, "else");
    body(depth + 2, branch->elseBody);
  }

  void condition(int depth, const Condition& condition) {
    line(depth, condition.range, "condition");
    for (std::size_t i = 0; i < condition.terms.size(); ++i) {
      if (i > 0) plain(depth + 1, condition.connectives[i - 1] == Connective::And ? "and" : "or");
      const ConditionTerm& term = condition.terms[i];
      for (const SourceRange negation : term.nots)
        line(depth + 1, negation, "not");
      if (const auto* word = std::get_if<Word>(&term.operand))
        statement(depth + 1, *word);
      else if (const auto* inner = std::get_if<std::unique_ptr<Condition>>(&term.operand))
        this->condition(depth + 1, **inner);
      else
        line(depth + 1, term.range, "error");
    }
  }

  const SourceMap& sources_;
};

} // namespace

std::string dumpAst(const Program& program, const SourceMap& sources) {
  Dumper dumper(sources);
  dumper.out = "program\n";
  for (const Item& item : program.items)
    std::visit([&](const auto& node) { dumper.item(node); }, item);
  for (const Comment& comment : program.comments)
    dumper.comment(comment);
  return std::move(dumper.out);
}

} // namespace dotek::frontend::compost
