#include "targets/Stage.h"

#include "verify/Compare.h"
#include "verify/Exactness.h"
#include "verify/Random.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>

namespace dotek::targets {

namespace {

// A stylus where no machine file states one, by its ball: stem and body.
constexpr double kStemShare = 0.6, kStemLength = 60, kBodyDiameter = 40, kBodyLength = 60;

} // namespace

sim::Probe probeFor(const VerifyPlan& plan, const verify::Case& drawn) {
  const double radius = drawn.hosts.at("tool_radius");
  sim::Probe probe;
  if (plan.machine) {
    probe = plan.machine->probe;
  } else {
    probe.length = verify::kToolLength;
    probe.stemDiameter = 2 * radius * kStemShare;
    probe.stemLength = kStemLength;
    probe.bodyDiameter = kBodyDiameter;
    probe.bodyLength = kBodyLength;
  }
  probe.ballDiameter = 2 * radius;
  probe.effectiveRadius = radius;
  probe.lengthToTip = true;
  probe.preTravel = 0; // a calibrated probe, as exact as its signal
  probe.noise = 0;
  probe.on = false;
  return probe;
}

std::uint64_t callerStream(const verify::Case& drawn) {
  std::uint64_t out = drawn.system;
  for (const auto* values : {&drawn.values, &drawn.hosts})
    for (const auto& [name, value] : *values)
      out = verify::Random::sub(out, std::bit_cast<std::uint64_t>(value + 0.0));
  return out;
}

verify::Entry entryFor(const verify::Case& drawn, bool probeOn) {
  verify::Entry entry;
  const auto host = [&](const char* name) {
    const auto found = drawn.hosts.find(name);
    return found == drawn.hosts.end() ? 0.0 : found->second;
  };
  entry.start = {host("start_x"), host("start_y"), host("start_z")};
  entry.system = drawn.system;
  entry.toolOffset = drawn.toolOffset;
  entry.probeOn = probeOn;
  // What #4120 holds: the operation's tool is in the spindle.
  const double tool = host("tool_number");
  if (tool >= 1 && tool <= 9999 && tool == std::floor(tool)) entry.blocks = fmt::format("T{:.0f}\n", tool);
  return entry;
}

std::optional<SourceRange> blockWith(const ir::Program& program, const stdlib::Control& control,
                                     stdlib::Function function) {
  for (const ir::ProgramStatement& statement : program.body) {
    const auto* block = std::get_if<ir::NcBlock>(&statement.node);
    if (block == nullptr) continue;
    for (const ir::Word& word : block->words) {
      if (word.address != 'G' && word.address != 'M') continue;
      const double* code = ir::constantValue(word.value);
      const stdlib::CodeInfo* info =
          code == nullptr || !(*code >= 0 && *code < 1e6)
              ? nullptr
              : control.find(word.address, static_cast<std::uint32_t>(std::lround(*code * 10)));
      if (info != nullptr && info->function == function) return statement.origin.range();
    }
  }
  return std::nullopt;
}

sim::Part emptyPart(const sim::Point3& middle) {
  constexpr double kAway = 10000;
  sim::PartBuilder builder;
  const sim::Point3 corner = middle + sim::Point3{0, 0, -kAway};
  builder.box(corner, corner + sim::Point3{1, 1, 1});
  std::string fault;
  return *builder.finish(fault);
}

sim::Picture pictureOf(const verify::Record& record, const sim::Part& part, const sim::Probe& probe,
                       bool empty) {
  sim::Picture out;
  if (!empty) out.part = part;
  out.probe = probe;
  out.moves = record.moves;
  if (out.moves.empty()) return out;
  const std::size_t last = out.moves.size() - 1;
  for (const verify::Measure& measure : record.measures)
    for (const sim::ProbeEvent& contact : measure.contacts)
      out.contacts.push_back({contact.point, last});
  for (const auto& [event, where] : record.events)
    out.errors.push_back({event.centre, std::string(sim::outcomeName(event.outcome)), last});
  if (record.ending != verify::Ending::Finished)
    out.errors.push_back(
        {record.end + sim::Point3{0, 0, probe.ballDiameter / 2}, verify::endText(record), last});
  return out;
}

CasePictures picturesOf(const verify::Record& source, const ShownRun& translation, const sim::Part& part,
                        const sim::Probe& probe, bool empty) {
  CasePictures out{pictureOf(source, part, probe, empty), verify::endText(source), std::nullopt, ""};
  if (!translation.record) return out;
  out.translation = pictureOf(*translation.record, part, probe, empty);
  out.translationEnds = (translation.who.empty() ? "" : translation.who + ": ") +
                        (translation.record->pieces.empty() ? "before anything moves " : "") +
                        verify::endText(*translation.record);
  return out;
}

std::string controlText(const stdlib::Control& control) {
  return control.title + " (" + control.name + ")";
}

Limits limitsOfRun(const Limits& limits) {
  constexpr std::uint32_t kMostSteps = 200'000; // a cycle takes some hundreds
  Limits out = limits;
  if (out.simSteps == Limits().simSteps) out.simSteps = kMostSteps;
  return out;
}

namespace {

// The zero of the system in which the case begins is another one at the end.
bool writesActive(const verify::Record& record, const verify::Entry& entry) {
  const sim::Point3& zero = entry.zeros[entry.system - 54];
  const double before[] = {zero.x, zero.y, zero.z};
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const auto after = record.zeros.find({entry.system, axis});
    if (after != record.zeros.end() && after->second != before[axis]) return true;
  }
  return false;
}

// Those that begin where an earlier one of them has moved the zero of `system`; all where a statement has.
double measuresAfterDatum(const verify::Record& source, std::uint32_t system) {
  const auto sets = [&](const verify::Measure& measure) {
    return std::any_of(measure.datums.begin(), measure.datums.end(),
                       [&](const auto& datum) { return datum.first.first == system; });
  };
  const auto first = std::find_if(source.measures.begin(), source.measures.end(), sets);
  const auto all = static_cast<double>(source.measures.size());
  return first == source.measures.end() ? all : static_cast<double>(source.measures.end() - first) - 1;
}

} // namespace

