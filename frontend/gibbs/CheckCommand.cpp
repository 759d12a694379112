#include "frontend/gibbs/CheckCommand.h"

#include "frontend/gibbs/Explain.h"
#include "frontend/gibbs/Unverified.h"
#include "frontend/gibbs/Walk.h"
#include "support/NearestName.h"
#include "support/messages/Gibbs.h"

#include <algorithm>

namespace dotek::frontend::gibbs {

using stdlib::ArgumentSpec;
using stdlib::CommandSignature;

std::string didYouMean(const std::string& name) {
  return name.empty() ? "" : fmt::format("; did you mean `{}`?", name);
}

namespace {

// One place for the sentences on the arguments of a command.
class ArgumentCheck {
public:
  ArgumentCheck(const Name& name, const std::vector<ExpressionPtr>& arguments, SourceRange range,
                const ParseContext& context)
      : name_(name), arguments_(arguments), range_(range), context_(context) {}

  void run(const std::vector<const CommandSignature*>& signatures) {
    const Match match = matchArguments(signatures, arguments_, context_.keywords, context_.sources);
    if (match.signature == nullptr) return;
    checkUnits(match);
    if (match.signature->unsure) return;
    if (isCutOff(signatures)) {
      context_.diagnostics.report<diag::CutOff>(range_, name_.text, signatureText(*match.signature));
      return;
    }
    bool kindReported = false;
    for (const Misfit& misfit : match.misfits) {
      if (misfit.kind == Misfit::Kind::Count) {
        // A word that is no keyword, or one argument too many: one of them is the cause.
        if (match.misfits.size() == 1 || !hasChoice(match)) reportCount(*match.signature);
      } else if (misfit.kind == Misfit::Kind::Choice) {
        reportChoice(match, misfit.argument, signatures);
      } else if (misfit.kind == Misfit::Kind::Parameter) {
        reportParameter(*match.specs[misfit.argument], misfit.argument);
      } else if (!kindReported) {
        reportKind(match, misfit);
        kindReported = true; // swapped arguments are one slip
      }
    }
  }

private:
  // The file ends behind the command, without a line end, and no form has so few arguments.
  bool isCutOff(const std::vector<const CommandSignature*>& signatures) const {
    if (range_.end < context_.sources.file(range_.file).bytes().size()) return false;
    return std::all_of(signatures.begin(), signatures.end(),
                       [&](const auto* signature) { return arguments_.size() < countOf(*signature).least; });
  }

  static bool hasChoice(const Match& match) {
    return std::any_of(match.misfits.begin(), match.misfits.end(),
                       [](const Misfit& m) { return m.kind == Misfit::Kind::Choice; });
  }

  std::string textOf(std::size_t argument) const {
    return context_.sources.textUtf8(arguments_[argument]->range);
  }

  void reportCount(const CommandSignature& signature) {
    const ArgumentCount count = countOf(signature);
    std::string takes = std::to_string(count.least);
    if (count.most == stdlib::kNoBound)
      takes = "at least " + takes;
    else if (count.most != count.least)
      takes += " to " + std::to_string(count.most);
    const std::size_t given = arguments_.size();
    context_.diagnostics.report<diag::ArgumentCountWrong>(
        given > count.most ? spanning(arguments_[count.most]->range, arguments_.back()->range) : range_,
        name_.text, given, given == 1 ? "argument" : "arguments", takes, signatureText(signature));
  }

  void reportChoice(const Match& match, std::size_t argument,
                    const std::vector<const CommandSignature*>& signatures) {
    std::vector<std::string> known;
    for (const CommandSignature* signature : signatures) {
      if (argument >= signature->arguments.size()) continue;
      for (const std::string& word : signature->arguments[argument].keywords)
        if (std::find(known.begin(), known.end(), word) == known.end()) known.push_back(word);
    }
    std::string list;
    for (std::size_t i = 0; i < known.size(); ++i)
      list += (i == 0 ? "" : ", ") + known[i];
    const SourceRange range = arguments_[argument]->range;
    if (match.signature->openKeywords) {
      context_.diagnostics.report<diag::UnverifiedName>(range, textOf(argument), name_.text, list);
      return;
    }
    const std::string word = keywordText(*arguments_[argument], context_.sources);
    NearestName nearest(word);
    for (const std::string& each : known)
      nearest.offer(each);
    const std::string tail =
        nearest.result().empty() ? "; here stands one of " + list : didYouMean(nearest.result());
    context_.diagnostics.report<diag::UnknownParameter>(range, name_.text, textOf(argument), tail);
  }

