#include "lint/MacroNames.h"
#include "support/NearestName.h"
#include "support/WriteInstead.h"

namespace dotek::lint::rule {
namespace {

// Macros may add fields for the post that DefineData.txt does not list.
bool addsFields(const gibbs::Cycle& cycle) {
  bool adds = false;
  for (const gibbs::Macro* macro : macrosOf(cycle))
    eachStatement(*macro, [&](const gibbs::Statement& statement) {
      adds = adds || commandName(statement) == "ADD_OP_POST_DATA" ||
             commandName(statement) == "CREATE_OP_POST_DATA";
    });
  return adds;
}

void check(const Project& project, Report& report) {
  for (const Joined& joined : project.joined) {
    const gibbs::Cycle& cycle = *joined.cycle;
    if (!cycle.defineData || cycle.defineData->hasErrorNodes || addsFields(cycle)) continue;
    const std::set<std::string> fields = fieldsOf(cycle);
    std::set<std::string> told;
    for (const compost::BranchRef& branch : compost::branchesOf(*joined.prog, cycle.name)) {
      for (const compost::FieldRef& field : compost::fieldsPrinted(*joined.prog, branch, cycle.name)) {
        const std::string key = printedFor(project, fields, field.name);
        if (fields.contains(key) || project.sets.contains(field.name) || !told.insert(key).second) continue;
        NearestName nearest(field.name);
        for (const gibbs::Definition& definition : cycle.defineData->definitions)
          nearest.offer(definition.name.text);
        const std::string meant = nearest.result();
        Diagnostic& found = report.at(
            field.range,
            "the cycle `{}` declares no field `{}`; the post prints 0 or nothing, and the probe does not "
            "go where the user said{}",
            cycle.name, field.name, meant.empty() ? "" : "; did you mean `" + meant + "`?");
        if (!meant.empty()) found.fix = writeInstead(field.range, "'" + meant + "'");
        found.note({cycle.defineData->file, 0, 0}, "the fields of the cycle are declared here");
      }
    }
  }
}

} // namespace

DOTEK_LINT_RULE(field_not_defined){
    .severity = Severity::Error,
    .tier = Tier::Bundle,
    .check = check,
};

} // namespace dotek::lint::rule
