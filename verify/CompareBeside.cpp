// What two runs do beside moving and measuring.
#include "support/Ascii.h"
#include "support/Decimal.h"
#include "verify/CompareLeft.h"
#include "verify/CompareParts.h"
#include "verify/PathPieces.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <set>
#include <utility>

namespace dotek::verify {

namespace {

std::string_view switchName(Switch state) {
  switch (state) {
  case Switch::NotSwitched: return "not switched";
  case Switch::Off: return "off";
  case Switch::On: return "on";
  }
  return "";
}

std::string_view faultName(sim::Outcome outcome) {
  switch (outcome) {
  case sim::Outcome::Contact: return "a contact";
  case sim::Outcome::EarlyContact: return "a contact that no measuring move makes";
  case sim::Outcome::Miss: return "no contact";
  case sim::Outcome::NotArmed: return "a touch with the probe off";
  case sim::Outcome::NoSignal: return "a touch without a signal";
  case sim::Outcome::Overtravel: return "a stylus that is pushed too far";
  case sim::Outcome::StemCollision: return "a collision of the stem";
  case sim::Outcome::BodyCollision: return "a collision of the probe's body";
  case sim::Outcome::RapidIntoPart: return "a rapid into the part";
  case sim::Outcome::StartInside: return "a start inside the part";
  case sim::Outcome::OutsideTravel: return "a move out of the machine's travel";
  case sim::Outcome::SetterMiss: return "no contact with the tool setter";
  case sim::Outcome::SetterHit: return "a collision with the tool setter";
  case sim::Outcome::NotModelled: return "a rotary or second axis off zero";
  }
  return "";
}

std::string deedText(const Deed& deed) {
  switch (deed.kind) {
  case Deed::Kind::Subprogram: return fmt::format("M98 P{}", numberText(deed.value));
  case Deed::Kind::ToolChange: return fmt::format("a change to tool {}", numberText(deed.value));
  case Deed::Kind::Auxiliary: return "M" + numberText(deed.value);
  case Deed::Kind::Stop: return deed.text.empty() ? "a stop" : fmt::format("a stop ({})", deed.text);
  case Deed::Kind::Dwell: return fmt::format("a dwell of {} s", numberText(deed.value));
  }
  return "";
}

bool isLetter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

// Whether `shown` is what a control shows of `text`, signs aside: of a letter that it does not have up to two
// stand for it. `most`: characters that it shows.
bool shows(std::string_view text, std::string_view shown, std::size_t most) {
  const auto isAscii = [](char c) { return static_cast<unsigned char>(c) < 0x80; };
  std::set<std::pair<std::size_t, std::size_t>> open = {{0, 0}}; // how far both have been read
  while (!open.empty()) {
    auto [at, in] = open.extract(open.begin()).value();
    while (at < text.size() && isAscii(text[at]) && !isLetter(text[at]))
      ++at;
    while (in < shown.size() && !isLetter(shown[in]))
      ++in;
    if (at == text.size() && in == shown.size()) return true;
    if (at == text.size()) continue;
    if (in == shown.size()) {
      // Cut after a whole word.
      const bool begins = at == 0 || !isLetter(text[at - 1]);
      if (begins && std::min(text.find(' ', at), text.size()) > most) return true;
    }
    if (isAscii(text[at])) {
      if (in < shown.size() && text[at] == shown[in]) open.emplace(at + 1, in + 1);
      continue;
    }
    std::size_t next = at + 1; // a letter of more bytes
    while (next < text.size() && (static_cast<unsigned char>(text[next]) & 0xC0) == 0x80)
      ++next;
    for (std::size_t letters = 0; letters <= 2 && in + letters <= shown.size(); ++letters)
      open.emplace(next, in + letters);
  }
  return false;
}

// A program that is written says it in capitals without the signs that the control does not have, and cuts
// what the operator reads to what it shows, after a whole word.
bool sameStop(const Deed& source, const Deed& target, std::size_t most) {
  constexpr std::size_t kLongest = 200; // of texts whose letters are tried
  const std::string text = upperCase(source.text), shown = upperCase(target.text);
  if (source.kind != Deed::Kind::Stop || target.kind != Deed::Kind::Stop || shown.empty()) return false;
  if (text == shown) return true;
  if (text.size() > kLongest) return text.starts_with(shown);
  const bool says =
      std::any_of(text.begin(), text.end(), [](char c) { return isLetter(c) || (c & 0x80) != 0; });
  return says ? shows(text, shown, most) : shown == "STOP";
}

} // namespace

void compareState(const ComparedPair& pair, const Surroundings& a, const Surroundings& b,
                  std::string_view when, SourceRange source, SourceRange target) {
  if (a == b) return;
  std::string text;
  const auto tell = [&](std::string_view what, std::string_view one, std::string_view other) {
    if (one != other) text += fmt::format("{}{} {} against {}", text.empty() ? "" : ", ", what, one, other);
  };
  static constexpr std::string_view kSpindle[] = {"off", "clockwise", "counterclockwise"};
  static constexpr std::string_view kCoolant[] = {"not switched", "off", "flood", "mist"};
  tell("probe", switchName(a.probe), switchName(b.probe));
  tell("spindle", kSpindle[a.spindle], kSpindle[b.spindle]);
  tell("coolant", kCoolant[static_cast<std::size_t>(a.coolant)],
       kCoolant[static_cast<std::size_t>(b.coolant)]);
  tell("speed", "S" + numberText(a.speed), "S" + numberText(b.speed));
  pair.add(Aspect::State, text + std::string(when), source, target);
}

// An operator who reads the stop may keep what is written after it from being written.
void writtenBefore(const ComparedPair& pair, const Deed& a, const Deed& b, const std::string& stop) {
  for (const auto* one : {&a.written, &b.written})
    for (const std::string& name : *one) {
      const bool ofSource = one == &a.written;
      if ((ofSource ? b : a).written.contains(name) || !pair.source.offsetWrites.contains(name) ||
          !pair.target.offsetWrites.contains(name))
        continue;
      return pair.add(Aspect::State,
                      fmt::format("{} is written {} {}, in the source {} it", name,
                                  ofSource ? "after" : "before", stop, ofSource ? "before" : "after"),
                      a.range, b.range);
    }
}

// Tools, M codes, stops: which, in which order, where, and with what on.
void compareDeeds(const ComparedPair& pair) {
  const std::vector<Deed>&a = pair.source.deeds, &b = pair.target.deeds;
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    const std::string one = i < a.size() ? deedText(a[i]) : "nothing";
    const std::string other = i < b.size() ? deedText(b[i]) : "nothing";
    const SourceRange here = i < a.size() ? a[i].range : SourceRange{};
    const SourceRange there = i < b.size() ? b[i].range : SourceRange{};
    const bool both = i < a.size() && i < b.size();
    if (one != other && !(both && sameStop(a[i], b[i], pair.rules.shownText))) {
      pair.add(Aspect::State, sidesText(one, other), here, there);
      return;
    }
    // A stop by an M code has no number.
    if (both && a[i].kind == Deed::Kind::Stop && a[i].value != 0 && b[i].value != 0 &&
        a[i].value != b[i].value) {
      pair.add(Aspect::State,
               fmt::format("{} with the number {} against {}", one, numberText(a[i].value),
                           numberText(b[i].value)),
               here, there);
      return;
    }
    if (a[i].measures != b[i].measures) {
      pair.add(Aspect::State,
               fmt::format("{} after {} measures against {}", one, a[i].measures, b[i].measures), here,
               there);
      return;
    }
    if (!near(a[i].at, b[i].at, pair.rules.tolerance)) {
      pair.add(Aspect::State, fmt::format("{} at {} against {}", one, textOf(a[i].at), textOf(b[i].at)), here,
               there);
      return;
    }
    compareState(pair, a[i].with, b[i].with, " at " + one, here, there);
    if (a[i].kind == Deed::Kind::Stop && b[i].kind == Deed::Kind::Stop) writtenBefore(pair, a[i], b[i], one);
  }
}

