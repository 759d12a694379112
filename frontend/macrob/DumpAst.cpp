#include "frontend/macrob/Parse.h"

#include "frontend/macrob/BlockWords.h"

#include <fmt/format.h>

namespace dotek::frontend::macrob {
namespace {

class Dumper {
public:
  Dumper(const SourceMap& sources, bool places) : sources_(sources), places_(places) {}

  std::string run(const File& file) {
    line({}, fmt::format("file{}{}", file.markFirst ? " %" : "", file.markLast ? " .. %" : ""));
    ++depth_;
    if (file.leader.begin < file.leader.end) line(file.leader, "leader");
    for (const Program& program : file.programs)
      dump(program);
    for (const SourceRange& legend : file.legends)
      line(legend, "legend " + quoted(std::string(sources_.text(legend))));
    return std::move(out_);
  }

private:
  void line(SourceRange range, const std::string& text) {
    out_.append(depth_ * 2, ' ');
    if (places_ && range.hasPlace()) {
      const LineColumn place = sources_.file(range.file).place(range.begin);
      out_ += fmt::format("{}:{} ", place.line, place.column);
    }
    out_ += text + "\n";
  }
  static std::string quoted(const std::string& bytes) {
    std::string out = "\"";
    for (const char c : bytes) {
      const auto byte = static_cast<unsigned char>(c);
      if (byte < 0x20 || byte > 0x7E || c == '"' || c == '\\')
        out += fmt::format("\\x{:02X}", byte);
      else
        out += c;
    }
    return out + "\"";
  }
  void comments(const std::vector<Comment>& list) {
    for (const Comment& comment : list)
      line(comment.range, fmt::format("comment {} {}", comment.place, quoted(comment.text)));
  }

  void dump(const Program& program) {
    std::string head = "program";
    if (program.name) {
      switch (program.name->kind) {
      case ProgramName::Kind::Number: head += " O" + program.name->text; break;
      case ProgramName::Kind::Colon: head += " :" + program.name->text; break;
      case ProgramName::Kind::Name: head += " <" + program.name->text + ">"; break;
      }
    }
    line(program.name ? program.name->range : SourceRange{}, head);
    ++depth_;
    comments(program.comments);
    for (const Block& block : program.blocks)
      dump(block);
    --depth_;
  }

  void dump(const Block& block) {
    std::string head = "block";
    if (block.blockDelete)
      head += block.blockDelete->number ? fmt::format(" /{}", *block.blockDelete->number) : " /";
    if (block.sequenceNumber) head += " N" + block.sequenceNumber->digits;
    if (block.repaired) head += " repaired";
    line(block.range, head);
    ++depth_;
    std::visit([&](const auto& body) { dump(body); }, block.body);
    comments(block.comments);
    --depth_;
  }

  void dump(const std::monostate&) {}
  void dump(const Words& words) {
    for (const nc::Word& word : words.words) {
      line(word.range, fmt::format("word {}", addressText(word.address)));
      inner(word.value);
    }
  }
  void dump(const nc::Assignment& assignment) {
    line(assignment.range, "assignment");
    inner(assignment.variable);
    inner(assignment.value);
  }
  void dump(const Goto& jump) {
    line(jump.range, "goto");
    inner(jump.target);
  }
  void dump(const If& branch) {
    line(branch.range, branch.then ? "if then" : "if");
    ++depth_;
    dump(branch.condition);
    std::visit([&](const auto& statement) { dump(statement); }, branch.statement);
    --depth_;
  }
  std::string loop(const std::optional<LoopNumber>& number) { return number ? " " + number->digits : " ?"; }
  void dump(const Do& statement) {
    line(statement.range, (statement.condition ? "while do" : "do") + loop(statement.loop));
    ++depth_;
    if (statement.condition) dump(statement.condition);
    --depth_;
  }
  void dump(const End& statement) { line(statement.range, "end" + loop(statement.loop)); }
  void dump(const Port& port) { line({}, port.open ? "popen" : "pclos"); }
  void dump(const Print& print) {
    line(print.range, print.binary ? "bprnt" : "dprnt");
    ++depth_;
    for (const auto& piece : print.pieces) {
      if (const auto* text = std::get_if<PrintedText>(&piece)) line({}, quoted(text->text));
      if (const auto* variable = std::get_if<PrintedVariable>(&piece))
        line({}, fmt::format("#{}[{}]", variable->variable, variable->format));
    }
    --depth_;
  }
  void dump(const SetNames& names) {
    std::string text = fmt::format("setvn {}", names.first);
    for (const std::string& name : names.names)
      text += " " + quoted(name);
    line(names.range, text);
  }
  void dump(const Unread& unread) { line(unread.range, "unread " + quoted(unread.text)); }

  void dump(const ConditionPtr& condition) {
    const std::string brackets = bracketText(condition->brackets);
    if (const auto* comparison = std::get_if<Comparison>(&condition->node)) {
      line(condition->range, "compare " + comparison->op + brackets);
      inner(comparison->left);
      inner(comparison->right);
    } else if (const auto* joined = std::get_if<JoinedConditions>(&condition->node)) {
      line(condition->range, "join " + joined->op + brackets);
      ++depth_;
      dump(joined->left);
      dump(joined->right);
      --depth_;
    }
  }

  static std::string bracketText(std::uint32_t count) {
    return count == 0 ? "" : fmt::format(" []{}", count);
  }

  void inner(const ExpressionPtr& expression) {
    ++depth_;
    if (expression == nullptr)
      line({}, "nothing");
    else
      dump(*expression);
    --depth_;
  }

  void dump(const Expression& expression) {
    const std::string brackets = bracketText(expression.brackets);
    std::visit(
        [&](const auto& node) {
          using T = std::decay_t<decltype(node)>;
          if constexpr (std::is_same_v<T, nc::Number>) {
            line(expression.range, "number " + node.digits + brackets);
          } else if constexpr (std::is_same_v<T, nc::Hole>) {
            line(expression.range, "hole " + node.name + brackets);
          } else if constexpr (std::is_same_v<T, nc::VariableRef>) {
            line(expression.range, "variable" + brackets);
            inner(node.number);
          } else if constexpr (std::is_same_v<T, nc::Negated>) {
            line(expression.range, "negated" + brackets);
            inner(node.operand);
          } else if constexpr (std::is_same_v<T, nc::Operation>) {
            line(expression.range, "operation " + node.op + brackets);
            inner(node.left);
            inner(node.right);
          } else {
            line(expression.range, fmt::format("function {}{}{}{}", node.name, node.bare ? " bare" : "",
                                               node.comma ? " comma" : "", brackets));
            for (const ExpressionPtr& argument : node.arguments)
              inner(argument);
          }
        },
        expression.node);
  }

  const SourceMap& sources_;
  bool places_;
  std::size_t depth_ = 0;
  std::string out_;
};

} // namespace

std::string dumpAst(const File& file, const SourceMap& sources, bool places) {
  return Dumper(sources, places).run(file);
}

} // namespace dotek::frontend::macrob
