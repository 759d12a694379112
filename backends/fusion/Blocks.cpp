// Blocks: texts of values first, then lines.
#include "backends/common/ToolLength.h"
#include "backends/fusion/State.h"
#include "ir/Fold.h"
#include "ir/Walk.h"
#include "support/Decimal.h"
#include "support/messages/Fanuc.h"
#include "support/messages/Fusion.h"
#include "support/messages/Nc.h"

#include <algorithm>
#include <cmath>

namespace dotek::backends::fusion {

namespace {

constexpr int kDecimals = 3; // of the fixed format
constexpr double kSame = 1e-9;

struct Line {
  Text text;
  bool numbered = true;
  ir::Origin origin;
  std::string comment; // the whole line is this comment
};

bool isAscii(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

// "A TEXT" where the line is one comment and nothing else; "": it is not.
std::string commentOf(const ir::PrintedBlock& block) {
  std::string text;
  for (const ir::PrintedPiece& piece : block.pieces) {
    if (piece.picture) return "";
    text += piece.text;
  }
  if (block.numbered || text.size() < 3 || text.front() != '(' || text.back() != ')') return "";
  text = text.substr(1, text.size() - 2);
  return text.find_first_of("()") == std::string::npos ? text : "";
}

// "N8012", which jumps of the Prog name, at the beginning of a block; "": none.
std::string numberOf(const ir::PrintedBlock& block) {
  if (block.numbered || block.pieces.empty() || block.pieces.front().picture) return "";
  const std::string& text = block.pieces.front().text;
  const std::size_t end = std::min(text.find_first_not_of("0123456789", 1), text.size());
  return text.starts_with('N') && end > 1 ? text.substr(0, end) : "";
}

// `macros`: where they are not the source's.
Line printed(State& state, Texts& texts, const ir::PrintedBlock& block, MacroBlocks* macros = nullptr) {
  Line line;
  line.numbered = block.numbered;
  line.origin.ranges = {block.range};
  line.comment = commentOf(block);
  for (const ir::PrintedPiece& piece : block.pieces) {
    if (piece.picture) {
      texts.picture(line.text, piece, block.range);
      continue;
    }
    if (!isAscii(piece.text)) state.diagnostics.report<diag::FusionNotAscii>(piece.range);
    if (macros == nullptr)
      line.text.add(piece.text);
    else
      macros->piece(line.text, piece.text,
                    &piece != &block.pieces.back() && (&piece + 1)->picture.has_value(), line.origin);
  }
  if (macros != nullptr) macros->endBlock(line.origin);
  return line;
}

// No number of digits holds it; that some are left out is nobody's mistake.
bool isIrrational(const ir::ExpressionPtr& value) {
  bool found = false;
  ir::eachNode(value, [&](const ir::Expression& node) {
    const auto* unary = std::get_if<ir::Unary>(&node.node);
    found =
        found || (unary != nullptr && (unary->op == ir::UnaryOp::Sine || unary->op == ir::UnaryOp::Cosine));
  });
  return found;
}

// The block is printed with every word that it has.
void stands(State& state, SourceRange block) {
  std::erase_if(state.diagnostics.all(), [&](const Diagnostic& one) {
    return one.code == diag::WordLeftOut::code && one.range.file == block.file &&
           one.range.begin >= block.begin && one.range.end <= block.end;
  });
}

} // namespace

void Text::addExpression(std::string expression) {
  if (!pending_.empty()) parts_.push_back(quoted(std::exchange(pending_, "")));
  parts_.push_back(std::move(expression));
}

std::string Text::expression() const {
  std::string out;
  for (const std::string& part : parts_)
    out += (out.empty() ? "" : " + ") + part;
  if (!pending_.empty() || out.empty()) out += (out.empty() ? "" : " + ") + quoted(pending_);
  return out;
}

void Texts::picture(Text& text, const ir::PrintedPiece& piece, SourceRange block) {
  const Picture& picture = *piece.picture;
  const ir::Variable& variable = state_.cycle.variable(piece.variable);
  if (const auto fixed = state_.options.fixed.find(piece.variable); fixed != state_.options.fixed.end()) {
    const Picture::Printed shown = picture.print(fixed->second); // one that does not fit was refused
    if (shown.fit == Picture::Fit::LosesDecimals)
      state_.diagnostics.report<diag::FusionDigits>(piece.range, piece.name, numberText(fixed->second),
                                                    shown.text);
    text.add(shown.text);
    return;
  }
  const std::string key = picture.text() + "\n" + std::to_string(piece.variable);
  const auto [known, fresh] = known_.emplace(key, "");
  if (fresh) {
    ir::Origin origin;
    origin.ranges = {piece.range, block};
    const std::string value = state_.name(piece.variable);
    const std::string arguments = "(" + quoted(picture.text()) + ", " + value + ")";
    known->second = state_.names.take(value + "Text");
    state_.script.add("var " + known->second + " = " + state_.helper(Helper::Picture) + arguments + ";",
                      origin);
    state_.errorIf(known->second + " === null", variable.name + " does not fit " + picture.text(), origin);
    state_.script.add(state_.helper(Helper::Loses) + "(" + quoted(variable.name) + ", " + value + ", " +
                          state_.helper(Helper::Shown) + arguments + ");",
                      origin);
    const auto given = state_.options.defaults.find(piece.variable);
    if (given != state_.options.defaults.end()) {
      const Picture::Printed shown = picture.print(given->second);
      if (shown.fit == Picture::Fit::DoesNotFit)
        state_.diagnostics.report<diag::FusionDoesNotFit>(variable.range, variable.name,
                                                          numberText(given->second), picture.text());
      else if (shown.fit == Picture::Fit::LosesDecimals)
        state_.diagnostics.report<diag::FusionDigits>(
            variable.range, "the default of `" + variable.name + "`", numberText(given->second), shown.text);
    }
  }
  text.addExpression(known->second);
}

void Texts::number(Text& text, const ir::ExpressionPtr& given, const ir::Origin& origin, bool fine) {
  const ir::ExpressionPtr value = ir::simplify(given);
  const SourceRange range = value->range.hasPlace() ? value->range : origin.range();
  if (const double* constant = ir::constantValue(value)) {
    const Decimal rounded = Decimal::of(*constant).rounded(kDecimals);
    if (static_cast<int>(rounded.integerPart().size()) > state_.options.control.integerDigits)
      state_.refuse<diag::NumberTooLarge>(range, numberText(*constant), state_.options.control.integerDigits,
                                          state_.options.control.title);
    if (std::abs(rounded.value() - *constant) > kSame)
      state_.diagnostics.report<diag::NumberRounded>(range, numberText(*constant),
                                                     numberText(rounded.value()));
    const std::string digits = numberText(rounded.value());
    text.add(digits + (digits.find('.') == std::string::npos ? "." : ""));
    return;
  }
  const std::string expression = valueText(state_, value, range);
  const bool rounds = isIrrational(value);
  const Helper helper = fine && rounds ? Helper::Fine : Helper::Number;
  const auto [known, fresh] = known_.emplace((helper == Helper::Fine ? "fine " : "") + expression, "");
  if (fresh) {
    const auto* use = std::get_if<ir::VariableUse>(&value->node);
    guardArithmetic(state_, value, origin);
    known->second = state_.names.take(use != nullptr ? expression + "Text" : std::string("text"));
    const std::string& name = known->second;
    state_.script.add("var " + name + " = " + state_.helper(helper) + "(" + expression + ");", origin);
    state_.errorIf(name + " === null", expression + " has too many digits for the control", origin);
    if (!rounds)
      state_.script.add(state_.helper(Helper::Loses) + "(" + quoted(expression) + ", " + expression +
                            ", Number(" + name + "));",
                        origin);
  }
  text.addExpression(known->second);
}

void writeBlocks(State& state) {
  for (const LengthOffset& offset : lengthOffsets(state.cycle, state.options.control))
    if (offset.always && ir::constantValue(offset.word->value) == nullptr &&
        isOfArguments(state.cycle, offset.word->value)) {
      const ir::Origin& origin = state.cycle.body[offset.at].origin;
      state.errorIf(valueText(state, offset.word->value, origin.range()) + " <= 0",
                    "the tool offset is not above 0, and the length of the tool would be taken away", origin);
    }
  Texts texts(state);
  MacroBlocks macros(state, texts);
  std::vector<Line> lines;
  const auto& blocks = state.options.printed;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (!state.options.foreignMacros) {
      lines.push_back(printed(state, texts, blocks[i]));
      continue;
    }
    std::vector<const ir::CycleStatement*> statements;
    for (const ir::CycleStatement& statement : state.cycle.body)
      if (statement.origin.block == i + 1) statements.push_back(&statement);
    if (statements.empty()) continue; // it says nothing, or nobody reaches it
    std::vector<Text> own;
    if (!macros.block(statements, own)) {
      stands(state, blocks[i].range);
      lines.push_back(printed(state, texts, blocks[i], &macros));
      continue;
    }
    // Jumps of other blocks lead here.
    if (const std::string number = numberOf(blocks[i]); !number.empty()) {
      Text text;
      text.add(number);
      lines.push_back({std::move(text), false, statements.front()->origin, ""});
    }
    for (Text& text : own) {
      ir::Origin origin = statements.front()->origin;
      if (!text.reason().empty()) origin.reason = text.reason();
      lines.push_back({std::move(text), true, std::move(origin), ""});
    }
  }
  Text last;
  if (const ir::Origin* origin = macros.putBack(last)) lines.push_back({std::move(last), true, *origin, ""});
  for (const Line& line : lines) {
    if (!line.comment.empty())
      state.script.add(state.helper(Helper::Comment) + "(" + quoted(line.comment) + ");", line.origin);
    else
      state.script.add((line.numbered ? "writeBlock(" : "writeln(") + line.text.expression() + ");",
                       line.origin);
  }
  for (const char* output : {"xOutput", "yOutput", "zOutput", "feedOutput", "gMotionModal"})
    state.script.add(std::string(output) + ".reset();");
}

} // namespace dotek::backends::fusion
