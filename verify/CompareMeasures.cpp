// What two runs measure.
#include "support/Decimal.h"
#include "verify/CompareLeft.h"
#include "verify/CompareParts.h"
#include "verify/PathPieces.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace dotek::verify {

namespace {

constexpr int kShown = 6;                 // decimals
constexpr double kPrintedHalf = 0.000501; // of the last place of a word, mm

// The letters in which two calls of one macro differ: "R6 against R-6".
std::string lettersText(const Measure& a, const Measure& b, double tolerance) {
  std::string one, other;
  for (char letter = 'A'; letter <= 'Z'; ++letter) {
    const std::optional<double> here = a.letter(letter), there = b.letter(letter);
    if (here.has_value() == there.has_value() && (!here || std::abs(*here - *there) <= tolerance)) continue;
    const ShownNumbers shown = shownNumbers(here.value_or(0), there.value_or(0));
    const auto add = [&](std::string& out, bool given, const std::string& value) {
      out += (out.empty() ? "" : " ") + (given ? letter + value : fmt::format("no {}", letter));
    };
    add(one, here.has_value(), shown.source);
    add(other, there.has_value(), shown.target);
  }
  return one.empty() ? "" : one + " against " + other;
}

// "P9811 H0.5 Q3".
std::string callText(const Measure& measure) {
  if (measure.program == 0) return "no call";
  std::string out = fmt::format("P{}", measure.program);
  for (char letter = 'A'; letter <= 'Z'; ++letter)
    if (const std::optional<double> value = measure.letter(letter))
      out += fmt::format(" {}{}", letter, numberText(*value));
  return out;
}

// Of a call whose work is not known all that the macro can see is the same.
void unstated(const ComparedPair& pair, const Measure& a, const Measure& b) {
  const bool same = a.unstated == b.unstated && a.program == b.program &&
                    std::equal(a.locals.begin(), a.locals.end(), b.locals.begin(), b.locals.end(),
                               [&](const auto& one, const auto& other) {
                                 return one.first == other.first &&
                                        std::abs(one.second - other.second) <= pair.rules.tolerance;
                               });
  if (same) return;
  const std::string letters = a.program == b.program ? lettersText(a, b, pair.rules.tolerance) : "";
  pair.add(Aspect::Nominal,
           letters.empty() ? callText(a) + " against " + callText(b)
                           : fmt::format("P{} called with {}", a.program, letters),
           a.range, b.range);
}

std::string directionText(const sim::Point3& direction) {
  const double along[] = {direction.x, direction.y, direction.z};
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (std::abs(along[axis]) > 1 - 1e-9)
      return fmt::format("{}{}", "XYZ"[axis], along[axis] < 0 ? '-' : '+');
  return fmt::format("the direction X{} Y{} Z{}", fixedText(direction.x, kShown),
                     fixedText(direction.y, kShown), fixedText(direction.z, kShown));
}

// Where the call of the same macro is another one, its letters say why.
std::string withLetters(std::string text, const Measure& a, const Measure& b, double tolerance) {
  if (a.program == 0 || a.program != b.program) return text;
  const std::string letters = lettersText(a, b, tolerance);
  return letters.empty() ? text : fmt::format("{} (P{} with {})", text, a.program, letters);
}

// A travel that goes on beyond the surface finds it.
bool leadsBeyond(const Touch& travel, const Touch& surface, double tolerance) {
  const sim::Point3 beyond = travel.point - surface.point;
  const double along = beyond.dot(surface.direction);
  return along >= -tolerance && near(beyond, surface.direction * along, tolerance);
}

void nominal(const ComparedPair& pair, const Measure& a, const Measure& b) {
  if (a.nominal.size() != b.nominal.size()) {
    const auto surfaces = [](std::size_t count) {
      return count == 1 ? std::string("1 surface") : fmt::format("{} surfaces", count);
    };
    pair.add(Aspect::Nominal,
             withLetters(fmt::format("{} against {}", surfaces(a.nominal.size()), b.nominal.size()), a, b,
                         pair.rules.tolerance),
             a.range, b.range);
    return;
  }
  for (std::size_t i = 0; i < a.nominal.size(); ++i) {
    const Touch &one = a.nominal[i], &other = b.nominal[i];
    const bool samePoint = near(one.point, other.point, pair.rules.tolerance) ||
                           (b.travels && !a.travels && leadsBeyond(other, one, pair.rules.tolerance));
    constexpr double kSameWay = 1e-6; // of an angle that a control computes with eight digits
    const bool sameWay = near(one.direction, other.direction, kSameWay);
    if (samePoint && sameWay) continue;
    std::string text =
        samePoint
            ? fmt::format("the surface at {} is searched along {} against {}", textOf(one.point),
                          directionText(one.direction), directionText(other.direction))
            : fmt::format("the surface is expected at {} against {}", textOf(one.point), textOf(other.point));
    if (!samePoint && !sameWay)
      text += fmt::format(", searched along {} against {}", directionText(one.direction),
                          directionText(other.direction));
    pair.add(Aspect::Nominal, withLetters(std::move(text), a, b, pair.rules.tolerance), a.range, b.range);
    return;
  }
}

// Given to a macro whose source has none of it: a limit that stops it, what it raises no alarm for, what it
// sets or prints besides. A limit of the source a translation may look at by itself.
bool changesWork(stdlib::ArgumentRole role, double value) {
  using stdlib::ArgumentRole;
  switch (role) {
  case ArgumentRole::FlagOnly: return value == 1;
  case ArgumentRole::Tool:
  case ArgumentRole::SpareTool:
  case ArgumentRole::Experience:
  case ArgumentRole::SizeTolerance:
  case ArgumentRole::PositionTolerance:
  case ArgumentRole::AngleTolerance:
  case ArgumentRole::UpperLimit:
  case ArgumentRole::NullBand:
  case ArgumentRole::Feedback:
  case ArgumentRole::Print: return true;
  default: return false;
  }
}

// How far a travel of the target goes on beyond where the source expects the surface; nothing: it is none.
std::optional<double> beyondSurface(const Measure& a, const Measure& b) {
  if (a.travels || !b.travels || a.nominal.size() != 1 || b.nominal.size() != 1) return std::nullopt;
  return (b.nominal[0].point - a.nominal[0].point).dot(a.nominal[0].direction);
}

// How a measure is made; of another vendor's macro how far it searches, where the source says so, how far it
// keeps beside a feature, where both say so, and what it alone is told to do.
void options(const ComparedPair& pair, const Measure& a, const Measure& b) {
  std::set<stdlib::ArgumentRole> roles;
  const auto ofTargetAlone = [&](stdlib::ArgumentRole role) {
    const auto other = b.options.find(role);
    return b.program != 0 && other != b.options.end() && !a.options.contains(role) &&
           changesWork(role, other->second);
  };
  for (const Measure* one : {&a, &b})
    for (const auto& [role, value] : one->options)
      if (pair.rules.sameAlarmNumbers || role == stdlib::ArgumentRole::Overtravel || ofTargetAlone(role) ||
          (role == stdlib::ArgumentRole::Clearance && a.options.contains(role) && b.options.contains(role)))
        roles.insert(role);
  for (const stdlib::ArgumentRole role : roles) {
    const auto one = a.options.find(role), other = b.options.find(role);
    if (one != a.options.end() && other != b.options.end() &&
        std::abs(one->second - other->second) <= pair.rules.results)
      continue;
    if (role == stdlib::ArgumentRole::Overtravel && one == a.options.end() && pair.rules.overtravel &&
        std::abs(other->second - *pair.rules.overtravel) <= kPrintedHalf)
      continue;
    const bool searches = role == stdlib::ArgumentRole::Overtravel && other == b.options.end();
    const std::optional<double> beyond = searches ? beyondSurface(a, b) : std::nullopt;
    // The control rounds the word of the travel, and the place that it begins from.
    if (beyond && std::abs(*beyond - one->second) <= pair.rules.tolerance + 2 * kPrintedHalf) continue;
    if (role == stdlib::ArgumentRole::FlagOnly) {
      const auto says = [](const Measure& of) {
        const auto given = of.options.find(stdlib::ArgumentRole::FlagOnly);
        const bool goesOn = given != of.options.end() && given->second == 1;
        return goesOn ? "M1, which raises no alarm where nothing is found" : "no M1 (an alarm is raised)";
      };
      pair.add(Aspect::Nominal, withLetters(sidesText(says(a), says(b)), a, b, pair.rules.tolerance), a.range,
               b.range);
      return;
    }
    const std::string name(stdlib::roleName(role));
    const double there = other != b.options.end() ? other->second : beyond.value_or(0);
    const ShownNumbers values = shownNumbers(one == a.options.end() ? 0 : one->second, there);
    pair.add(Aspect::Nominal,
             withLetters(one == a.options.end() ? sidesText("no " + name, name + " " + values.target)
                         : other == b.options.end() && !beyond
                             ? sidesText(name + " " + values.source, "none")
                             : fmt::format("{} {} against {}", name, values.source, values.target),
                         a, b, pair.rules.tolerance),
             a.range, b.range);
    return;
  }
}

void contacts(const ComparedPair& pair, const Measure& a, const Measure& b) {
  if (a.contacts.size() != b.contacts.size()) {
    pair.add(Aspect::Contact, fmt::format("{} contacts against {}", a.contacts.size(), b.contacts.size()),
             a.range, b.range);
    return;
  }
  const double equal = isOblique(a) && !pair.rules.sameAlarmNumbers
                           ? std::max(pair.rules.results, kObliqueWord)
                           : pair.rules.results;
  // A macro of another vendor goes to the middle by words of the control's step, and touches across it from
  // there.
  constexpr double kHalfStep = 0.00051;
  const bool round = !pair.rules.sameAlarmNumbers && a.nominal.size() >= 4;
  for (std::size_t i = 0; i < a.contacts.size(); ++i) {
    if (round && near(a.contacts[i].centre, b.contacts[i].centre, kHalfStep)) continue;
    // Where the ball's middle is, is measured: on a narrow bore the point of the wall lies farther beside.
    if (near(a.contacts[i].point, b.contacts[i].point, equal) ||
        near(a.contacts[i].centre, b.contacts[i].centre, equal))
      continue;
    pair.add(
        Aspect::Contact,
        fmt::format("contact at {} against {}", textOf(a.contacts[i].point), textOf(b.contacts[i].point)),
        a.range, b.range);
    return;
  }
}

// What is on where it measures.
void settled(const ComparedPair& pair, const Measure& a, const Measure& b) {
  Surroundings one = a.with, other = b.with;
  one.probe = other.probe;
  one.speed = other.speed;
  const auto flows = [](const Surroundings& with) {
    return with.coolant != sim::Machine::Coolant::NotSwitched && with.coolant != sim::Machine::Coolant::Off;
  };
  // What the caller has left on and the source goes on with, the target may have switched off already.
  if (a.with.spindle != 0 && a.with.spindle == pair.source.before.spindle) one.spindle = other.spindle;
  if (flows(a.with) && a.with.coolant == pair.source.before.coolant) one.coolant = other.coolant;
  const bool switched = b.with.coolant != sim::Machine::Coolant::NotSwitched;
  if (a.with.coolant == sim::Machine::Coolant::NotSwitched || (switched && flows(a.with) == flows(b.with)))
    one.coolant = other.coolant;
  compareState(pair, one, other, " at a measure", a.range, b.range);
}

void datums(const ComparedPair& pair, const Measure& a, const Measure& b) {
  const SourceRange where = b.datumRange.hasPlace() ? b.datumRange : b.range;
  const auto along = [](const Measure& measure, std::uint32_t axis) {
    return std::find_if(measure.datums.begin(), measure.datums.end(),
                        [&](const auto& one) { return one.first.second == axis; });
  };
  for (const auto& [key, zero] : a.datums) {
    const auto other = along(b, key.second);
    if (other != b.datums.end() && std::abs(other->second - zero) <= pair.rules.results) continue;
    const std::string what = fmt::format("the zero of G{} along {}", key.first, "XYZ"[key.second]);
    pair.add(Aspect::Offset,
             other == b.datums.end()
                 ? fmt::format("the source sets {} to {} of the machine, the translation does not", what,
                               fixedText(zero, kShown))
                 : fmt::format("{} lies at {} of the machine against {}", what, fixedText(zero, kShown),
                               fixedText(other->second, kShown)),
             a.range, where);
  }
  for (const auto& [key, zero] : b.datums)
    if (along(a, key.second) == a.datums.end())
      pair.add(Aspect::Offset,
               fmt::format("the translation sets a datum along {}, the source does not", "XYZ"[key.second]),
               a.range, where);
}

} // namespace

