#include "lint/MacroNames.h"

#include "frontend/gibbs/Match.h"
#include "frontend/gibbs/Walk.h"

namespace dotek::lint {
namespace {

class Collector {
public:
  explicit Collector(const Project& project) : project_(project) {}

  void statement(const gibbs::Statement& statement) {
    if (const auto* assign = std::get_if<gibbs::Assignment>(&statement.node)) {
      if (assign->target.index) reads(*assign->target.index);
      if (assign->value) reads(*assign->value);
      add(assign->target.name, false, true);
    } else if (const auto* loop = std::get_if<gibbs::For>(&statement.node)) {
      add(loop->variable, true, true);
      gibbs::ownExpressions(statement, [&](const gibbs::Expression& e) { reads(e); });
    } else if (const auto* args = std::get_if<gibbs::Args>(&statement.node)) {
      for (const gibbs::VariableRef& name : args->names)
        add(name.name, true, true);
    } else if (const auto* command = std::get_if<gibbs::Command>(&statement.node)) {
      this->command(*command);
    } else if (const auto* block = std::get_if<std::unique_ptr<gibbs::GeometryBlock>>(&statement.node)) {
      for (const gibbs::Command& element : (*block)->elements)
        this->command(element);
    } else {
      gibbs::ownExpressions(statement, [&](const gibbs::Expression& e) { reads(e); });
    }
  }

  std::vector<NameUse> out;

private:
  void add(const gibbs::Name& name, bool reads, bool writes, bool parameter = false) {
    out.push_back({&name, gibbs::foldCase(name.text), reads, writes, parameter});
  }

  void reads(const gibbs::Expression& expression) {
    gibbs::walkExpression(expression, [&](const gibbs::Expression& each) {
      if (const auto* reference = std::get_if<gibbs::VariableRef>(&each.node))
        add(reference->name, true, false);
    });
  }

  void command(const gibbs::Command& command) {
    std::string key = gibbs::foldCase(command.name.text);
    if (const auto renamed = project_.gibbsKeywords.renamedTo(key))
      key = gibbs::foldCase(std::string(*renamed));
    const gibbs::Match match = gibbs::matchArguments(project_.gibbsKeywords.commands(key), command.arguments,
                                                     project_.gibbsKeywords, project_.sources);
    using Kind = stdlib::ArgumentSpec::Kind;
    for (std::size_t i = 0; i < command.arguments.size(); ++i) {
      const gibbs::Expression& argument = *command.arguments[i];
      const auto* reference = std::get_if<gibbs::VariableRef>(&argument.node);
      const stdlib::ArgumentSpec* spec = i < match.specs.size() ? match.specs[i] : nullptr;
      if (spec == nullptr || match.signature == nullptr || match.signature->unsure) {
        reads(argument);
        if (reference != nullptr) out.back().writes = true;
      } else if (spec->kind == Kind::Choice || spec->kind == Kind::Parameter) {
        if (reference != nullptr) add(reference->name, false, false, true);
      } else if (spec->kind == Kind::Result || spec->kind == Kind::ReadWrite || spec->array) {
        if (reference == nullptr) continue;
        add(reference->name, spec->kind != Kind::Result || spec->array, true);
        if (reference->index != nullptr) reads(*reference->index);
      } else {
        reads(argument);
      }
    }
  }

