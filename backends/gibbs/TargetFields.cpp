#include "backends/gibbs/TargetFields.h"

#include "ir/CycleNames.h"
#include "ir/Evaluate.h"
#include "ir/Fold.h"
#include "ir/Positions.h"
#include "ir/Walk.h"
#include "project/CycleCatalogue.h"
#include "project/CycleFiles.h"
#include "stdlib/HostInputs.h"
#include "support/Decimal.h"
#include "support/messages/CamFolder.h"
#include "targets/DialogChoices.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace dotek::targets {

namespace gibbs = backends::gibbs;

namespace {

constexpr std::uint32_t kMaxSteps = 10000;
constexpr double kFirstSystem = 54, kLastSystem = 59;

// Where the statements of a cycle name each variable.
struct Mentions {
  explicit Mentions(const ir::Cycle& cycle)
      : readInBody(cycle.variables.size()), assignedInChecks(readInBody), used(readInBody),
        checks(cycle.variables.size()) {
    for (const auto* list : {&cycle.checks, &cycle.body})
      for (std::size_t i = 0; i < list->size(); ++i) {
        if (const auto* assign = std::get_if<ir::Assign>(&(*list)[i].node)) {
          used[assign->variable] = true;
          if (list == &cycle.checks) assignedInChecks[assign->variable] = true;
        }
        ir::eachNode((*list)[i], [&](const ir::Expression& node) {
          const auto* use = std::get_if<ir::VariableUse>(&node.node);
          if (use == nullptr) return;
          used[use->variable] = true;
          if (list == &cycle.body)
            readInBody[use->variable] = true;
          else if (auto& at = checks[use->variable]; at.empty() || at.back() != i)
            at.push_back(i);
        });
      }
  }
  std::vector<bool> readInBody, assignedInChecks, used;
  std::vector<std::vector<std::size_t>> checks; // that read it
};

// The checks let this value pass, whatever the others are.
bool passes(const ir::Cycle& cycle, ir::VariableId id, double value) {
  ir::Environment environment(cycle.variables.size());
  environment[id] = ir::Scalar::of(value);
  for (ir::VariableId other = 0; other < environment.size(); ++other)
    if (other != id && cycle.variable(other).defaultValue)
      environment[other] = ir::Scalar::of(*cycle.variable(other).defaultValue);
  return ir::runChecks(cycle, environment, kMaxSteps).end != ir::CheckRun::End::Alarm;
}

void addCheck(ir::Cycle& cycle, const ir::ConditionPtr& fine, const std::string& message, SourceRange range) {
  const ir::LabelId label = cycle.addLabel({"system_fine", {}});
  ir::Origin origin;
  if (range.hasPlace()) origin.ranges.push_back(range);
  origin.reason = "range of the work system";
  cycle.checks.push_back({ir::Branch{fine, label}, origin});
  cycle.checks.push_back({ir::Alarm{message}, origin});
  cycle.checks.push_back({ir::Label{label}, origin});
}

// 1 where the body counts the systems from 1, as `system + 53`; else 54.
double firstSystem(const ir::Cycle& cycle, ir::VariableId id) {
  bool counted = false;
  for (const ir::CycleStatement& statement : cycle.body)
    ir::eachNode(statement, [&](const ir::Expression& node) {
      const auto* sum = std::get_if<ir::Binary>(&node.node);
      if (sum == nullptr || sum->op != ir::BinaryOp::Add) return;
      const auto* use = std::get_if<ir::VariableUse>(&sum->left->node);
      const double* shift = ir::constantValue(sum->right);
      counted = counted ||
                (use != nullptr && use->variable == id && shift != nullptr && *shift == kFirstSystem - 1);
    });
  return counted ? 1 : kFirstSystem;
}

// What the control would refuse with an alarm is refused in the dialog. A list offers nothing else. `others`:
// the branch calls the macros of the source, which take what its list offers besides (G54.1 Pn).
void confineSystem(ir::Cycle& cycle, const gibbs::Field& field, bool others) {
  constexpr double kBeside[] = {-55, -54, -53, -1, -0.5, 0.5, 5.5, 6, 100}; // from the first one
  const ir::VariableId id = field.variable;
  const double first = firstSystem(cycle, id), last = first + kLastSystem - kFirstSystem;
  const auto isSystem = [&](const gibbs::Choice& one) {
    return one.value >= first && one.value <= last && one.value == std::trunc(one.value);
  };
  if (!field.choices.empty() && std::all_of(field.choices.begin(), field.choices.end(), isSystem)) return;
  if (std::none_of(std::begin(kBeside), std::end(kBeside),
                   [&](double beside) { return passes(cycle, id, first + beside); }))
    return;
  const ir::Variable& variable = cycle.variable(id);
  const ir::ExpressionPtr value = ir::variable(id);
  ir::ConditionPtr offered; // besides; nullptr: nothing is
  std::string names;
  for (const gibbs::Choice& one : field.choices) {
    if (!others || isSystem(one)) continue;
    const ir::ConditionPtr is = ir::compare(ir::Relation::Equal, value, ir::constant(one.value));
    offered = offered == nullptr ? is : ir::join(ir::Connective::Or, offered, is);
    names += fmt::format(" or {}", numberText(one.value));
  }
  const auto demand = [&](const ir::ConditionPtr& fine, const std::string& message, SourceRange range) {
    addCheck(cycle, offered == nullptr ? fine : ir::join(ir::Connective::Or, fine, offered), message + names,
             range);
  };
  const std::string message =
      first == 1 ? fmt::format("The work offset {} is 1, 2, 3, 4, 5 or 6", variable.name)
                 : fmt::format("The work offset {} is 54, 55, 56, 57, 58 or 59", variable.name);
  const SourceRange range = variable.range;
  demand(ir::compare(ir::Relation::GreaterEqual, value, ir::constant(first)), message, range);
  demand(ir::compare(ir::Relation::LessEqual, value, ir::constant(last)), message, range);
  demand(ir::compare(ir::Relation::Equal, ir::unary(ir::UnaryOp::Truncate, value), value), message, range);
}

ir::ConditionPtr alwaysGiven(const ir::ConditionPtr& condition, const ir::Cycle& cycle) {
  if (const auto* null = std::get_if<ir::IsNull>(&condition->node)) {
    const auto* use = std::get_if<ir::VariableUse>(&null->value->node);
    const bool given = use != nullptr && cycle.variable(use->variable).role == ir::Role::Parameter &&
                       !cycle.variable(use->variable).optional;
    return given ? ir::truth(false) : condition;
  }
  if (const auto* inner = std::get_if<ir::Not>(&condition->node))
    return ir::negate(alwaysGiven(inner->inner, cycle));
  if (const auto* both = std::get_if<ir::Junction>(&condition->node))
    return ir::join(both->op, alwaysGiven(both->left, cycle), alwaysGiven(both->right, cycle),
                    condition->range);
  return condition;
}

struct Reads {
  bool it = false, others = false;
};
Reads readsOf(const ir::CycleStatement& statement, ir::VariableId id) {
  Reads out;
  ir::eachNode(statement, [&](const ir::Expression& node) {
    const auto* use = std::get_if<ir::VariableUse>(&node.node);
    if (use != nullptr) (use->variable == id ? out.it : out.others) = true;
  });
  return out;
}

// The statement is a branch that looks at the variable alone, and leads forward past nothing but alarms and
// further branches that look at it: what it finds decides of an alarm, and of nothing else.
bool decidesAlarms(const std::vector<ir::CycleStatement>& list, std::size_t at, ir::VariableId id) {
  const auto looks = [&](const ir::CycleStatement& one) {
    return std::holds_alternative<ir::Branch>(one.node) && readsOf(one, id).it;
  };
  const auto* branch = std::get_if<ir::Branch>(&list[at].node);
  if (branch == nullptr || readsOf(list[at], id).others) return false;
  for (std::size_t i = at + 1; i < list.size(); ++i) {
    const ir::CycleStatement& one = list[i];
    const std::optional<bool> ends = ir::match(
        one,
        [&](const ir::Label& node) {
          return node.label == branch->target ? std::optional(true) : std::nullopt;
        },
        [](const ir::OneOf<ir::Alarm, ir::Comment> auto&) { return std::optional<bool>(); },
        [&](const ir::Branch&) { return looks(one) ? std::optional<bool>() : false; },
        [](const ir::OneOf<ir::Assign, ir::Store, ir::Jump, ir::Return, ir::Move, ir::Measure, ir::CallCycle,
                           ir::ProbePower, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell, ir::Stop,
                           ir::OpaqueBlock, ir::Port, ir::Print> auto&) { return std::optional(false); });
    if (ends) return *ends;
  }
  return false;
}

// The body does not read it, and the checks compare it with constants and stop, no more.
bool onlyItsRange(const ir::Cycle& cycle, const Mentions& mentions, ir::VariableId id) {
  if (mentions.readInBody[id] || mentions.assignedInChecks[id]) return false;
  const std::vector<std::size_t>& checks = mentions.checks[id];
  return std::all_of(checks.begin(), checks.end(), [&](std::size_t i) {
    return !readsOf(cycle.checks[i], id).it || decidesAlarms(cycle.checks, i, id);
  });
}

// What the source says of a field beside what is in the IR.
void describe(gibbs::Field& field, const CyclePage::Row& row) {
  field.meaning = row.meaning;
  field.group = row.group;
  for (DialogChoice& one : choicesOfType(row.kind))
    field.choices.push_back({one.value, std::move(one.title)});
}

bool isStart(std::string_view name) {
  return name == "start_x" || name == "start_y" || name == "start_z";
}

} // namespace

