#include "frontend/gibbs/CheckCommand.h"
#include "frontend/gibbs/CheckFlow.h"
#include "frontend/gibbs/Unverified.h"
#include "frontend/gibbs/Walk.h"
#include "support/messages/Gibbs.h"

namespace dotek::frontend::gibbs {

namespace {

class MacroCheck {
public:
  MacroCheck(const Macro& macro, const ParseContext& context) : macro_(macro), context_(context) {}

  void run(const std::vector<const Macro*>& included) {
    collectNames(macro_);
    for (const Macro* other : included)
      collectNames(*other);
    std::vector<SourceRange> intoFor;
    checkFlow(macro_, included, context_, intoFor);
    walkLines(macro_.lines, [&](const Statement& statement) { check(statement); });
    for (const SourceRange& range : intoFor)
      note({"goto-into-for", range});
  }

private:
  // One note a file and construct.
  void note(const Unverified& found) {
    if (!noted_.insert(found.assumption).second) return;
    const Assumption* assumption = findAssumption(found.assumption);
    context_.diagnostics.report<diag::UnverifiedConstruct>(found.range, assumption->construct,
                                                           assumption->reading, assumption->id);
  }

  void collectNames(const Macro& macro) {
    const auto add = [&](const VariableRef& target) {
      variables_.insert(foldCase(target.name.text));
      if (target.index != nullptr) arrays_.insert(foldCase(target.name.text));
    };
    walkLines(macro.lines, [&](const Statement& statement) {
      if (const auto* assign = std::get_if<Assignment>(&statement.node)) add(assign->target);
      if (const auto* loop = std::get_if<For>(&statement.node))
        variables_.insert(foldCase(loop->variable.text));
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
            variables_.insert(foldCase(reference->name.text));
        });
      });
    });
  }

  void check(const Statement& statement) {
    for (const Unverified& found : unverifiedIn(statement, context_.keywords))
      note(found);
    const std::size_t before = context_.diagnostics.all().size();
    ownExpressions(statement,
                   [&](const Expression& expression) { checkExpression(expression, arrays_, context_); });
    const bool sound = context_.diagnostics.all().size() == before;
    if (const auto* assign = std::get_if<Assignment>(&statement.node); assign != nullptr && sound)
      checkAssignment(*assign);
    if (const auto* branch = std::get_if<If>(&statement.node)) checkIf(*branch);
    if (const auto* loop = std::get_if<For>(&statement.node)) checkFor(*loop);
    if (const auto* call = std::get_if<CallMacro>(&statement.node))
      checkCount("CALL", 10, "values", call->arguments.size(), statement.range);
    if (const auto* args = std::get_if<Args>(&statement.node))
      checkCount("ARGS", 50, "names", args->names.size(), statement.range);
    if (const auto* declared = std::get_if<Declaration>(&statement.node)) {
      static constexpr const char* kWords[] = {"GLOBAL", "LOCAL", "PERMANENT"};
      checkCount(kWords[static_cast<std::size_t>(declared->scope)], 50, "names", declared->names.size(),
                 statement.range);
    }
    if (const auto* command = std::get_if<Command>(&statement.node))
      checkCommand(
          *command, statement.range, [&](const std::string& key) { return variables_.count(key) != 0; },
          context_);
    if (const auto* block = std::get_if<std::unique_ptr<GeometryBlock>>(&statement.node))
      checkGeometry(**block);
  }

  void checkCount(const char* word, std::size_t most, const char* what, std::size_t given,
                  SourceRange range) {
    if (given > most) context_.diagnostics.report<diag::TooManyNames>(range, word, most, what, given);
  }

  void checkAssignment(const Assignment& assign) {
    const bool text = typeOf(*assign.value, context_.keywords) == ValueType::Text;
    if (text == assign.target.name.isText()) return;
    context_.diagnostics.report<diag::TextToNumber>(
        assign.value->range, text ? "a text is assigned to the number `" + assign.target.name.text + "`"
                                  : "a number is assigned to the text `" + assign.target.name.text + "`");
  }

  void checkIf(const If& branch) {
    if (branch.commaBeforeThen) context_.diagnostics.report<diag::CommaBeforeThen>(*branch.commaBeforeThen);
    for (const Comparison& comparison : branch.condition.comparisons)
      if (typeOf(*comparison.left, context_.keywords) != typeOf(*comparison.right, context_.keywords))
        context_.diagnostics.report<diag::TextToNumber>(comparison.range, "a text is compared with a number");
  }

  void checkFor(const For& loop) {
    for (const ExpressionPtr* bound : {&loop.from, &loop.to, &loop.step})
      if (*bound != nullptr && typeOf(**bound, context_.keywords) == ValueType::Text)
        context_.diagnostics.report<diag::TextToNumber>((*bound)->range,
                                                        "FOR counts with numbers, and this is a text");
  }

  void checkGeometry(const GeometryBlock& block) {
    const bool points = foldCase(block.kind.text) == "POINTS";
    for (std::size_t i = 0; i < block.elements.size(); ++i) {
      const Command& element = block.elements[i];
      const std::string key = foldCase(element.name.text);
      const bool isPoint = key == "POINT";
      const bool isPart = isPoint || key == "START" || key == "RAPID" || key == "LINE" || key == "ARC";
      if (!isPart || isPoint != points) {
        context_.diagnostics.report<diag::MisplacedWord>(
            element.name.range, "`" + element.name.text + "` stands in a block of " +
                                    foldCase(block.kind.text) + ", which holds " +
                                    (points ? "POINT only" : "START, RAPID, LINE and ARC only"));
        continue;
      }
      checkArguments(element.name, element.arguments, context_.keywords.commands(key), block.elementRanges[i],
                     context_);
    }
  }

  const Macro& macro_;
  const ParseContext& context_;
  std::set<std::string_view> noted_;
  std::set<std::string> variables_;
  std::set<std::string> arrays_;
};

} // namespace

void checkMacro(const Macro& macro, const std::vector<const Macro*>& included, const ParseContext& context) {
  MacroCheck(macro, context).run(included);
}

} // namespace dotek::frontend::gibbs