// What the probe meets besides its contacts, also within calls. After a fault of the source the
// case is undecided anyway.
void compareFaults(const ComparedPair& pair) {
  if (!pair.source.events.empty() || pair.target.events.empty()) return;
  const auto& [event, where] = pair.target.events.front();
  pair.add(Aspect::Contact,
           fmt::format("the translation meets what the source does not: {} at {}", faultName(event.outcome),
                       textOf(event.centre)),
           lastMeasure(pair.source), where);
}

namespace {

// Of a tool's offset: whether it is the geometry, and its number.
std::optional<std::pair<bool, std::uint32_t>> toolOffsetOf(const stdlib::Control& control,
                                                           std::uint32_t variable) {
  const stdlib::SystemVariables& v = control.variables;
  for (const auto& [base, geometry] : {std::pair(v.toolGeometry, true), std::pair(v.toolGeometryToo, true),
                                       std::pair(v.toolWear, false), std::pair(v.toolWearToo, false)})
    if (base && variable > static_cast<std::uint32_t>(*base) &&
        variable <= static_cast<std::uint32_t>(*base + v.toolCount))
      return std::pair(geometry, variable - static_cast<std::uint32_t>(*base));
  return std::nullopt;
}

// One thing in both: its variable may have another number on the other control.
bool isSameVariable(const CompareRules& rules, std::uint32_t source, std::uint32_t target) {
  if (source == target) return true;
  if (rules.sourceControl == nullptr || rules.targetControl == nullptr) return false;
  const auto one = toolOffsetOf(*rules.sourceControl, source);
  return one && one == toolOffsetOf(*rules.targetControl, target);
}

} // namespace

