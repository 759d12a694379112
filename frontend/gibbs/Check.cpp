#include "frontend/gibbs/Check.h"

#include "frontend/gibbs/CheckFlow.h"
#include "frontend/gibbs/Unverified.h"
#include "frontend/gibbs/Walk.h"
#include "support/messages/Common.h"
#include "support/messages/Gibbs.h"

#include <algorithm>
#include <array>

namespace dotek::frontend::gibbs {

std::string didYouMean(const std::string& name) {
  return name.empty() ? "" : fmt::format("; did you mean `{}`?", name);
}

CheckedFile::CheckedFile(const Macro& parsed, std::vector<const Macro*> included, const ParseContext& context)
    : macro(&parsed), file(parsed.file), sources(context.sources), keywords(context.keywords),
      limits(context.limits), flow(flowOf(parsed, included, context)) {
  if (flow.tooDeep) context.diagnostics.report<diag::NestingTooDeep>(*flow.tooDeep, limits.nesting);
  collectNames(parsed);
  for (const Macro* other : included)
    collectNames(*other);
  walkLines(parsed.lines, [&](const Statement& statement) { add(statement); });
  reportCutOff(context.diagnostics);
}

CheckedFile::CheckedFile(const Dialog& parsed, const ParseContext& context)
    : dialog(&parsed), file(parsed.file), sources(context.sources), keywords(context.keywords),
      limits(context.limits) {
  for (const Control& control : parsed.controls)
    add(control);
  reportCutOff(context.diagnostics);
}

CheckedFile::CheckedFile(const DefineData& parsed, const ParseContext& context)
    : defines(&parsed), file(parsed.file), sources(context.sources), keywords(context.keywords),
      limits(context.limits) {
  for (const Definition& definition : parsed.definitions)
    add(*definition.value);
}

void CheckedFile::collectNames(const Macro& from) {
  const auto add = [&](const VariableRef& target) {
    variables.insert(foldCase(target.name.text));
    if (target.index != nullptr) arrays.insert(foldCase(target.name.text));
  };
  walkLines(from.lines, [&](const Statement& statement) {
    if (const auto* assign = std::get_if<Assignment>(&statement.node)) add(assign->target);
    if (const auto* loop = std::get_if<For>(&statement.node)) variables.insert(foldCase(loop->variable.text));
    if (const auto* args = std::get_if<Args>(&statement.node))
      for (const VariableRef& name : args->names)
        add(name);
    if (const auto* declared = std::get_if<Declaration>(&statement.node))
      for (const VariableRef& name : declared->names)
        add(name);
    ownExpressions(statement, [&](const Expression& expression) {
      walkExpression(expression, [&](const Expression& each) {
        const auto* reference = std::get_if<VariableRef>(&each.node);
        if (reference != nullptr && reference->index == nullptr &&
            !std::holds_alternative<Command>(statement.node))
          variables.insert(foldCase(reference->name.text));
      });
    });
  });
}

void CheckedFile::add(const Expression& expression) {
  walkExpression(expression, [&](const Expression& each) { expressions.push_back(&each); });
}

void CheckedFile::add(const Statement& statement) {
  statements.push_back(&statement);
  ownExpressions(statement, [&](const Expression& expression) { add(expression); });
  if (const auto* command = std::get_if<Command>(&statement.node)) {
    const std::string key = foldCase(command->name.text);
    if (keywords.isCore(key)) return;
    const auto renamed = keywords.renamedTo(key);
    call(command->name, command->arguments, keywords.commands(renamed ? std::string(*renamed) : key),
         statement.range);
  } else if (const auto* block = std::get_if<std::unique_ptr<GeometryBlock>>(&statement.node)) {
    for (std::size_t i = 0; i < (*block)->elements.size(); ++i) {
      const Command& element = (*block)->elements[i];
      if (belongs(element, **block))
        call(element.name, element.arguments, keywords.commands(foldCase(element.name.text)),
             (*block)->elementRanges[i]);
    }
  }
}

void CheckedFile::add(const Control& control) {
  const std::string key = foldCase(control.kind.text);
  if (!keywords.isUnprovedControl(key) && looseCaptionOf(control) == nullptr)
    call(control.kind, control.arguments, keywords.dialogControls(key), control.range);
  for (const ExpressionPtr& argument : control.arguments)
    add(*argument);
}

void CheckedFile::call(const Name& name, const std::vector<ExpressionPtr>& arguments,
                       std::vector<const stdlib::CommandSignature*> signatures, SourceRange range) {
  if (signatures.empty()) return;
  Call made{&name, &arguments, range, std::move(signatures), {}};
  made.match = matchArguments(made.signatures, arguments, keywords, sources);
  // Without a line end after it.
  made.cutOff = range.end >= sources.file(range.file).bytes().size() &&
                std::all_of(made.signatures.begin(), made.signatures.end(), [&](const auto* signature) {
                  return arguments.size() < countOf(*signature).least;
                });
  calls.push_back(std::move(made));
}

void CheckedFile::reportCutOff(Diagnostics& diagnostics) const {
  for (const Call& call : calls)
    if (call.cutOff && !call.match.signature->unsure)
      diagnostics.report<diag::CutOff>(call.range, call.name->text, signatureText(*call.match.signature));
}

std::span<const Check<CheckedFile>* const> fileChecks() {
  static constexpr std::array kChecks = {
      &undefinedLabelCheck,      &duplicateLabelCheck,      &forWithoutNextCheck,  &nextWithoutForCheck,
      &nextOfOtherForCheck,      &continueOutsideForCheck,  &unknownCommandCheck,  &renamedCommandCheck,
      &misplacedWordCheck,       &argumentCountCheck,       &argumentKindCheck,    &unknownParameterCheck,
      &unverifiedNameCheck,      &unknownFunctionCheck,     &fileUnitCheck,        &tooManyNamesCheck,
      &textAndNumberCheck,       &textTooLongCheck,         &commaBeforeThenCheck, &unverifiedConstructCheck,
      &dialogWithoutOkCheck,     &dialogWithoutCancelCheck, &dialogNotFirstCheck,  &controlTwiceCheck,
      &unknownControlCheck,      &variableTwiceCheck,       &imageNameCheck,       &looseCaptionCheck,
      &duplicateDefinitionCheck, &fieldValueCheck,
  };
  return kChecks;
}

void checkMacro(const Macro& macro, const std::vector<const Macro*>& included, const ParseContext& context) {
  runChecks(fileChecks(), CheckedFile(macro, included, context), context.diagnostics);
}

void checkDialog(const Dialog& dialog, const ParseContext& context) {
  runChecks(fileChecks(), CheckedFile(dialog, context), context.diagnostics);
}

void checkDefineData(const DefineData& data, const ParseContext& context) {
  runChecks(fileChecks(), CheckedFile(data, context), context.diagnostics);
}

} // namespace dotek::frontend::gibbs
