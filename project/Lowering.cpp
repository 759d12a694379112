#include "project/Lowering.h"

#include "frontend/compost/Lower.h"
#include "frontend/compost/Summary.h"
#include "frontend/gibbs/Lower.h"
#include "ir/Flow.h"
#include "ir/InferKinds.h"
#include "ir/Liveness.h"
#include "ir/Positions.h"
#include "ir/Rewrite.h"
#include "ir/Verify.h"
#include "project/Assumptions.h"
#include "project/CertainFindings.h"
#include "project/Fields.h"
#include "project/FormChoice.h"
#include "project/Hosts.h"
#include "project/Prog.h"
#include "project/Values.h"
#include "stdlib/CodeSpan.h"
#include "stdlib/HostInputs.h"
#include "support/Decimal.h"
#include "support/messages/Commands.h"
#include "support/messages/Nc.h"
#include "support/messages/Output.h"

#include <algorithm>
#include <utility>

namespace dotek::project {

namespace compost = frontend::compost;
namespace gibbs = frontend::gibbs;

std::optional<stdlib::Control> loadControl(const std::string& name, Session& session) {
  if (const stdlib::Control* control = session.control(name)) return *control;
  std::string known;
  for (const stdlib::DataFile* file : session.data().list("controls"))
    known += (known.empty() ? "" : ", ") + file->name;
  session.diagnostics().report<diag::UnknownProfile>({}, name, known);
  return std::nullopt;
}

void checkProbeCodes(const stdlib::Control& control, Session& session) {
  for (const bool on : {true, false}) {
    const std::string& code = on ? session.probeCodes().on : session.probeCodes().off;
    const std::string meaning = stdlib::otherMeaning(control, code, on);
    if (!meaning.empty())
      session.diagnostics().report<diag::ProbeCodeTaken>({}, code, control.title, meaning,
                                                         on ? "--probe-on" : "--probe-off");
  }
  if (const std::string taken =
          stdlib::takenAuxiliary(control, stdlib::auxiliaryCodes(session.options().assume));
      !taken.empty())
    session.diagnostics().report<diag::AuxiliaryTaken>({}, control.title, taken);
}

namespace {

void readSets(LoweringInputs& inputs, SetTexts texts, Session& session) {
  for (const auto& [name, text] : session.options().set) {
    const std::optional<double> value = parseNumber(text);
    const std::string folded = gibbs::foldCase(name);
    const bool twice = std::any_of(inputs.sets.begin(), inputs.sets.end(),
                                   [&](const auto& set) { return gibbs::foldCase(set.first) == folded; });
    if (!value && texts == SetTexts::Literals) continue;
    if (!value)
      session.diagnostics().report<diag::NotANumber>({}, "--set", name, text);
    else if (twice)
      session.diagnostics().report<diag::GivenTwice>({}, "--set", name);
    else
      inputs.sets.emplace_back(name, *value);
  }
}

// One cycle on its path to the IR.
class Lowering {
public:
  Lowering(const CycleFolder& folder, const LoweringInputs& inputs, Session& session, Strictness strictness)
      : folder_(folder), inputs_(inputs), session_(session), lenient_(strictness == Strictness::Lenient) {}

  std::optional<LoweredCycle> run(std::set<std::string>& usedSets);
  // Of a lenient one: what is certainly wrong with the checks of the dialog.
  const Diagnostics& certain() const { return certain_; }

private:
  ir::Cycle& cycle() { return out_.cycle; }
  bool branch(const compost::Routine& routine, FieldTable& fields);
  bool path();
  bool checks();
  bool turnedAway();
  void fix(ir::VariableId id, const std::string& name, double value);
  void applySets(FieldTable& fields, std::set<std::string>& usedSets);
  std::optional<ir::VariableId> fieldVariable(FieldTable& fields, const std::string& name, SourceRange where);
  ir::VariableId host(const std::string& name);
  bool settleChangedFields();
  bool takeComputed();
  bool isTyped(const std::string& name) const;
  bool verified();
  gibbs::LowerContext gibbsContext();