  void reportParameter(const ArgumentSpec& spec, std::size_t argument) {
    const std::string word = keywordText(*arguments_[argument], context_.sources);
    if (!context_.keywords.hasFamily(spec.family)) return;
    if (context_.diagnostics.full(diag::UnknownParameter::code, range_.file)) return;
    const std::string nearest = context_.keywords.nearestParameter(spec.family, word);
    if (context_.keywords.isOpenFamily(spec.family)) {
      context_.diagnostics.report<diag::UnverifiedName>(
          arguments_[argument]->range, textOf(argument), name_.text,
          nearest.empty() ? "none of them is near" : "nearest: " + nearest);
      return;
    }
    context_.diagnostics.report<diag::UnknownParameter>(arguments_[argument]->range, name_.text,
                                                        textOf(argument), didYouMean(nearest));
  }

  void reportKind(const Match& match, const Misfit& misfit) {
    const std::string given = fmt::format("`{}`", textOf(misfit.argument));
    std::string fact;
    switch (misfit.kind) {
    case Misfit::Kind::Variable: fact = given + " is no variable, but GibbsCAM writes a result there"; break;
    case Misfit::Kind::Array: fact = given + " is no name, but an array comes there"; break;
    case Misfit::Kind::Text: fact = given + " is a number, but a text comes there"; break;
    default: fact = given + " is a text, but a number comes there"; break;
    }
    context_.diagnostics.report<diag::ArgumentKindWrong>(arguments_[misfit.argument]->range, fact,
                                                         signatureText(*match.signature));
  }

  void checkUnits(const Match& match) {
    if (match.signature->name.rfind("FILE_", 0) != 0) return;
    for (std::size_t i = 0; i < arguments_.size(); ++i) {
      const auto* number = std::get_if<NumberLiteral>(&arguments_[i]->node);
      if (number == nullptr || match.specs[i] == nullptr || match.specs[i]->name != "unit") continue;
      if (number->value < 1 || number->value > 10)
        context_.diagnostics.report<diag::FileUnit>(arguments_[i]->range, number->text);
    }
  }

