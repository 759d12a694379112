// Findings that need more than one file of a cycle.
#include "frontend/gibbs/Check.h"
#include "frontend/gibbs/Walk.h"
#include "support/NearestName.h"
#include "support/WriteInstead.h"

#include <algorithm>
#include <array>

namespace dotek::frontend::gibbs {

namespace {

bool isGeometryName(const std::string& key) {
  return key.size() > 1 && (key[0] == 'P' || key[0] == 'L' || key[0] == 'C') &&
         std::all_of(key.begin() + 1, key.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool hasBrokenFile(const Cycle& cycle) {
  const auto bad = [](const auto& file) { return file && file->hasErrorNodes; };
  const auto anyBad = [](const auto& files) {
    return std::any_of(files.begin(), files.end(), [](const auto* file) { return file->hasErrorNodes; });
  };
  return bad(cycle.defineData) || bad(cycle.dialog) || bad(cycle.cycleData) || bad(cycle.toolPath) ||
         anyBad(cycle.others) || anyBad(cycle.otherDialogs);
}

// Files that are named but were not found may set anything.
bool missesFiles(const Cycle& cycle) {
  bool named = false;
  for (const auto* macro : {&cycle.cycleData, &cycle.toolPath})
    if (*macro)
      walkLines((*macro)->lines, [&](const Statement& statement) {
        named = named || std::holds_alternative<Include>(statement.node) ||
                std::holds_alternative<CallMacro>(statement.node);
      });
  return named && cycle.others.empty();
}

} // namespace

CheckedCycle::CheckedCycle(const Cycle& folder, const SourceMap& files, const stdlib::GibbsKeywords& known)
    : cycle(folder), sources(files), keywords(known), whole(!hasBrokenFile(folder) && !missesFiles(folder)) {
  if (cycle.defineData)
    for (const Definition& definition : cycle.defineData->definitions) {
      define(definition.name);
      fields.insert(foldCase(definition.name.text));
    }
  if (cycle.cycleData) collect(*cycle.cycleData);
  if (cycle.toolPath) collect(*cycle.toolPath);
  for (const Macro* macro : cycle.others)
    collect(*macro);
  if (cycle.dialog) collect(*cycle.dialog);
  for (const Dialog* dialog : cycle.otherDialogs)
    collect(*dialog);
}

void CheckedCycle::define(const Name& name) {
  set.insert(foldCase(name.text));
  spelt.try_emplace(foldCase(name.text), name.text);
}

void CheckedCycle::readAll(const Expression& expression) {
  walkExpression(expression, [&](const Expression& each) {
    if (const auto* reference = std::get_if<VariableRef>(&each.node)) read.push_back(&reference->name);
  });
}

void CheckedCycle::collect(const Dialog& dialog) {
  for (const Control& control : dialog.controls) {
    if (control.initial != nullptr) readAll(*control.initial);
    if (control.condition)
      for (const ExpressionPtr* side : {&control.condition->left, &control.condition->right})
        if (*side != nullptr) readAll(**side);
    if (!control.variable) continue;
    define(*control.variable);
    bound.insert(foldCase(control.variable->text));
  }
}

void CheckedCycle::collect(const Macro& macro) {
  walkLines(macro.lines, [&](const Statement& statement) { collect(statement); });
}

void CheckedCycle::collect(const Statement& statement) {
  if (const auto* assign = std::get_if<Assignment>(&statement.node)) define(assign->target.name);
  if (const auto* loop = std::get_if<For>(&statement.node)) define(loop->variable);
  if (const auto* args = std::get_if<Args>(&statement.node))
    for (const VariableRef& name : args->names)
      define(name.name);
  if (const auto* declared = std::get_if<Declaration>(&statement.node))
    for (const VariableRef& name : declared->names)
      define(name.name);
  if (const auto* command = std::get_if<Command>(&statement.node)) {
    collect(*command);
  } else if (const auto* block = std::get_if<std::unique_ptr<GeometryBlock>>(&statement.node)) {
    for (const Command& element : (*block)->elements)
      collect(element);
  } else {
    ownExpressions(statement, [&](const Expression& expression) { readAll(expression); });
  }
}

void CheckedCycle::collect(const Command& command) {
  std::string key = foldCase(command.name.text);
  if (const auto renamed = keywords.renamedTo(key)) key = foldCase(std::string(*renamed));
  const Match match = matchArguments(keywords.commands(key), command.arguments, keywords, sources);
  for (std::size_t i = 0; i < command.arguments.size(); ++i) {
    const Expression& argument = *command.arguments[i];
    const auto* reference = std::get_if<VariableRef>(&argument.node);
    const stdlib::ArgumentSpec* spec = match.specs[i];
    using Kind = stdlib::ArgumentSpec::Kind;
    // A word of a command that the table is not sure of may be a keyword, a result or a value.
    if (spec == nullptr || match.signature->unsure) {
      if (reference != nullptr)
        define(reference->name);
      else
        readAll(argument);
      continue;
    }
    if (spec->kind == Kind::Choice || spec->kind == Kind::Parameter) continue;
    if (spec->kind == Kind::Result || spec->kind == Kind::ReadWrite || spec->array) {
      if (reference != nullptr) define(reference->name);
      if (reference != nullptr && reference->index != nullptr) readAll(*reference->index);
      continue;
    }
    if (spec->geometry && reference != nullptr && isGeometryName(foldCase(reference->name.text))) continue;
    readAll(argument);
  }
}

void undefinedVariable(const CheckedCycle& input, Report& report) {
  if (!input.whole) return;
  std::set<std::string> reported;
  for (const Name* name : input.read) {
    const std::string key = foldCase(name->text);
    const stdlib::GibbsKeywords& keywords = input.keywords;
    if (input.set.contains(key) || keywords.isSystemVariable(key) || keywords.isConstant(key) ||
        keywords.hasVariablePrefix(key) || keywords.cursor(key) != nullptr ||
        keywords.callback(key) != nullptr)
      continue;
    if (!reported.insert(key).second || report.full(name->range.file)) continue;
    NearestName nearest(key);
    for (const auto& [folded, text] : input.spelt)
      nearest.offer(text);
    nearest.offer(keywords.nearestVariable(key));
    report
        .at(name->range,
            "nothing in this cycle sets `{}`; GibbsCAM takes it for a new global variable, most likely 0{}",
            name->text,
            nearest.result().empty() ? "; set it, or add it to DefineData.txt" : didYouMean(nearest.result()))
        .fix = writeInstead(name->range, nearest.result());
  }
}

namespace {

// Controls of CycleData.dlg that write a variable, where it and DefineData.txt were read whole; of buttons
// the variable is no value.
template <class Visit> void eachInput(const CheckedCycle& input, const Visit& visit) {
  const Cycle& cycle = input.cycle;
  if (!cycle.defineData || cycle.defineData->hasErrorNodes || !cycle.dialog || cycle.dialog->hasErrorNodes)
    return;
  for (const Control& control : cycle.dialog->controls)
    if (control.variable && foldCase(control.kind.text) != "BUTTON")
      visit(control, foldCase(control.variable->text));
}

} // namespace

void inputNotDeclared(const CheckedCycle& input, Report& report) {
  std::set<std::string> reported;
  eachInput(input, [&](const Control& control, const std::string& key) {
    if (input.fields.contains(key) || !reported.insert(key).second || report.full(control.range.file)) return;
    NearestName nearest(key);
    for (const Definition& definition : input.cycle.defineData->definitions)
      nearest.offer(definition.name.text);
    report
        .at(control.variable->range,
            "DefineData.txt does not declare `{}`; the operation does not keep what the user types here, and "
            "the post cannot read it{}",
            control.variable->text,
            nearest.result().empty() ? fmt::format("; add `{} = 0` to DefineData.txt", control.variable->text)
                                     : didYouMean(nearest.result()))
        .fix = writeInstead(control.variable->range, nearest.result());
  });
}

void fieldWithoutInput(const CheckedCycle& input, Report& report) {
  const Cycle& cycle = input.cycle;
  if (!cycle.defineData || cycle.defineData->hasErrorNodes || !cycle.dialog || cycle.dialog->hasErrorNodes)
    return;
  if (!cycle.otherDialogs.empty()) return;
  std::set<std::string> computed;
  const auto collect = [&](const Macro& macro) {
    walkLines(macro.lines, [&](const Statement& statement) {
      if (const auto* assign = std::get_if<Assignment>(&statement.node))
        computed.insert(foldCase(assign->target.name.text));
    });
  };
  if (cycle.cycleData) collect(*cycle.cycleData);
  for (const Macro* other : cycle.others)
    collect(*other);
  for (const Definition& definition : cycle.defineData->definitions)
    if (!input.bound.contains(foldCase(definition.name.text)) &&
        !computed.contains(foldCase(definition.name.text)) &&
        !input.keywords.isReservedField(definition.name.text))
      report.at(
          definition.name.range,
          "no input of the dialog writes the field `{}`, and no macro sets it; it always has its first value",
          definition.name.text);
}

// The default of an input on a field is the field itself, or its first value.
void inputOpensWithOther(const CheckedCycle& input, Report& report) {
  eachInput(input, [&](const Control& control, const std::string& key) {
    if (control.initial == nullptr || !input.fields.contains(key)) return;
    if (const auto* reference = std::get_if<VariableRef>(&control.initial->node)) {
      const std::string other = foldCase(reference->name.text);
      if (reference->index != nullptr || other == key || !input.fields.contains(other)) return;
    } else {
      const std::optional<double> value = plainValue(*control.initial);
      if (!value) return;
      for (const Definition& definition : input.cycle.defineData->definitions)
        if (foldCase(definition.name.text) == key && plainValue(*definition.value) == value) return;
    }
    const SourceRange range = control.initial->range;
    report.at(range,
              "the input of `{0}` opens with `{1}`, and OK stores that; DefineData.txt gives `{0}` another "
              "first value; "
              "write `{0}` as the default, `... , {0}, {0}`",
              control.variable->text, input.sources.textUtf8(range));
  });
}

void dialogFileMissing(const CheckedCycle& input, Report& report) {
  const Cycle& cycle = input.cycle;
  if (!cycle.cycleData || cycle.files.empty()) return;
  walkLines(cycle.cycleData->lines, [&](const Statement& statement) {
    const auto* command = std::get_if<Command>(&statement.node);
    if (command == nullptr || foldCase(command->name.text) != "DIALOG" || command->arguments.empty()) return;
    const auto* file = std::get_if<TextLiteral>(&command->arguments[0]->node);
    // A path leads out of the folder.
    if (file == nullptr || file->text.find_first_of("/\\") != std::string::npos) return;
    if (cycle.files.contains(foldCase(file->text))) return;
    NearestName nearest(file->text);
    for (const std::string& name : cycle.files)
      if (name.ends_with(".DLG")) nearest.offer(name == "CYCLEDATA.DLG" ? "CycleData.dlg" : name);
    const SourceRange range = command->arguments[0]->range;
    report.at(range, "the folder holds no dialog {}; GibbsCAM stops when it reaches this line{}",
              input.sources.textUtf8(range), didYouMean(nearest.result()));
  });
}

std::span<const Check<CheckedCycle>* const> cycleChecks() {
  static constexpr std::array kChecks = {&undefinedVariableCheck, &inputNotDeclaredCheck,
                                         &fieldWithoutInputCheck, &inputOpensWithOtherCheck,
                                         &dialogFileMissingCheck};
  return kChecks;
}

void checkCycle(const Cycle& cycle, const ParseContext& context) {
  runChecks(cycleChecks(), CheckedCycle(cycle, context.sources, context.keywords), context.diagnostics);
}

} // namespace dotek::frontend::gibbs