bool sameMacros(const stdlib::MacroSet* one, const stdlib::MacroSet* other) {
  return one == other || (one != nullptr && other != nullptr && one->name == other->name);
}

verify::CompareRules programRules(const VerificationSource& from, const stdlib::Control& control,
                                  const stdlib::MacroSet* sourceSet, const stdlib::MacroSet* set) {
  verify::CompareRules rules;
  rules.tolerance = from.options.tolerance;
  rules.results = std::max(rules.tolerance, resultTolerance(control, *from.inputs.sourceControl));
  if (!sameMacros(sourceSet, set)) rules.results = std::max(rules.results, verify::kGridSteps);
  rules.sameAlarmNumbers = sameMacros(sourceSet, set);
  rules.shownText = control.alarmLength;
  const stdlib::CodeInfo* const wait = control.find(stdlib::Function::MachineCoordinates);
  rules.waits = wait != nullptr && wait->grade != "assumed";
  return rules;
}

void allowForDatums(verify::CompareRules& rules, const verify::Record& source, const verify::Entry& entry,
                    const stdlib::Control& control, bool byText) {
  if (!writesActive(source, entry)) return;
  rules.tolerance = std::max(rules.tolerance, rules.results);
  if (!byText) return;
  // A zero that was measured lies beside the grid on which the control rounds words: each measure after it
  // goes back by such a word, half an increment beside where it began at most, and the next begins there.
  const double rounded =
      kRoundedWord * std::pow(10, -control.decimals) * measuresAfterDatum(source, entry.system);
  rules.tolerance = std::max(rules.tolerance, rounded);
  rules.results = std::max(rules.results, rounded); // contacts on round or turned surfaces follow
}

void allowForRounding(verify::CompareRules& rules, const TargetCase& now) {
  rules.tolerance = std::max(rules.tolerance, now.rounding);
  rules.results = std::max(rules.results, now.rounding);
}

double resultTolerance(const stdlib::Control& one, const stdlib::Control& other) {
  constexpr double kEightDigits = 5e-5;
  const auto digits = [](const stdlib::Control& control) {
    return control.arithmetic == stdlib::Arithmetic::Decimal8;
  };
  return digits(one) || digits(other) ? kEightDigits : 0;
}

} // namespace dotek::targets