std::set<ir::VariableId> leaveOut(LoweredCycle& lowered, Diagnostics& diagnostics) {
  ir::Cycle& cycle = lowered.cycle;
  std::set<ir::VariableId> out;
  std::vector<ir::CycleStatement> absent;
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id) {
    ir::Variable& variable = cycle.variables[id];
    if (variable.role != ir::Role::Parameter || !variable.optional || lowered.fixed.contains(id)) continue;
    variable.optional = variable.optional && !variable.defaultValue;
    if (!variable.optional || !ir::uses(cycle, id)) continue;
    out.insert(id);
    absent.push_back({ir::Assign{id, ir::nullValue()}, {}});
    diagnostics.report<diag::CamNotAsked>(variable.range, variable.name, variable.name);
  }
  cycle.checks.insert(cycle.checks.begin(), absent.begin(), absent.end());
  // What has a default is given always.
  for (auto* list : {&cycle.checks, &cycle.body})
    for (ir::CycleStatement& statement : *list)
      if (ir::ConditionPtr* condition = ir::conditionOf(statement))
        *condition = alwaysGiven(*condition, cycle);
  return out;
}

void dropAbsences(LoweredCycle& lowered) {
  ir::Cycle& cycle = lowered.cycle;
  const auto assigned = [&](ir::VariableId id) {
    return std::count_if(cycle.checks.begin(), cycle.checks.end(), [&](const ir::CycleStatement& one) {
      const auto* node = std::get_if<ir::Assign>(&one.node);
      return node != nullptr && node->variable == id;
    });
  };
  std::erase_if(cycle.checks, [&](const ir::CycleStatement& one) {
    const auto* node = std::get_if<ir::Assign>(&one.node);
    return node != nullptr && std::holds_alternative<ir::NullValue>(node->value->node) &&
           assigned(node->variable) > 1;
  });
}