bool ComparedPair::stopsInMacros() const {
  return !rules.sameAlarmNumbers && source.ending == Ending::Alarm && !source.alarmKind.empty() &&
         ownTextOf(source.alarmKind).empty();
}

std::string_view ownTextOf(std::string_view alarmKind) {
  using stdlib::MacroAlarm;
  static constexpr std::pair<MacroAlarm, std::string_view> kTexts[] = {
      {MacroAlarm::OutOfTolerance, "OUT OF TOLERANCE"},
      {MacroAlarm::OutOfPosition, "OUT OF POSITION"},
      {MacroAlarm::OutOfAngle, "ANGLE OUT OF TOLERANCE"},
      {MacroAlarm::UpperLimit, "UPPER LIMIT"}};
  for (const auto& [kind, text] : kTexts)
    if (stdlib::macroAlarmName(kind) == alarmKind) return text;
  return "";
}

SourceRange lastMeasure(const Record& record) {
  return record.measures.empty() ? SourceRange{} : record.measures.back().range;
}

std::string sidesText(std::string_view source, std::string_view target) {
  return fmt::format("the source has {}, the translation {}", source, target);
}

ShownNumbers shownNumbers(double source, double target) {
  const auto rounded = [](double value) { return numberText(*parseNumber(fixedText(value, kShown))); };
  ShownNumbers out{rounded(source), rounded(target)};
  if (out.source == out.target) out = {numberText(source), numberText(target)};
  return out;
}

