#include "lint/CalledFiles.h"
#include "lint/MacroNames.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace dotek::lint::rule {
namespace {

struct Numbers {
  std::map<double, SourceRange> set, compared;
  std::size_t times = 0; // that it is set or compared
  bool other = false;    // set or compared differently

  void sets(double value, SourceRange range) {
    set.emplace(value, range);
    ++times;
  }
  void compares(double value, SourceRange range) {
    compared.emplace(value, range);
    ++times;
  }
};

// What one macro that is called does to the variables of the one that calls it.
struct Callee {
  std::map<std::string, std::size_t> parameters; // folded names after ARGS, by place
  // Variables that it gives numbers to: its own, and those that come as an argument.
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, std::vector<std::size_t>> given;
  std::set<std::string> other; // that it writes differently
};

Callee calleeOf(const gibbs::Macro& macro, const Project& project) {
  Callee out;
  std::map<std::string, std::size_t> known, writes; // writes that are read here, and all
  eachStatement(macro, [&](const gibbs::Statement& statement) {
    if (const auto* takes = std::get_if<gibbs::Args>(&statement.node))
      for (std::size_t i = 0; i < takes->names.size(); ++i)
        out.parameters.emplace(gibbs::foldCase(takes->names[i].name.text), i);
    const auto* assign = std::get_if<gibbs::Assignment>(&statement.node);
    if (assign == nullptr || !assign->value || assign->target.index) return;
    const std::string name = gibbs::foldCase(assign->target.name.text);
    const gibbs::Name* from = plainName(*assign->value);
    const auto parameter =
        from != nullptr ? out.parameters.find(gibbs::foldCase(from->text)) : out.parameters.end();
    if (const auto number = plainNumber(*assign->value))
      out.numbers[name].push_back(*number);
    else if (parameter != out.parameters.end())
      out.given[name].push_back(parameter->second);
    else
      return;
    ++known[name];
  });
  for (const NameUse& use : namesOf(macro, project))
    if (use.writes && !out.parameters.contains(use.key)) ++writes[use.key];
  for (const auto& [name, times] : writes)
    if (times > known[name]) out.other.insert(name);
  // An argument that becomes another.
  if (std::any_of(known.begin(), known.end(),
                  [&](const auto& one) { return out.parameters.contains(one.first); }))
    for (const auto& [name, places] : out.given)
      out.other.insert(name);
  return out;
}

const gibbs::Macro* macroOf(const gibbs::CallMacro& call, const gibbs::Macro& caller,
                            const Project& project) {
  for (const gibbs::Cycle* cycle : project.cycles) {
    const std::vector<const gibbs::Macro*> macros = macrosOf(*cycle);
    if (std::find(macros.begin(), macros.end(), &caller) != macros.end())
      return calledMacro(*cycle, call, project);
  }
  return nullptr;
}

// The variable is declared GLOBAL here, or the macro calls others: what is not declared is global there, too.
bool shares(const gibbs::Macro& macro, const std::string& name) {
  bool out = false;
  eachStatement(macro, [&](const gibbs::Statement& statement) {
    out = out || std::holds_alternative<gibbs::CallMacro>(statement.node) ||
          std::holds_alternative<gibbs::Include>(statement.node);
    if (const auto* declared = std::get_if<gibbs::Declaration>(&statement.node))
      for (const gibbs::VariableRef& one : declared->names)
        out = out || gibbs::foldCase(one.name.text) == name;
  });
  return out;
}

void check(const Project& project, Report& report) {
  std::set<std::string> fields; // their values come from the user
  for (const gibbs::Cycle* cycle : project.cycles)
    fields.merge(fieldsOf(*cycle));
  const std::vector<const gibbs::Macro*> macros = project.allMacros();
  std::map<std::string, std::set<const gibbs::Macro*>> writers;
  for (const gibbs::Macro* macro : macros)
    for (const NameUse& use : namesOf(*macro, project))
      if (use.writes) writers[use.key].insert(macro);
  for (const gibbs::Macro* macro : macros) {
    if (macro->hasErrorNodes) continue;
    std::map<std::string, Numbers> all;
    std::set<const gibbs::Macro*> read = {macro}; // and those that it calls
    eachStatement(*macro, [&](const gibbs::Statement& statement) {
      if (const auto* assign = std::get_if<gibbs::Assignment>(&statement.node)) {
        Numbers& numbers = all[gibbs::foldCase(assign->target.name.text)];
        const auto value = assign->value ? plainNumber(*assign->value) : std::nullopt;
        if (value)
          numbers.sets(*value, statement.range);
        else
          numbers.other = true;
      } else if (const auto* call = std::get_if<gibbs::CallMacro>(&statement.node)) {
        const gibbs::Macro* called = macroOf(*call, *macro, project);
        if (called == nullptr || called->hasErrorNodes) return;
        const Callee callee = calleeOf(*called, project);
        read.insert(called);
        for (const auto& [name, values] : callee.numbers)
          for (const double value : values)
            all[name].sets(value, statement.range);
        for (const auto& [name, places] : callee.given)
          for (const std::size_t i : places)
            if (const auto value = i < call->arguments.size() && call->arguments[i]
                                       ? plainNumber(*call->arguments[i])
                                       : std::nullopt)
              all[name].sets(*value, statement.range);
            else
              all[name].other = true;
        for (const std::string& name : callee.other)
          all[name].other = true;
      } else if (const gibbs::Comparison* comparison = onlyComparison(statement)) {
        const gibbs::Name* name = plainName(*comparison->left);
        const auto value = plainNumber(*comparison->right);
        if (name == nullptr || !value) return;
        Numbers& numbers = all[gibbs::foldCase(name->text)];
        if (comparison->relation == gibbs::Relation::Equal)
          numbers.compares(*value, comparison->range);
        else if (const auto& branch = std::get<gibbs::If>(statement.node);
                 *value != 0 || (branch.then && commandName(*branch.then) == "MESSAGE"))
          numbers.other = true; // one message for several numbers
      }
    });
    for (const auto& [name, numbers] : all) {
      // What another macro sets, or sees of this one, is not seen here.
      const auto written = writers.find(name);
      const bool elsewhere = written != writers.end() &&
                             std::any_of(written->second.begin(), written->second.end(),
                                         [&](const gibbs::Macro* one) { return !read.contains(one); });
      if (elsewhere && shares(*macro, name)) continue;
      const auto isError = [](const auto& one) { return one.first != 0; };
      const bool codes = std::count_if(numbers.set.begin(), numbers.set.end(), isError) > 0 &&
                         std::count_if(numbers.compared.begin(), numbers.compared.end(), isError) > 0;
      if (numbers.other || fields.contains(name) || !codes || numbers.times < 4) continue;
      for (const auto& [value, range] : numbers.compared)
        if (value != 0 && !numbers.set.contains(value))
          report.at(range,
                    "nothing gives `{}` the value {}, so this never holds; a check that was meant to is "
                    "missing, or "
                    "has another number",
                    name, value);
      for (const auto& [value, range] : numbers.set)
        if (value != 0 && !numbers.compared.contains(value))
          report.at(range,
                    "nothing looks for the value {}, as for the others; what this check finds is not "
                    "reported; write "
                    "the message, or the number that is meant",
                    value);
    }
  }
}

} // namespace

DOTEK_LINT_RULE(error_number_unmatched){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