  const Name& name_;
  const std::vector<ExpressionPtr>& arguments_;
  SourceRange range_;
  const ParseContext& context_;
};

void checkFunction(const FunctionCall& call, SourceRange range, const ParseContext& context) {
  const stdlib::FunctionSpec* spec = context.keywords.function(call.name.text);
  if (spec == nullptr) {
    if (context.diagnostics.full(diag::UnknownFunction::code, range.file)) return;
    context.diagnostics.report<diag::UnknownFunction>(
        call.name.range, call.name.text, didYouMean(context.keywords.nearestFunction(call.name.text)));
    return;
  }
  if (spec->open) return;
  std::string form = spec->name + "(";
  for (std::size_t i = 0; i < spec->types.size(); ++i)
    form += (i == 0 ? "" : ", ") + std::string(spec->types[i] == 't' ? "text$" : "number");
  form += ")";
  if (call.arguments.size() != spec->types.size()) {
    const std::size_t given = call.arguments.size();
    context.diagnostics.report<diag::ArgumentCountWrong>(
        range, spec->name, given, given == 1 ? "argument" : "arguments", spec->types.size(), form);
    return;
  }
  for (std::size_t i = 0; i < call.arguments.size(); ++i) {
    const bool text = typeOf(*call.arguments[i], context.keywords) == ValueType::Text;
    if (text == (spec->types[i] == 't')) continue;
    const std::string given = fmt::format("`{}`", context.sources.textUtf8(call.arguments[i]->range));
    context.diagnostics.report<diag::ArgumentKindWrong>(
        call.arguments[i]->range,
        given + (text ? " is a text, but a number comes there" : " is a number, but a text comes there"),
        form);
  }
}

std::size_t characters(const std::string& bytes, const ParseContext& context, SourceRange range) {
  if (context.sources.file(range.file).encoding() != Encoding::Utf8) return bytes.size();
  return static_cast<std::size_t>(std::count_if(
      bytes.begin(), bytes.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

} // namespace

void checkArguments(const Name& name, const std::vector<ExpressionPtr>& arguments,
                    const std::vector<const CommandSignature*>& signatures, SourceRange range,
                    const ParseContext& context) {
  ArgumentCheck(name, arguments, range, context).run(signatures);
}

void checkCommand(const Command& command, SourceRange range,
                  const std::function<bool(const std::string&)>& isVariable, const ParseContext& context) {
  const std::string key = foldCase(command.name.text);
  if (context.keywords.isCore(key)) {
    context.diagnostics.report<diag::MisplacedWord>(
        command.name.range,
        "`" + command.name.text + "` stands only between the `[` and `]` of CONTOUR, CONTOUR_3D or POINTS");
    return;
  }
  if (const auto renamed = context.keywords.renamedTo(key)) {
    context.diagnostics.report<diag::RenamedCommand>(command.name.range, command.name.text, *renamed);
    checkArguments(command.name, command.arguments, context.keywords.commands(*renamed), range, context);
    return;
  }
  const std::vector<const CommandSignature*> signatures = context.keywords.commands(key);
  if (!signatures.empty()) {
    checkArguments(command.name, command.arguments, signatures, range, context);
    return;
  }
  if (context.keywords.isCommand(key) || context.keywords.hasCommandPrefix(key)) return;
  if (context.diagnostics.full(diag::UnknownCommand::code, range.file)) return;
  std::string remedy;
  const std::string foreign = explainForeignWord(key);
  if (!foreign.empty())
    remedy = "; " + foreign;
  else if (isVariable(key))
    remedy = "; it is a variable of this macro: is `=` missing?";
  else if (context.keywords.function(key) != nullptr)
    remedy = "; it is a function, which stands inside an expression";
  else if (!context.keywords.dialogControls(key).empty())
    remedy = "; it is a control, which stands in a dialog file (.dlg)";
  else
    remedy = didYouMean(context.keywords.nearestCommand(key));
  context.diagnostics.report<diag::UnknownCommand>(command.name.range, command.name.text, remedy);
}

void checkExpression(const Expression& expression, const std::set<std::string>& arrays,
                     const ParseContext& context) {
  walkExpression(expression, [&](const Expression& each) {
    if (const auto* literal = std::get_if<TextLiteral>(&each.node)) {
      const std::size_t length = literal->text.size() > context.limits.textLength
                                     ? characters(literal->text, context, each.range)
                                     : literal->text.size();
      if (length > context.limits.textLength)
        context.diagnostics.report<diag::TextTooLong>(each.range, length, context.limits.textLength);
    } else if (const auto* call = std::get_if<FunctionCall>(&each.node)) {
      checkFunction(*call, each.range, context);
    } else if (const auto* element = std::get_if<VariableRef>(&each.node)) {
      // `abss(x)` is an element of an array only where the file knows such an array.
      if (element->index == nullptr || element->bracket != '(' ||
          arrays.count(foldCase(element->name.text)) != 0)
        return;
      if (context.diagnostics.full(diag::UnknownFunction::code, each.range.file)) return;
      const std::string nearest = context.keywords.nearestFunction(element->name.text);
      context.diagnostics.report<diag::UnknownFunction>(
          element->name.range, element->name.text,
          nearest.empty() ? "; an array of this name is not declared here either" : didYouMean(nearest));
    } else if (const auto* unary = std::get_if<Unary>(&each.node)) {
      if (typeOf(*unary->operand, context.keywords) == ValueType::Text)
        context.diagnostics.report<diag::TextToNumber>(each.range, "a sign stands before a text");
    } else if (const auto* binary = std::get_if<Binary>(&each.node)) {
      // The left side of a chain is judged at its own link.
      const bool leftIsLink = std::holds_alternative<Binary>(binary->left->node);
      const bool left = !leftIsLink && typeOf(*binary->left, context.keywords) == ValueType::Text;
      const bool right = typeOf(*binary->right, context.keywords) == ValueType::Text;
      const bool mixed = !leftIsLink && left != right;
      if ((binary->op != BinaryOperator::Add && (left || right)) || mixed)
        context.diagnostics.report<diag::TextToNumber>(each.range,
                                                       "a text and a number are computed with one another");
    }
  });
}

} // namespace dotek::frontend::gibbs
