#include "frontend/gibbs/BuildTree.h"
#include "support/messages/Common.h"

#include <cmath>

namespace dotek::frontend::gibbs {

namespace {

// A plain number of pixels, with or without a sign.
std::optional<int> pixels(const Expression& expression) {
  if (const auto* unary = std::get_if<Unary>(&expression.node)) {
    const std::optional<int> inner = pixels(*unary->operand);
    if (!inner) return std::nullopt;
    return unary->op == UnaryOperator::Minus ? -*inner : *inner;
  }
  const auto* number = std::get_if<NumberLiteral>(&expression.node);
  if (number == nullptr || std::abs(number->value) > 1e6) return std::nullopt;
  return static_cast<int>(std::lround(number->value));
}

// Box, text and variable of a control, where its signature says they stand.
void readArguments(Control& control, const std::vector<const stdlib::CommandSignature*>& signatures) {
  if (signatures.empty()) return;
  Box box;
  int sides = 0;
  const std::vector<stdlib::ArgumentSpec>& specs = signatures.front()->arguments;
  for (std::size_t i = 0; i < specs.size() && i < control.arguments.size(); ++i) {
    const Expression& argument = *control.arguments[i];
    const std::string& role = specs[i].name;
    int* side = role == "left"     ? &box.left
                : role == "top"    ? &box.top
                : role == "width"  ? &box.width
                : role == "height" ? &box.height
                                   : nullptr;
    if (side != nullptr) {
      if (const std::optional<int> value = pixels(argument)) {
        *side = *value;
        ++sides;
      }
    } else if (role == "text" || role == "caption") {
      if (const auto* literal = std::get_if<TextLiteral>(&argument.node)) control.text = literal->text;
      // A caption of one word without quotes looks like a variable.
      if (const auto* word = std::get_if<VariableRef>(&argument.node);
          word != nullptr && word->index == nullptr && !word->name.isText() && role == "caption")
        control.text = word->name.text;
    } else if (role == "variable") {
      if (const auto* variable = std::get_if<VariableRef>(&argument.node)) control.variable = variable->name;
    } else if (role == "default") {
      control.initial = &argument;
    }
  }
  if (sides == 4) control.box = box;
}

std::optional<Control> buildControl(MacroParser::ControlContext& tree, Lines& lines) {
  TreeBuilder build(lines);
  Control control;
  control.range = lines.rangeOf(tree);
  control.kind = build.name(*tree.COMMAND());
  for (MacroParser::ControlArgumentContext* each : tree.controlArgument()) {
    const SourceRange range = lines.rangeOf(*each);
    if (auto* test = dynamic_cast<MacroParser::ValueArgumentContext*>(each)) {
      if (test->relation() == nullptr) {
        control.arguments.push_back(build.sum(*test->sum(0)));
        continue;
      }
      if (foldCase(control.kind.text) != "SET_STATE" || each != tree.controlArgument(0)) {
        lines.report<diag::SyntaxError>(range, "a comparison is only in SET_STATE, as its first argument");
        return std::nullopt;
      }
      control.condition = build.comparison(*test->sum(0), *test->relation(), *test->sum(1));
    } else {
      if (foldCase(control.kind.text) != "FRAME") {
        const std::string text = lines.sources().textUtf8(range);
        lines.report<diag::SyntaxError>(
            range,
            "`" + text +
                "` is no single value; a text is between quotes, and arguments are separated by commas");
        return std::nullopt;
      }
      auto caption = std::make_unique<Expression>();
      caption->range = range;
      caption->node = TextLiteral{lines.textOf(range), 0};
      control.arguments.push_back(std::move(caption));
    }
  }
  if (lines.hasError()) return std::nullopt;
  readArguments(control, lines.context().keywords.dialogControls(control.kind.text));
  return control;
}

} // namespace

Dialog parseDialog(FileId file, const ParseContext& context) {
  Dialog dialog;
  dialog.file = file;
  Lines lines(file, FileKind::Dialog, context);
  while (lines.next()) {
    auto* tree = dynamic_cast<MacroParser::ControlLineContext*>(lines.parse());
    if (tree == nullptr || tree->control() == nullptr) continue;
    if (std::optional<Control> control = buildControl(*tree->control(), lines)) {
      dialog.controls.push_back(std::move(*control));
    }
  }
  dialog.comments = lines.comments();
  dialog.hasErrorNodes = lines.finish();
  return dialog;
}

DefineData parseDefineData(FileId file, const ParseContext& context) {
  DefineData data;
  data.file = file;
  Lines lines(file, FileKind::DefineData, context);
  TreeBuilder build(lines);
  while (lines.next()) {
    auto* tree = dynamic_cast<MacroParser::DefinitionLineContext*>(lines.parse());
    if (tree == nullptr || tree->definition() == nullptr) continue;
    MacroParser::DefinitionContext& definition = *tree->definition();
    VariableRef target = build.variable(*definition.variable());
    Definition made;
    made.range = lines.rangeOf(definition);
    made.name = target.name;
    made.value = build.sum(*definition.sum());
    made.valueRange = made.value->range;
    if (target.index != nullptr)
      lines.report<diag::SyntaxError>(lines.rangeOf(*definition.variable()),
                                      "an element of an array cannot be declared here; each line of "
                                      "DefineData.txt reads `NAME = number`");
    if (lines.hasError()) continue;
    const Expression* value = made.value.get();
    double sign = 1;
    while (const auto* unary = std::get_if<Unary>(&value->node)) {
      if (unary->op == UnaryOperator::Minus) sign = -sign;
      value = unary->operand.get();
    }
    if (const auto* number = std::get_if<NumberLiteral>(&value->node))
      made.number = number->value == 0 ? 0 : sign * number->value;
    data.definitions.push_back(std::move(made));
  }
  data.comments = lines.comments();
  data.hasErrorNodes = lines.finish();
  return data;
}

} // namespace dotek::frontend::gibbs