void compareNominal(const ComparedPair& pair, const Measure& a, const Measure& b) {
  nominal(pair, a, b);
  // How far a bare skip move looks for its surface; the contact comes before.
  if (pair.rules.atMeasures || !a.aim || !b.aim || near(*a.aim, *b.aim, pair.rules.tolerance)) return;
  pair.add(Aspect::Nominal,
           fmt::format("the surface is looked for as far as {} against {}", textOf(*a.aim), textOf(*b.aim)),
           a.range, b.range);
}

void compareMeasures(const ComparedPair& pair) {
  const auto& a = pair.source.measures;
  const auto& b = pair.target.measures;
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    if (i >= a.size() || i >= b.size()) {
      pair.add(Aspect::Nominal, fmt::format("{} measures against {}", a.size(), b.size()),
               i < a.size() ? a[i].range : SourceRange{}, i < b.size() ? b[i].range : SourceRange{});
      return;
    }
    if (!a[i].unstated.empty() || !b[i].unstated.empty()) unstated(pair, a[i], b[i]);
    compareNominal(pair, a[i], b[i]);
    if (!pair.rules.atMeasures) options(pair, a[i], b[i]);
    contacts(pair, a[i], b[i]);
    if (pair.rules.atMeasures) settled(pair, a[i], b[i]);
    if (pair.rules.atMeasures) datums(pair, a[i], b[i]);
    if (!pair.stopsInMacros() && !near(a[i].end, b[i].end, pair.rules.tolerance))
      pair.add(
          Aspect::Path,
          fmt::format("the measure leaves the probe at {} against {}", textOf(a[i].end), textOf(b[i].end)),
          a[i].range, b[i].range);
  }
}

} // namespace dotek::verify