void fixUnused(LoweredCycle& lowered, bool keepChecked, const ir::FoldOptions& folding,
               Diagnostics& diagnostics) {
  ir::Cycle& cycle = lowered.cycle;
  const Mentions mentions(cycle);
  std::map<ir::VariableId, double> fixed;
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id) {
    const ir::Variable& variable = cycle.variable(id);
    if (variable.role != ir::Role::Parameter || lowered.fixed.contains(id) || variable.optional) continue;
    if (mentions.used[id] && (keepChecked || !onlyItsRange(cycle, mentions, id))) continue;
    diagnostics.report<diag::CamUnused>(variable.range, variable.name);
    if (variable.defaultValue && mentions.used[id]) fixed.emplace(id, *variable.defaultValue);
  }
  if (fixed.empty()) return;
  lowered.fixed.insert(fixed.begin(), fixed.end());
  ir::fold(cycle, fixed, folding);
}

gibbs::Folder folderOf(const CycleFolder& folder, LoweredCycle& lowered,
                       const std::set<ir::VariableId>& without, gibbs::Names& names, const std::string* file,
                       bool sameMacros, Session& session) {
  ir::Cycle& cycle = lowered.cycle;
  Diagnostics& diagnostics = session.diagnostics();
  gibbs::Folder out;
  out.title = cycle.title;
  std::map<std::string, CyclePage::Row> rows;
  if (file != nullptr) {
    CycleFiles files(session);
    if (const auto* tree = files.linked(*file)) {
      const CyclePage page = cyclePage(*tree);
      out.description = page.description.substr(0, page.description.find('\n'));
      for (const CyclePage::Row& row : page.parameters)
        rows.emplace(row.name, row);
    }
  }
  const auto choices = dialogChoices(folder, cycle, session.sources());
  const Mentions mentions(cycle);
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id) {
    const ir::Variable& variable = cycle.variable(id);
    const bool computed = mentions.assignedInChecks[id] || variable.name == "tool_radius";
    const bool kept = computed && mentions.readInBody[id];
    const bool asked = variable.role == ir::Role::Parameter && !without.contains(id);
    if (!mentions.used[id] || (!asked && !kept)) continue;
    const bool host = variable.role == ir::Role::Host;
    gibbs::Field field{id,
                       host ? names.fresh(variable.name) : names.of(id),
                       variable.defaultValue.value_or(0),
                       asked,
                       variable.unit,
                       variable.meaning,
                       "",
                       {}};
    if (asked && !variable.defaultValue)
      diagnostics.report<diag::CamDefaultMissing>(variable.range, variable.name, variable.name);
    if (field.unit.empty()) field.unit = std::string(ir::kindUnit(variable.kind));
    if (const auto row = rows.find(variable.name); row != rows.end()) describe(field, row->second);
    if (const auto found = choices.find(id); found != choices.end())
      for (const DialogChoice& one : found->second)
        field.choices.push_back({one.value, one.title});
    out.fields.push_back(std::move(field));
  }
  for (const gibbs::Field& field : out.fields)
    if (field.asked && cycle.variable(field.variable).kind == ir::Kind::WorkOffset &&
        mentions.readInBody[field.variable])
      confineSystem(cycle, field, sameMacros);
  return out;
}

void checkHosts(const ir::Cycle& cycle, Diagnostics& diagnostics) {
  const Mentions mentions(cycle);
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id) {
    const ir::Variable& variable = cycle.variable(id);
    if (variable.role != ir::Role::Host) continue;
    const bool inBody = mentions.readInBody[id], inChecks = !mentions.checks[id].empty();
    if (!inBody && !inChecks) continue;
    if (variable.name == "tool_radius") continue;
    if (!inChecks && (isStart(variable.name) || variable.name == "clearance")) continue;
    const auto* info = std::find_if(std::begin(stdlib::kHostInputs), std::end(stdlib::kHostInputs),
                                    [&](const auto& one) { return one.name == variable.name; });
    diagnostics.report<diag::CamHostUnknown>(cycle.range, variable.name,
                                             info == std::end(stdlib::kHostInputs) ? "" : info->meaning,
                                             variable.name);
  }
}

} // namespace dotek::targets