  const CycleFolder& folder_;
  const LoweringInputs& inputs_;
  Session& session_;
  const bool lenient_;
  LoweredCycle out_;
  Diagnostics certain_;
  std::map<std::string, ir::VariableId> parameters_; // by folded name
  std::map<std::string, ir::VariableId> postOnly_;   // fields that only the post knows
  std::map<std::string, ir::VariableId> hosts_;
};

ir::VariableId Lowering::host(const std::string& name) {
  const auto known = hosts_.find(name);
  if (known != hosts_.end()) return known->second;
  ir::Variable variable;
  variable.name = name;
  variable.role = ir::Role::Host;
  variable.kind = name == "return_feed"   ? ir::Kind::Feed
                  : name == "tool_number" ? ir::Kind::Count
                  : name == "tool_offset" ? ir::Kind::ToolOffset
                                          : ir::Kind::Length;
  for (const stdlib::HostInput& input : stdlib::kHostInputs) {
    if (input.name == name) variable.meaning = input.meaning;
  }
  const ir::VariableId id = cycle().add(std::move(variable));
  hosts_.emplace(name, id);
  const auto given = inputs_.hosts.find(name);
  if (given != inputs_.hosts.end()) fix(id, name, given->second);
  return id;
}

void Lowering::fix(ir::VariableId id, const std::string& name, double value) {
  out_.fixed.insert_or_assign(id, value);
  out_.fixedByName.insert_or_assign(name, value);
}

std::optional<ir::VariableId> Lowering::fieldVariable(FieldTable& fields, const std::string& name,
                                                      SourceRange where) {
  Diagnostics before;
  if (lenient_) before = session_.diagnostics();
  const std::optional<FieldOrigin> origin = fields.origin(name, where);
  if (lenient_) session_.diagnostics() = std::move(before);
  if (!origin && !lenient_) return std::nullopt;
  if (origin && !origin->number) return parameters_.at(gibbs::foldCase(origin->variable));
  if (!origin) {
    const auto alike = parameters_.find(gibbs::foldCase(name));
    if (alike != parameters_.end()) return alike->second;
  }
  const auto known = postOnly_.find(name);
  if (known != postOnly_.end()) return known->second;
  ir::Variable variable;
  variable.name = name;
  variable.role = ir::Role::Parameter;
  variable.range = where;
  const ir::VariableId id = cycle().add(std::move(variable));
  postOnly_.emplace(name, id);
  if (origin) fix(id, name, *origin->number);
  return id;
}

void Lowering::applySets(FieldTable& fields, std::set<std::string>& usedSets) {
  for (const auto& [name, value] : inputs_.sets) {
    if (!fields.set(name, value, {})) continue;
    usedSets.insert(name);
    if (const auto found = parameters_.find(gibbs::foldCase(name)); found != parameters_.end())
      fix(found->second, cycle().variable(found->second).name, value);
  }
}

bool Lowering::branch(const compost::Routine& routine, FieldTable& fields) {
  std::vector<const stdlib::MacroSet*> sets;
  for (const stdlib::MacroSet& set : session_.macroSets(&*inputs_.sourceControl))
    sets.push_back(&set);
  const compost::LowerSettings settings{
      session_.sources(),
      *inputs_.form,
      session_.limits(),
      *inputs_.sourceControl,
      std::move(sets),
      session_.options().assume,
      [&](const std::string& name, SourceRange where) { return fieldVariable(fields, name, where); },
      [&](const std::string& name, SourceRange) { return std::optional(host(name)); },
      [&](ir::VariableId id) {
        const auto found = out_.fixed.find(id);
        return found == out_.fixed.end() ? std::nullopt : std::optional(found->second);
      }};
  std::optional<compost::Lowered> lowered = compost::lowerRoutine(*inputs_.program, routine, folder_.name,
                                                                  cycle(), settings, session_.diagnostics());
  if (!lowered) return false;
  if (lowered->body.empty()) {
    session_.diagnostics().report<diag::NothingPosted>(routine.nameRange, routine.name, folder_.name,
                                                       testedCycles(*inputs_.program, folder_.name));
    return false;
  }
  cycle().body = std::move(lowered->body);
  const std::vector<bool> reached = ir::reachable(cycle().body);
  for (std::size_t i = 0; i < reached.size(); ++i) {
    if (reached[i] || std::holds_alternative<ir::Label>(cycle().body[i].node)) continue;
    session_.diagnostics().report<diag::BehindAlarm>(cycle().body[i].origin.range());
    break;
  }
  out_.macros = lowered->macros == nullptr
                    ? nullptr
                    : session_.macroSet(lowered->macros->name, &*inputs_.sourceControl);
  out_.printed = std::move(lowered->printed);
  return true;
}

gibbs::LowerContext Lowering::gibbsContext() {
  gibbs::LowerContext context{
      session_.sources(),
      session_.gibbsKeywords(),
      session_.limits(),
      session_.diagnostics(),
      session_.options().assume,
      {},
      [this](const std::string& name, SourceRange where) { return folder_.loader->macro(name, where); },
      [this](const std::string& name, SourceRange where) { return folder_.loader->dialog(name, where); },
      [this](const std::string& name) { return host(name); }};
  return context;
}

bool Lowering::path() {
  if (!folder_.cycle->toolPath) return false;
  gibbs::LowerContext context = gibbsContext();
  context.touches = touchLines(session_.sources(), session_.options().assume, session_.diagnostics());
  if (!gibbs::lowerToolPath(*folder_.cycle->toolPath, cycle(), context)) return false;
  if (ir::countsFrom(cycle(), ir::Frame::Retract))
    host("retract"); // also where the macro does not ask for the plane
  return true;
}

bool Lowering::checks() {
  if (!folder_.cycle->cycleData) return true;
  if (session_.options().assume.contains("unchecked")) {
    session_.diagnostics().report<diag::ChecksLeftOut>({folder_.cycle->cycleData->file, 0, 0});
    return true;
  }
  gibbs::LowerContext context = gibbsContext();
  if (!lenient_) return gibbs::lowerChecks(*folder_.cycle->cycleData, cycle(), context);
  out_.checked = !folder_.cycle->cycleData->hasErrorNodes &&
                 gibbs::lowerChecks(*folder_.cycle->cycleData, cycle(), context);
  if (!out_.checked) cycle().checks.clear();
  // Only errors of the body are in its path.
  keepCertain(session_.diagnostics(), false, certain_);
  session_.diagnostics() = Diagnostics();
  return true;
}

bool Lowering::turnedAway() {
  const std::optional<ir::CycleStatement> alarm = certainAlarm(out_);
  if (alarm) reportRejected(folder_, out_, *alarm, session_);
  return alarm.has_value();
}

// The dialog has an input for the field.
bool Lowering::isTyped(const std::string& name) const {
  const auto& dialog = folder_.cycle->dialog;
  const std::string folded = gibbs::foldCase(name);
  return dialog &&
         std::any_of(dialog->controls.begin(), dialog->controls.end(), [&](const gibbs::Control& control) {
           return control.variable && gibbs::foldCase(control.variable->text) == folded;
         });
}

// A field that the macro sets before anything reads it, and that nobody can type, is no input: a local.
// false: it was given a value.
bool Lowering::takeComputed() {
  std::map<ir::VariableId, const ir::CycleStatement*> assigned;
  std::map<ir::VariableId, std::set<std::string>> formulas; // as the macro spells them
  for (const ir::CycleStatement& statement : cycle().checks)
    if (const auto* assign = std::get_if<ir::Assign>(&statement.node))
      if (cycle().variable(assign->variable).role == ir::Role::Parameter) {
        assigned.emplace(assign->variable, &statement);
        const SourceRange range = statement.origin.range();
        const SourceFile& file = session_.sources().file(range.file);
        formulas[assign->variable].insert(
            toUtf8(file.bytes().substr(range.begin, range.end - range.begin), file.encoding()));
      }
  if (assigned.empty()) return true;
  const std::set<ir::VariableId> live = ir::liveAtEntry(cycle().checks, ir::liveAtEntry(cycle().body, {}));
  bool good = true;
  for (const auto& [id, statement] : assigned) {
    ir::Variable& variable = cycle().variables[id];
    if (live.contains(id) ||
        (isTyped(variable.name) && !session_.options().assume.contains("changed-field=macro")))
      continue;
    const SourceRange range = statement->origin.range();
    if (out_.fixed.contains(id)) {
      session_.diagnostics().report<diag::FieldIsComputed>(range, variable.name);
      good = false;
      continue;
    }
    variable.role = ir::Role::Local;
    variable.defaultValue.reset();
    variable.optional = false;
    const std::set<std::string>& ways = formulas.at(id);
    out_.computed.emplace(id, ways.size() == 1 ? *ways.begin() : variable.name + " IN SEVERAL WAYS");
  }
  return good;
}

// Which value of a field the CAM stores is certain where the user cannot type it; else an assumption says it.
bool Lowering::settleChangedFields() {
  const auto& assume = session_.options().assume;
  std::map<ir::VariableId, ir::VariableId> shadows;
  bool settled = true;
  for (const ir::CycleStatement& statement : cycle().checks) {
    const auto* assign = std::get_if<ir::Assign>(&statement.node);
    if (assign == nullptr || cycle().variable(assign->variable).role != ir::Role::Parameter) continue;
    const std::string name = cycle().variable(assign->variable).name;
    const bool typed = isTyped(name);
    const bool given = assume.contains("changed-field=given");
    if (!typed || assume.contains("changed-field=macro") || (lenient_ && !given)) {
      session_.diagnostics().report<diag::FieldAssigned>(statement.origin.range(), name);
    } else if (given) {
      shadows.emplace(assign->variable, 0);
    } else {
      session_.diagnostics().report<diag::FieldAssignedByChecks>(statement.origin.range(), name);
      settled = false;
    }
  }
  if (!settled || shadows.empty()) return settled;
  std::vector<ir::CycleStatement> copies;
  for (auto& [original, shadow] : shadows) {
    ir::Variable copy = cycle().variable(original);
    copy.role = ir::Role::Local;
    shadow = cycle().add(std::move(copy));
    ir::CycleStatement statement;
    statement.node = ir::Assign{shadow, ir::variable(original)};
    statement.origin.reason = "copy that the checks may change";
    copies.push_back(std::move(statement));
  }
  ir::rename(cycle().checks, shadows);
  cycle().checks.insert(cycle().checks.begin(), std::make_move_iterator(copies.begin()),
                        std::make_move_iterator(copies.end()));
  return true;
}

bool Lowering::verified() {
  bool good = true;
  for (const ir::Violation& violation : ir::verify(cycle())) {
    good = false;
    if (violation.mixedKinds)
      session_.diagnostics().report<diag::MixedKinds>(violation.range, violation.message);
    else
      session_.diagnostics().report<diag::InternalDefect>(violation.range, violation.message);
  }
  return good;
}

std::optional<LoweredCycle> Lowering::run(std::set<std::string>& usedSets) {
  out_.cycle = gibbs::declareCycle(*folder_.cycle, session_.sources());
  for (ir::VariableId id = 0; id < cycle().variables.size(); ++id)
    parameters_.emplace(gibbs::foldCase(cycle().variable(id).name), id);
  if (folder_.cycle->defineData) cycle().range = {folder_.cycle->defineData->file, 0, 0};
  const compost::Routine* routine = nullptr;
  std::vector<std::string> printed;
  if (inputs_.program) {
    routine = chooseRoutine(*inputs_.program, inputs_.routine, inputs_.routineAt, folder_.name, session_);
    if (routine == nullptr) {
      for (const auto& set : inputs_.sets)
        usedSets.insert(set.first); // one finding for one cause
      for (const auto& [postField, variable] : session_.options().field)
        usedSets.insert(postField + "=" + variable);
      return std::nullopt;
    }
    for (const compost::FieldRef& field : compost::fieldsPrinted(*inputs_.program, *routine, folder_.name))
      printed.push_back(field.name);
  }
  FieldTable fields(folder_, std::move(printed), session_);
  applySets(fields, usedSets);
  bool good = fields.mapGiven(inputs_.oneOfSeveral, usedSets);
  if (!good && !lenient_) return std::nullopt;
  good = checks();
  // What the dialog rejects is reported before what its blocks would come to.
  if (good && !lenient_ && turnedAway()) return std::nullopt;
  good = (routine != nullptr ? branch(*routine, fields) : path()) && good;
  if (!good || session_.diagnostics().hasErrors()) return std::nullopt;
  if (!takeComputed() && !lenient_) return std::nullopt;
  if (!settleChangedFields()) return std::nullopt;
  ir::inferKinds(cycle());
  if (!lenient_ && !verified()) return std::nullopt;
  return std::move(out_);
}

} // namespace

void useForm(LoweringInputs& inputs, const std::string& name, Session& session) {
  inputs.form = session.form(name);
  if (inputs.form && !inputs.form->control.empty())
    inputs.sourceControl = loadControl(inputs.form->control, session);
}

std::optional<LoweringInputs> loadSettings(const SourceOptions& source, Session& session, SetTexts sets) {
  LoweringInputs inputs;
  Diagnostics& diagnostics = session.diagnostics();
  inputs.givenHosts = parseHosts(session.options().host, diagnostics);
  inputs.hosts = inputs.givenHosts;
  readSets(inputs, sets, session);
  if (session.options().job) inputs.job = loadJob(*session.options().job, session);
  if (inputs.job) inputs.hosts.insert(inputs.job->hosts.begin(), inputs.job->hosts.end());
  inputs.routine = source.routine;
  if (!inputs.routine && inputs.job) {
    inputs.routine = inputs.job->operationRoutine;
    inputs.routineAt = inputs.job->operationRange;
  }
  if (source.prog) {
    session.takeProbeCodes(settingsOf(*source.prog, session).probe);
    inputs.formChoice = chooseForm(source, session);
    inputs.form = session.form(inputs.formChoice.name);
  }
  if (diagnostics.hasErrors()) return std::nullopt;
  return inputs;
}

bool loadProgInto(LoweringInputs& inputs, const SourceOptions& source, Session& session) {
  std::optional<compost::Program> program = loadProg(*source.prog, session);
  if (!program) return false;
  noteForm(inputs.formChoice, program->file, session);
  inputs.program = std::make_shared<const compost::Program>(std::move(*program));
  return !session.diagnostics().hasErrors();
}

std::optional<LoweringInputs> loadLoweringInputs(const SourceOptions& source, const std::string& control,
                                                 Session& session, SetTexts sets) {
  std::optional<LoweringInputs> inputs = loadSettings(source, session, sets);
  std::optional<stdlib::Control> target;
  if (!control.empty()) target = loadControl(control, session);
  if (target) checkProbeCodes(*target, session);
  if (!inputs) return std::nullopt;
  inputs->control = std::move(target);
  inputs->sourceControl = inputs->form && !inputs->form->control.empty()
                              ? loadControl(inputs->form->control, session)
                              : inputs->control;
  if (session.diagnostics().hasErrors()) return std::nullopt;
  if (source.prog && !loadProgInto(*inputs, source, session)) return std::nullopt;
  return inputs;
}

std::optional<LoweredCycle> lowerCycle(const CycleFolder& folder, const LoweringInputs& inputs,
                                       std::set<std::string>& usedSets, Session& session,
                                       Strictness strictness) {
  if (strictness == Strictness::Strict) return Lowering(folder, inputs, session, strictness).run(usedSets);
  Diagnostics kept = std::exchange(session.diagnostics(), Diagnostics());
  Lowering lowering(folder, inputs, session, strictness);
  std::optional<LoweredCycle> out = lowering.run(usedSets);
  keepCertain(lowering.certain(), true, kept);
  keepCertain(session.diagnostics(), inputs.formChoice.named, kept);
  session.diagnostics() = std::move(kept);
  return out;
}

} // namespace dotek::project
