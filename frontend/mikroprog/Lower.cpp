#include "frontend/mikroprog/Lower.h"

#include <string>
#include <utility>

namespace dotek::frontend::mikroprog {

namespace {

ir::ExpressionPtr parameterNumber(std::uint32_t number, SourceRange range) {
  return ir::constant(number, range, std::to_string(number));
}

ir::ExpressionPtr lowered(const Value& value, SourceRange range) {
  if (!value.parameter) return ir::constant(value.number.value_or(0), range, value.digits);
  const ir::ExpressionPtr read = ir::machineVariable(parameterNumber(*value.parameter, range), range);
  return value.negative ? ir::unary(ir::UnaryOp::Negate, read, range) : read;
}

ir::BinaryOp operatorOf(char op) {
  switch (op) {
  case '-': return ir::BinaryOp::Subtract;
  case '*': return ir::BinaryOp::Multiply;
  case '/': return ir::BinaryOp::Divide;
  default: return ir::BinaryOp::Add; // the parser reads no other
  }
}

// Worked off from the left; whether the control knows precedence is not known (Q10).
ir::ExpressionPtr lowered(const Assignment& assignment) {
  ir::ExpressionPtr out;
  for (const Term& term : assignment.terms) {
    const ir::ExpressionPtr next = lowered(term.value, term.range);
    out = out == nullptr ? next : ir::binary(operatorOf(term.op), out, next, assignment.range);
  }
  return out;
}

class Lowering {
public:
  explicit Lowering(const SourceMap& sources) : sources_(sources) {}

  bool line(const Line& line) {
    if (line.unread) return false;
    ++block_;
    if (line.number) {
      const std::string digits(sources_.text(line.numberRange).substr(1));
      add(ir::Label{out_.addLabel({*line.number, digits, line.numberRange})}, line.numberRange);
    }
    if (line.assignment)
      add(ir::Store{parameterNumber(line.assignment->parameter, line.assignment->range),
                    lowered(*line.assignment)},
          line.range);
    if (!line.words.empty()) {
      ir::NcBlock block;
      for (const Word& word : line.words)
        block.words.push_back(
            {word.address, word.address == '@' ? file(word) : lowered(word.value, word.range), word.range});
      add(std::move(block), line.range);
    }
    if (line.comment) {
      add(ir::Comment{text(line.commentRange)}, line.commentRange);
      out_.body.back().origin.place = static_cast<std::uint32_t>(line.words.size());
    }
    return true;
  }

  ir::Program finish(const Program& program) {
    if (!program.lines.empty()) out_.range = program.lines.front().range;
    return std::move(out_);
  }

private:
  // Without the mark in front.
  std::string text(SourceRange range) const {
    return sources_.textUtf8({range.file, range.begin + 1, range.end});
  }
  ir::ExpressionPtr file(const Word& word) const { return ir::constant(0, word.range, text(word.range)); }

  template <class Node> void add(Node node, SourceRange range) {
    ir::ProgramStatement statement;
    statement.node = std::move(node);
    statement.origin.ranges = {range};
    statement.origin.block = block_;
    out_.body.push_back(std::move(statement));
  }

  const SourceMap& sources_;
  ir::Program out_;
  std::uint32_t block_ = 0;
};

} // namespace

std::optional<ir::ProgramFile> lower(const Program& program, const SourceMap& sources) {
  Lowering lowering(sources);
  for (const Line& line : program.lines)
    if (!lowering.line(line)) return std::nullopt;
  ir::ProgramFile out;
  out.programs.push_back(lowering.finish(program));
  return out;
}

} // namespace dotek::frontend::mikroprog