// The control reads ahead: without a block that waits it reads an earlier position, or moves what is still
// to be moved to.
void compareEarlyUses(const ComparedPair& pair) {
  if (!pair.rules.waits) return;
  for (const EarlyUse& use : pair.target.early) {
    const bool known =
        std::any_of(pair.source.early.begin(), pair.source.early.end(), [&](const EarlyUse& one) {
          return one.write == use.write &&
                 (pair.rules.samePlace ? pair.rules.samePlace(one.range, use.range)
                                       : isSameVariable(pair.rules, one.number, use.number));
        });
    if (known) continue;
    pair.add(use.write ? Aspect::Offset : Aspect::Variable,
             fmt::format("the translation {} #{} before the motion before it has ended, the source does not",
                         use.write ? "writes" : "reads", use.number),
             {}, use.range);
  }
}

// What a macro that switches the probe does on its way is in no source: it is called under the same modes.
// Whoever switches it, the spindle turns or rests there as in the source.
void compareSwitches(const ComparedPair& pair, bool sameMacros) {
  const std::vector<SwitchCall>&a = pair.source.switches, &b = pair.target.switches;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    const bool sameCall = sameMacros && a[i].program == b[i].program;
    if (!sameCall && a.size() != b.size()) return;
    const bool macro = a[i].program != 0;
    for (std::size_t k = 0; sameCall && macro && k < a[i].modes.size(); ++k)
      if (a[i].modes[k] != b[i].modes[k] && a[i].modes[k] != 0 && b[i].modes[k] != 0)
        return pair.add(Aspect::Modal,
                        fmt::format("P{} called under G{} against G{}", a[i].program,
                                    numberText(a[i].modes[k] / 10.0), numberText(b[i].modes[k] / 10.0)),
                        a[i].range, b[i].range);
    Surroundings target = b[i].with;
    if (!sameCall) {
      const std::uint8_t spindle = target.spindle;
      target = a[i].with;
      target.spindle = spindle;
    }
    compareState(pair, a[i].with, target, " where the probe is switched", a[i].range, b[i].range);
  }
}

} // namespace dotek::verify