  const Project& project_;
};

const gibbs::Expression& unwrapped(const gibbs::Expression& expression) {
  const auto* bracketed = std::get_if<gibbs::Bracketed>(&expression.node);
  return bracketed != nullptr ? unwrapped(*bracketed->inner) : expression;
}

} // namespace

std::vector<NameUse> collectNames(const gibbs::Macro& macro, const Project& project) {
  Collector collector(project);
  gibbs::walkLines(macro.lines, [&](const gibbs::Statement& s) { collector.statement(s); });
  return std::move(collector.out);
}

std::set<std::string> readsOf(const gibbs::Expression& expression) {
  std::set<std::string> out;
  gibbs::walkExpression(expression, [&](const gibbs::Expression& each) {
    if (const auto* reference = std::get_if<gibbs::VariableRef>(&each.node))
      out.insert(gibbs::foldCase(reference->name.text));
  });
  return out;
}

std::string squeezed(const gibbs::Expression& expression, const Project& project) {
  std::string out;
  for (const char c : project.sources.text(expression.range))
    if (c != ' ' && c != '\t') out += c;
  return gibbs::foldCase(out);
}

std::vector<const gibbs::Macro*> macrosOf(const gibbs::Cycle& cycle) {
  std::vector<const gibbs::Macro*> out;
  if (cycle.cycleData) out.push_back(&*cycle.cycleData);
  if (cycle.toolPath) out.push_back(&*cycle.toolPath);
  out.insert(out.end(), cycle.others.begin(), cycle.others.end());
  return out;
}

std::set<std::string> fieldsOf(const gibbs::Cycle& cycle) {
  std::set<std::string> out;
  if (cycle.defineData)
    for (const gibbs::Definition& definition : cycle.defineData->definitions)
      out.insert(gibbs::foldCase(definition.name.text));
  if (cycle.dialog)
    for (const gibbs::Control& control : cycle.dialog->controls)
      if (control.variable) out.insert(gibbs::foldCase(control.variable->text));
  return out;
}

std::string printedFor(const Project& project, const std::set<std::string>& declared,
                       const std::string& field) {
  std::string own = gibbs::foldCase(field);
  if (declared.contains(own)) return own;
  for (const auto& [postField, variable] : project.fields)
    if (std::string key = gibbs::foldCase(variable); postField == field && declared.contains(key)) return key;
  return own;
}

std::set<std::string> radiusNames(const gibbs::Macro& macro, const Project& project) {
  std::set<std::string> out;
  eachStatement(macro, [&](const gibbs::Statement& statement) {
    const auto* command = std::get_if<gibbs::Command>(&statement.node);
    if (command == nullptr || gibbs::foldCase(command->name.text) != "GET_TOOL_DATA") return;
    if (command->arguments.size() != 3) return;
    const gibbs::Name* parameter = plainName(*command->arguments[1]);
    const gibbs::Name* result = plainName(*command->arguments[2]);
    if (parameter == nullptr || result == nullptr) return;
    for (const stdlib::CommandSignature* signature : project.gibbsKeywords.commands("GET_TOOL_DATA")) {
      for (const stdlib::ArgumentSpec& spec : signature->arguments) {
        if (spec.kind == stdlib::ArgumentSpec::Kind::Parameter &&
            project.gibbsKeywords.hostInput(spec.family, parameter->text) == "tool_radius")
          out.insert(gibbs::foldCase(result->text));
      }
    }
  });
  return out;
}

std::string commandName(const gibbs::Statement& statement) {
  if (const auto* branch = std::get_if<gibbs::If>(&statement.node))
    return branch->then ? commandName(*branch->then) : "";
  const auto* command = std::get_if<gibbs::Command>(&statement.node);
  return command == nullptr ? "" : gibbs::foldCase(command->name.text);
}

const gibbs::Comparison* onlyComparison(const gibbs::Statement& statement) {
  const auto* branch = std::get_if<gibbs::If>(&statement.node);
  if (branch == nullptr || branch->condition.comparisons.size() != 1) return nullptr;
  const gibbs::Comparison& comparison = branch->condition.comparisons.front();
  return comparison.nots.empty() && comparison.left && comparison.right ? &comparison : nullptr;
}

void eachStatement(const gibbs::Macro& macro, const std::function<void(const gibbs::Statement&)>& visit) {
  gibbs::walkLines(macro.lines, [&](const gibbs::Statement& statement) { visit(statement); });
}

std::optional<double> plainNumber(const gibbs::Expression& expression) {
  const gibbs::Expression& inner = unwrapped(expression);
  if (const auto* number = std::get_if<gibbs::NumberLiteral>(&inner.node)) return number->value;
  const auto* sign = std::get_if<gibbs::Unary>(&inner.node);
  if (sign == nullptr) return std::nullopt;
  const auto value = plainNumber(*sign->operand);
  if (!value) return std::nullopt;
  return sign->op == gibbs::UnaryOperator::Minus ? -*value : *value;
}

const gibbs::Name* plainName(const gibbs::Expression& expression) {
  const auto* reference = std::get_if<gibbs::VariableRef>(&unwrapped(expression).node);
  return reference != nullptr && reference->index == nullptr ? &reference->name : nullptr;
}

const gibbs::Name* absoluteOf(const gibbs::Expression& expression) {
  const auto* call = std::get_if<gibbs::FunctionCall>(&unwrapped(expression).node);
  if (call == nullptr || gibbs::foldCase(call->name.text) != "ABS" || call->arguments.size() != 1)
    return nullptr;
  return plainName(*call->arguments.front());
}

} // namespace dotek::lint
