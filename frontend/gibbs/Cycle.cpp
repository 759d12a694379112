#include "frontend/gibbs/Cycle.h"

#include "frontend/gibbs/Match.h"
#include "frontend/gibbs/Walk.h"
#include "support/NearestName.h"
#include "support/messages/Gibbs.h"

#include <algorithm>
#include <functional>
#include <map>

namespace dotek::frontend::gibbs {

namespace {

bool isGeometryName(const std::string& key) {
  return key.size() > 1 && (key[0] == 'P' || key[0] == 'L' || key[0] == 'C') &&
         std::all_of(key.begin() + 1, key.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// Names that the files of a cycle set and read.
class Names {
public:
  explicit Names(const ParseContext& context) : context_(context) {}

  std::set<std::string> set;                // folded
  std::vector<const Name*> read;            // in the order of the text
  std::map<std::string, std::string> spelt; // folded name to a spelling, for proposals

  void define(const Name& name) {
    set.insert(foldCase(name.text));
    spelt.try_emplace(foldCase(name.text), name.text);
  }

  void collect(const Macro& macro, bool reads) {
    walkLines(macro.lines, [&](const Statement& statement) { collect(statement, reads); });
  }

  void readAll(const Expression& expression) {
    walkExpression(expression, [&](const Expression& each) {
      if (const auto* reference = std::get_if<VariableRef>(&each.node)) read.push_back(&reference->name);
    });
  }

private:
  void collect(const Statement& statement, bool reads) {
    if (const auto* assign = std::get_if<Assignment>(&statement.node)) define(assign->target.name);
    if (const auto* loop = std::get_if<For>(&statement.node)) define(loop->variable);
    if (const auto* args = std::get_if<Args>(&statement.node))
      for (const VariableRef& name : args->names)
        define(name.name);
    if (const auto* declared = std::get_if<Declaration>(&statement.node))
      for (const VariableRef& name : declared->names)
        define(name.name);
    if (const auto* command = std::get_if<Command>(&statement.node)) {
      collect(*command, reads);
    } else if (const auto* block = std::get_if<std::unique_ptr<GeometryBlock>>(&statement.node)) {
      for (const Command& element : (*block)->elements)
        collect(element, reads);
    } else if (reads) {
      ownExpressions(statement, [&](const Expression& expression) { readAll(expression); });
    }
  }

  void collect(const Command& command, bool reads) {
    std::string key = foldCase(command.name.text);
    if (const auto renamed = context_.keywords.renamedTo(key)) key = foldCase(std::string(*renamed));
    const Match match = matchArguments(context_.keywords.commands(key), command.arguments, context_.keywords,
                                       context_.sources);
    for (std::size_t i = 0; i < command.arguments.size(); ++i) {
      const Expression& argument = *command.arguments[i];
      const auto* reference = std::get_if<VariableRef>(&argument.node);
      const stdlib::ArgumentSpec* spec = match.specs[i];
      using Kind = stdlib::ArgumentSpec::Kind;
      // A word of a command that the table is not sure of may be a keyword, a result or a value.
      if (spec == nullptr || match.signature->unsure) {
        if (reference != nullptr)
          define(reference->name);
        else if (reads)
          readAll(argument);
        continue;
      }
      if (spec->kind == Kind::Choice || spec->kind == Kind::Parameter) continue;
      if (spec->kind == Kind::Result || spec->kind == Kind::ReadWrite || spec->array) {
        if (reference != nullptr) define(reference->name);
        if (reads && reference != nullptr && reference->index != nullptr) readAll(*reference->index);
        continue;
      }
      if (spec->geometry && reference != nullptr && isGeometryName(foldCase(reference->name.text))) continue;
      if (reads) readAll(argument);
    }
  }

  const ParseContext& context_;
};

// The literal of a plain number, with at most one sign before it; nullptr for anything else.
const NumberLiteral* plainNumber(const Expression& expression) {
  const auto* unary = std::get_if<Unary>(&expression.node);
  return std::get_if<NumberLiteral>(unary != nullptr ? &unary->operand->node : &expression.node);
}

std::optional<double> constant(const Expression& expression) {
  const NumberLiteral* number = plainNumber(expression);
  if (number == nullptr) return std::nullopt;
  const auto* unary = std::get_if<Unary>(&expression.node);
  const bool minus = unary != nullptr && unary->op == UnaryOperator::Minus;
  return minus && number->value != 0 ? -number->value : number->value;
}

class CycleCheck {
public:
  CycleCheck(const Cycle& cycle, const ParseContext& context)
      : cycle_(cycle), context_(context), names_(context) {}

  void run() {
    collect();
    checkReads();
    checkFields();
    checkDialogs();
  }

private:
  bool broken() const {
    const auto bad = [](const auto& file) { return file && file->hasErrorNodes; };
    const auto anyBad = [](const auto& files) {
      return std::any_of(files.begin(), files.end(), [](const auto* file) { return file->hasErrorNodes; });
    };
    return bad(cycle_.defineData) || bad(cycle_.dialog) || bad(cycle_.cycleData) || bad(cycle_.toolPath) ||
           anyBad(cycle_.others) || anyBad(cycle_.otherDialogs);
  }

  void collect() {
    if (cycle_.defineData)
      for (const Definition& definition : cycle_.defineData->definitions) {
        names_.define(definition.name);
        fields_.insert(foldCase(definition.name.text));
      }
    for (const Macro* macro :
         {cycle_.cycleData ? &*cycle_.cycleData : nullptr, cycle_.toolPath ? &*cycle_.toolPath : nullptr})
      if (macro != nullptr) names_.collect(*macro, true);
    for (const Macro* macro : cycle_.others)
      names_.collect(*macro, true);
    if (cycle_.dialog) collect(*cycle_.dialog);
    for (const Dialog* dialog : cycle_.otherDialogs)
      collect(*dialog);
  }

  void collect(const Dialog& dialog) {
    for (const Control& control : dialog.controls) {
      if (!control.variable) continue;
      names_.define(*control.variable);
      bound_.insert(foldCase(control.variable->text));
    }
  }

  // Files that are named but were not found may set anything.
  bool incomplete() const {
    std::size_t named = 0;
    const auto count = [&](const Macro& macro) {
      walkLines(macro.lines, [&](const Statement& statement) {
        if (std::holds_alternative<Include>(statement.node) ||
            std::holds_alternative<CallMacro>(statement.node))
          ++named;
      });
    };
    if (cycle_.cycleData) count(*cycle_.cycleData);
    if (cycle_.toolPath) count(*cycle_.toolPath);
    return named > 0 && cycle_.others.empty();
  }

  void checkReads() {
    if (broken() || incomplete()) return;
    std::set<std::string> reported;
    for (const Name* name : names_.read) {
      const std::string key = foldCase(name->text);
      if (names_.set.count(key) != 0 || context_.keywords.isSystemVariable(key) ||
          context_.keywords.isConstant(key) || context_.keywords.hasVariablePrefix(key) ||
          context_.keywords.cursor(key) != nullptr || context_.keywords.callback(key) != nullptr)
        continue;
      if (!reported.insert(key).second) continue;
      if (context_.diagnostics.full(diag::UndefinedVariable::code, name->range.file)) continue;
      NearestName nearest(key);
      for (const auto& [folded, text] : names_.spelt)
        nearest.offer(text);
      nearest.offer(context_.keywords.nearestVariable(key));
      const std::string remedy = nearest.result().empty()
                                     ? "; set it, or add it to DefineData.txt"
                                     : fmt::format("; did you mean `{}`?", nearest.result());
      context_.diagnostics.report<diag::UndefinedVariable>(name->range, name->text, remedy);
    }
  }

  void checkFields() {
    if (!cycle_.defineData || cycle_.defineData->hasErrorNodes) return;
    if (cycle_.dialog && !cycle_.dialog->hasErrorNodes) {
      std::set<std::string> reported;
      for (const Control& control : cycle_.dialog->controls) {
        if (!control.variable || foldCase(control.kind.text) == "BUTTON") continue;
        const std::string key = foldCase(control.variable->text);
        if (fields_.count(key) != 0) checkInitial(control);
        if (fields_.count(key) != 0 || !reported.insert(key).second) continue;
        if (context_.diagnostics.full(diag::InputNotDeclared::code, control.range.file)) break;
        NearestName nearest(key);
        for (const Definition& definition : cycle_.defineData->definitions)
          nearest.offer(definition.name.text);
        const std::string remedy =
            nearest.result().empty() ? fmt::format("; add `{} = 0` to DefineData.txt", control.variable->text)
                                     : fmt::format("; did you mean `{}`?", nearest.result());
        context_.diagnostics.report<diag::InputNotDeclared>(control.variable->range, control.variable->text,
                                                            remedy);
      }
      if (cycle_.otherDialogs.empty())
        for (const Definition& definition : cycle_.defineData->definitions)
          if (bound_.count(foldCase(definition.name.text)) == 0 &&
              !context_.keywords.isReservedField(definition.name.text))
            context_.diagnostics.report<diag::FieldWithoutInput>(definition.name.range, definition.name.text);
    }
  }

  // The default of an input on a field: the field itself, or its first value.
  void checkInitial(const Control& control) {
    if (control.initial == nullptr) return;
    const std::string key = foldCase(control.variable->text);
    if (const auto* reference = std::get_if<VariableRef>(&control.initial->node)) {
      const std::string other = foldCase(reference->name.text);
      if (reference->index != nullptr || other == key || fields_.count(other) == 0) return;
    } else {
      const std::optional<double> value = constant(*control.initial);
      if (!value) return;
      for (const Definition& definition : cycle_.defineData->definitions)
        if (foldCase(definition.name.text) == key && constant(*definition.value) == value) return;
    }
    context_.diagnostics.report<diag::InputOpensWithOther>(
        control.initial->range, control.variable->text,
        "`" + context_.sources.textUtf8(control.initial->range) + "`");
  }

  void checkDialogs() {
    if (!cycle_.cycleData) return;
    walkLines(cycle_.cycleData->lines, [&](const Statement& statement) {
      const auto* command = std::get_if<Command>(&statement.node);
      if (command == nullptr || foldCase(command->name.text) != "DIALOG" || command->arguments.empty())
        return;
      const auto* file = std::get_if<TextLiteral>(&command->arguments[0]->node);
      if (file == nullptr || cycle_.files.empty()) return;
      // A path leads out of the folder.
      if (file->text.find_first_of("/\\") != std::string::npos) return;
      if (cycle_.files.count(foldCase(file->text)) == 0) {
        NearestName nearest(file->text);
        for (const std::string& name : cycle_.files)
          if (name.ends_with(".DLG")) nearest.offer(name == "CYCLEDATA.DLG" ? "CycleData.dlg" : name);
        const std::string remedy =
            nearest.result().empty() ? std::string() : fmt::format("; did you mean `{}`?", nearest.result());
        context_.diagnostics.report<diag::DialogFileMissing>(
            command->arguments[0]->range, context_.sources.textUtf8(command->arguments[0]->range), remedy);
      }
    });
  }

  const Cycle& cycle_;
  const ParseContext& context_;
  Names names_;
  std::set<std::string> fields_;
  std::set<std::string> bound_;
};

std::string_view assumptionOf(const Expression& expression) {
  const NumberLiteral* number = plainNumber(expression);
  if (number == nullptr || number->text.empty()) return {};
  if (number->text.find_first_of("eE") != std::string::npos) return "exponent";
  return number->text.front() == '.' || number->text.back() == '.' ? "bare-fraction" : std::string_view{};
}

} // namespace

void checkCycle(const Cycle& cycle, const ParseContext& context) {
  CycleCheck(cycle, context).run();
}

std::vector<Field> declaredFields(const Cycle& cycle) {
  std::vector<Field> fields;
  std::map<std::string, std::size_t> index;
  const std::vector<InputLabel> labels =
      cycle.dialog ? inputLabels(*cycle.dialog) : std::vector<InputLabel>{};
  const auto add = [&](Field field) {
    const std::string key = foldCase(field.name.text);
    if (!index.try_emplace(key, fields.size()).second) return;
    for (const InputLabel& label : labels)
      if (!field.label && foldCase(label.variable.text) == key) field.label = label;
    fields.push_back(std::move(field));
  };
  if (cycle.defineData)
    for (const Definition& definition : cycle.defineData->definitions)
      add({definition.name, constant(*definition.value), definition.valueRange, false, std::nullopt,
           assumptionOf(*definition.value)});
  for (const InputLabel& label : labels) {
    const Expression* initial = label.input->initial;
    const std::optional<double> value = initial == nullptr ? std::nullopt : constant(*initial);
    add({label.variable, value, initial == nullptr ? label.variable.range : initial->range, true,
         std::nullopt, initial == nullptr ? std::string_view() : assumptionOf(*initial)});
  }
  return fields;
}

} // namespace dotek::frontend::gibbs
