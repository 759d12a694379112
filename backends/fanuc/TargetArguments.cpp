// A program that is called without an argument, or with others.
#include "backends/fanuc/TargetVerification.h"

#include "backends/fanuc/TargetAlarms.h"
#include "frontend/gibbs/Ast.h"
#include "sim/machine/Value.h"
#include "support/Decimal.h"
#include "targets/DialogChoices.h"
#include "verify/Bounds.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

namespace dotek::targets {

namespace gibbs = frontend::gibbs;

const verify::DrawField* FanucVerification::fieldOf(const std::string& name) const {
  const std::string folded = gibbs::foldCase(name);
  const auto found =
      std::find_if(from_.plan.fields.begin(), from_.plan.fields.end(),
                   [&](const verify::DrawField& one) { return gibbs::foldCase(one.name) == folded; });
  return found == from_.plan.fields.end() ? nullptr : &*found;
}

std::optional<double> FanucVerification::defaultOf(const verify::DrawField& field) const {
  for (const auto& [name, text] : from_.options.defaults)
    if (gibbs::foldCase(name) == gibbs::foldCase(field.name)) return parseNumber(text);
  return field.initial;
}

void FanucVerification::callWithout(const OutputArgument& argument, const TargetCase& now,
                                    const verify::Entry& entry, TargetRun& out) {
  const std::uint32_t local = stdlib::localOf(argument.letter);
  verify::Entry without = entry;
  std::erase_if(without.variables, [&](const auto& one) { return one.first == local; });
  const verify::Record record = runText(now, without, nullptr);
  const std::string who = fmt::format("without {} ({})", argument.letter, argument.name);
  const std::string alarm = fmt::format("ARGUMENT {} MISSING", argument.letter);
  if (stopsAtOnce(record, without, alarm)) {
    const std::string_view listed = listedDefault(translation_.text, argument.letter);
    if (!listed.empty() && listed != "GIVE")
      differs(who, fmt::format("its default of {} has to be taken", listed), record, out);
    else if (!listed.empty() || !from_.options.useDefaults)
      return;
    const verify::DrawField* const field = fieldOf(argument.name);
    if (field == nullptr || !defaultOf(*field)) return;
    const SourceQuestions::Ran meant = now.questions->with(field->name, *defaultOf(*field));
    if (meant.answer == SourceQuestions::Answer::Runs)
      differs(who, "its default has to be taken", record, out);
    return;
  }
  const std::string wanted = fmt::format("`{}` has to stop it before anything moves", alarm);
  const verify::DrawField* const field = fieldOf(argument.name);
  // `--default` of a cycle of the language is its default, a literal as well; the header has the number.
  const auto& flags = from_.options.defaults;
  const bool byFlag = from_.plan.cycleFile && field != nullptr &&
                      std::any_of(flags.begin(), flags.end(), [&](const auto& one) {
                        return gibbs::foldCase(one.first) == gibbs::foldCase(field->name);
                      });
  std::optional<double> value = field == nullptr ? std::nullopt : defaultOf(*field);
  if (byFlag && !value) value = parseNumber(std::string(listedDefault(translation_.text, argument.letter)));
  if (field != nullptr && !byFlag && !from_.options.useDefaults && now.questions->moves(field->name)) {
    differs(who, wanted, record, out);
    return;
  }
  // A parameter without a default that only feeds a check changes nothing where it is left out and the
  // checks can be decided without it.
  if (!value && now.questions->rejectsSome(field == nullptr ? argument.name : field->name)) {
    differs(who, wanted, record, out);
    return;
  }
  SourceQuestions::Ran meant;
  if (value)
    meant = now.questions->with(field->name, *value);
  else if (now.source != nullptr)
    meant = {SourceQuestions::Answer::Runs, *now.source};
  if (meant.answer == SourceQuestions::Answer::None) return;
  if (meant.answer == SourceQuestions::Answer::Rejected) {
    if (!stopsAtOnce(record, without, ""))
      differs(who, "an alarm has to stop it before anything moves", record, out);
    return;
  }
  const verify::CompareRules rules = rulesElsewhere(now, meant.record);
  if (searchesOn(meant.record, record, rules)) return;
  std::vector<verify::Difference> found = verify::compare(meant.record, record, rules);
  for (verify::Difference& one : found)
    one.text =
        value ? fmt::format("called {}, for which {} is the default: {}", who, numberText(*value), one.text)
              : fmt::format("called {}: {}", who, one.text);
  const bool alike = found.empty();
  if (!alike) noteCaller(who);
  add(std::move(found), out);
  if (!value) return;
  if (alike) compareDefault(argument, *value, without, record, now, out);
  callAtBounds(argument, *field, *value, now, entry, out);
}

void FanucVerification::compareDefault(const OutputArgument& argument, double value,
                                       const verify::Entry& without, const verify::Record& ran,
                                       const TargetCase& now, TargetRun& out) {
  const std::uint32_t local = stdlib::localOf(argument.letter);
  if (local >= ran.locals.size() || sim::isNull(ran.locals[local]) || sim::isUnknown(ran.locals[local]))
    return;
  verify::Entry with = without;
  with.variables.emplace_back(local, value);
  const verify::Record meant = runText(now, with, nullptr);
  if (local >= meant.locals.size() || sim::isNull(meant.locals[local]) ||
      sim::isUnknown(meant.locals[local]) ||
      std::abs(meant.locals[local] - ran.locals[local]) <= from_.options.tolerance)
    return;
  const std::string who = fmt::format("without {} ({})", argument.letter, argument.name);
  out.differs(verify::Aspect::Variable,
              fmt::format("called {}, for which {} is the default: it counts with {}", who, numberText(value),
                          numberText(ran.locals[local])));
  noteCaller(who);
}

void FanucVerification::callAtBounds(const OutputArgument& argument, const verify::DrawField& field,
                                     double value, const TargetCase& now, const verify::Entry& entry,
                                     TargetRun& out) {
  if (from_.plan.bounds == nullptr || atBounds_.contains(argument.letter)) return;
  const verify::Bounds& bounds = *from_.plan.bounds;
  verify::Case given = now.drawn;
  given.values[field.name] = value;
  std::vector<verify::DrawField> alone = from_.plan.fields, others = from_.plan.fields;
  for (std::size_t i = 0; i < others.size(); ++i)
    (others[i].name == field.name ? others : alone)[i].fixed = value;
  std::set<std::size_t> ofField;
  for (const verify::Bound& bound : bounds.find(alone, {given}, true, UINT64_MAX))
    ofField.insert(bound.comparison);
  for (const verify::Bound& bound : bounds.find(others, {given}, true, UINT64_MAX)) {
    const auto met = ofField.contains(bound.comparison) ? bounds.meet(bound, others, given, true)
                                                        : std::optional<verify::Case>();
    for (const int steps : {-1, 0, 1}) {
      if (!met) break;
      atBounds_.insert(argument.letter);
      verify::Case beside = *met;
      const verify::DrawField& moved = others[bound.field];
      beside.values[moved.name] += steps * std::pow(10.0, -moved.decimals);
      verify::Entry with = now.entry;
      with.blocks = entry.blocks;
      addArguments(beside, with);
      verify::Entry without = with;
      std::erase_if(without.variables,
                    [&](const auto& one) { return one.first == stdlib::localOf(argument.letter); });
      const verify::Record meant = runText(now, with, nullptr), ran = runText(now, without, nullptr);
      if (meant.ending == ran.ending && meant.alarm == ran.alarm && meant.text == ran.text) continue;
      out.differsAt(verify::Aspect::Ending,
                    fmt::format("called with {} {}: with {} {}, its default, it {}; without {} it {}",
                                moved.name, numberText(beside.values[moved.name]), argument.letter,
                                numberText(value), endingOf(meant), argument.letter, endingOf(ran)),
                    text_.line(ran.endedAt));
      return;
    }
  }
}

void FanucVerification::callWithNoOffset(const OutputArgument& argument, const TargetCase& now,
                                         const verify::Entry& entry, TargetRun& out) {
  constexpr std::string_view kAlarm = "TOOL OFFSET NOT ABOVE 0";
  const verify::DrawField* const field = fieldOf(argument.name);
  const std::string& name = field == nullptr ? argument.name : field->name;
  const std::uint32_t local = stdlib::localOf(argument.letter);
  constexpr double kNone[] = {0, -1};
  const auto takes = [&](double value) { return now.questions->takesNoOffset(name, value); };
  if (std::none_of(std::begin(kNone), std::end(kNone), takes)) return;
  for (const double value : kNone) {
    // A picture may print nothing for 0.
    if (!takes(value) && now.questions->with(name, value).answer != SourceQuestions::Answer::None) continue;
    verify::Entry other = entry;
    std::erase_if(other.variables, [&](const auto& one) { return one.first == local; });
    other.variables.emplace_back(local, value);
    const verify::Record record = runText(now, other, nullptr);
    const bool moves = std::any_of(record.pieces.begin(), record.pieces.end(), [](const verify::Piece& one) {
      return one.frame.system != 0 && one.frame.toolLength == 0;
    });
    if (moves || record.ending != verify::Ending::Alarm || record.alarm < kOwnAlarms ||
        !verify::showsAlarm(record.text, kAlarm, control_.alarmLength))
      differs(fmt::format("with {} {}", argument.letter, numberText(value)),
              fmt::format("`{}` has to stop it before it takes the tool's length", kAlarm), record, out);
  }
}

void FanucVerification::callWithTools(const verify::DrawField& field, const TargetCase& now,
                                      const verify::Entry& entry, TargetRun& out) {
  const auto argument =
      std::find_if(translation_.arguments.begin(), translation_.arguments.end(),
                   [&](const auto& one) { return gibbs::foldCase(one.name) == gibbs::foldCase(field.name); });
  if (argument == translation_.arguments.end()) return;
  const std::uint32_t local = stdlib::localOf(argument->letter);
  for (const double value : {0.0, control_.variables.toolCount + 1.0, 1.5}) {
    const SourceQuestions::Ran meant = now.questions->with(field.name, value);
    if (meant.answer == SourceQuestions::Answer::Runs && meant.record.ending == verify::Ending::Finished)
      continue;
    verify::Entry other = entry;
    std::erase_if(other.variables, [&](const auto& one) { return one.first == local; });
    other.variables.emplace_back(local, value);
    const verify::Record record = runText(now, other, nullptr);
    if (record.ending != verify::Ending::Alarm || record.alarm < kOwnAlarms || setsSomething(record, other))
      differs(fmt::format("with {} {}", argument->letter, numberText(value)),
              "an alarm of its own has to stop it before anything is set, it is no tool offset", record, out);
  }
}

std::string FanucVerification::endingOf(const verify::Record& record) {
  return record.ending == verify::Ending::Finished ? "runs to its end"
                                                   : fmt::format("stops with `{}`", record.text);
}

void FanucVerification::callWithSystems(const verify::DrawField& field, const TargetCase& now,
                                        const verify::Entry& entry, TargetRun& out) {
  const auto argument =
      std::find_if(translation_.arguments.begin(), translation_.arguments.end(),
                   [&](const auto& one) { return gibbs::foldCase(one.name) == gibbs::foldCase(field.name); });
  const auto drawn = now.drawn.values.find(field.name);
  if (argument == translation_.arguments.end() || drawn == now.drawn.values.end()) return;
  const double first = field.firstSystem;
  if (field.systemOf(drawn->second) == 0) return;
  callWithActive(field, argument->letter, now, entry, out);
  for (const double value : {first - 1, first + 6, first + 0.5}) {
    const SourceQuestions::Ran meant = now.questions->with(field.name, value);
    // What the source takes is no fault of the translation, but where it is another value by the time that a
    // macro gets it.
    if (meant.answer == SourceQuestions::Answer::Runs && meant.record.ending == verify::Ending::Finished &&
        !(meant.losesDigits && setsByCall(now, field.systemOf(drawn->second))))
      continue;
    verify::Entry other = entry;
    const std::uint32_t local = stdlib::localOf(argument->letter);
    std::erase_if(other.variables, [&](const auto& one) { return one.first == local; });
    other.variables.emplace_back(local, value);
    const verify::Record record = runText(now, other, nullptr);
    if (!stopsAtOnce(record, other, ""))
      differs(fmt::format("with {} {}", argument->letter, numberText(value)),
              "an alarm has to stop it before anything moves, it is no work offset", record, out);
  }
}

bool FanucVerification::setsByCall(const TargetCase& now, std::uint32_t system) {
  if (now.source == nullptr) return false;
  const auto& measures = now.source->measures;
  return std::any_of(measures.begin(), measures.end(), [system](const verify::Measure& one) {
    return one.program != 0 && std::any_of(one.datums.begin(), one.datums.end(), [system](const auto& datum) {
             return datum.first.first == system;
           });
  });
}

void FanucVerification::callWithActive(const verify::DrawField& field, char letter, const TargetCase& now,
                                       const verify::Entry& entry, TargetRun& out) {
  const double value = field.firstSystem + (now.entry.system - 54.0);
  const SourceQuestions::Ran meant = now.questions->with(field.name, value);
  if (meant.answer != SourceQuestions::Answer::Runs) return;
  verify::Entry other = entry;
  const std::uint32_t local = stdlib::localOf(letter);
  std::erase_if(other.variables, [&](const auto& one) { return one.first == local; });
  other.variables.emplace_back(local, value);
  const verify::Record record = runText(now, other, nullptr);
  if (record.ending == verify::Ending::Alarm && translation_.madeUp(text_.line(record.endedAt))) return;
  const verify::CompareRules rules = rulesElsewhere(now, meant.record);
  if (searchesOn(meant.record, record, rules)) return;
  std::vector<verify::Difference> found = verify::compare(meant.record, record, rules);
  const std::string who = fmt::format("with {} {}, the system in force", letter, numberText(value));
  for (verify::Difference& one : found)
    one.text = fmt::format("called {}: {}", who, one.text);
  if (!found.empty()) noteCaller(who);
  add(std::move(found), out);
}
void FanucVerification::callBesideList(const verify::DrawField& field, const TargetCase& now,
                                       const verify::Entry& entry, TargetRun& out) {
  const std::vector<double> values = besideList(field);
  const auto argument =
      std::find_if(translation_.arguments.begin(), translation_.arguments.end(),
                   [&](const auto& one) { return gibbs::foldCase(one.name) == gibbs::foldCase(field.name); });
  if (values.empty() || argument == translation_.arguments.end() ||
      !(now.questions->moves(field.name) || now.questions->prints(field.name, field.choices)))
    return;
  const std::uint32_t local = stdlib::localOf(argument->letter);
  for (const double value : values) {
    verify::Entry other = entry;
    std::erase_if(other.variables, [&](const auto& one) { return one.first == local; });
    other.variables.emplace_back(local, value);
    const verify::Record record = runText(now, other, nullptr);
    if (!stopsAtOnce(record, other, ""))
      differs(fmt::format("with {} {}", argument->letter, numberText(value)),
              "an alarm has to stop it before anything moves, the dialog's list does not offer it", record,
              out);
  }
}

} // namespace dotek::targets
