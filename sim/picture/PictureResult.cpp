#include "sim/picture/PictureResult.h"

#include "sim/picture/PictureRegion.h"
#include "support/Decimal.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

namespace dotek::sim {
namespace {

std::uint64_t count(const RunFacts& facts, std::initializer_list<Outcome> outcomes) {
  std::uint64_t out = 0;
  for (const Outcome outcome : outcomes)
    out += facts.events[static_cast<std::size_t>(outcome)];
  return out;
}
std::uint64_t collisionsOf(const RunFacts& facts) {
  return count(facts, {Outcome::RapidIntoPart, Outcome::StemCollision, Outcome::BodyCollision,
                       Outcome::Overtravel, Outcome::NotArmed, Outcome::SetterHit, Outcome::StartInside});
}

std::string plural(std::uint64_t number, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", number, number == 1 ? one : many);
}

std::string alarmWord(const RunEnd& end) {
  return end.number == 0 ? "ALARM" : fmt::format("ALARM {}", end.number);
}

// Word, text and verdict of the end alone.
PictureResult endOf(const RunFacts& facts) {
  PictureResult out;
  out.text = facts.end.text;
  switch (facts.end.ending) {
  case Ending::ProgramEnd:
  case Ending::TextEnd:
    out.word = "PASS";
    out.text = fmt::format("the {} came to its end", facts.subject);
    return out;
  case Ending::Running:
    if (facts.unread.empty()) {
      out.word = "PASS";
      out.text = fmt::format("the {} came to its end", facts.subject);
      return out;
    }
    out.verdict = Verdict::Fail;
    out.word = "NOT READ";
    out.text = facts.unread;
    return out;
  case Ending::Alarm:
    out.verdict = Verdict::Fail;
    out.word = alarmWord(facts.end);
    if (out.text.empty()) out.text = "the alarm has no text";
    return out;
  case Ending::Limit:
    out.verdict = Verdict::Doubt;
    out.word = "STOPPED";
    return out;
  case Ending::Inconclusive:
  case Ending::Return:
  case Ending::Call: break;
  }
  out.verdict = Verdict::Doubt;
  out.word = "INCONCLUSIVE";
  return out;
}

std::string placeOf(const PictureBlock& block) {
  return block.program.empty() || block.place.empty() ? block.program + block.place
                                                      : block.program + ", " + block.place;
}

// Of the ball's centre (without a probe: of the gauge line) after a move.
std::string positionAt(const Picture& picture, const Point3& centre, std::size_t move) {
  const auto isFar = [](double value) { return std::abs(value) > kDrawn; }; // not: no number
  const bool isNowhere = std::isnan(centre.x) && std::isnan(centre.y) && std::isnan(centre.z);
  if (isNowhere || isFar(centre.x) || isFar(centre.y) || isFar(centre.z)) return "";
  const Point3 gauge = gaugeAt(picture, centre, move);
  const ToolPoint point = toolPointAt(picture, move);
  // Both frames by name: work coordinates are of the one or the other, as a length is in force.
  std::string machine = "machine " + pointText(gauge - Point3{0, 0, point.below}, picture.decimals);
  if (point.below != 0) {
    machine += fmt::format(" ({})", point.name);
    if (std::isfinite(gauge.z))
      machine += fmt::format(", Z{} (gauge line)", fixedText(gauge.z, picture.decimals));
  }
  machine += "; mm";
  const std::optional<Point3> work = workAt(picture, centre, move);
  if (!work) return machine;
  return fmt::format("{} {}; {}", picture.frames[picture.moves[move].frame].name,
                     pointText(*work, picture.decimals), machine);
}

std::vector<PictureError>::const_iterator lastMiss(const std::vector<PictureError>& errors) {
  const auto last = std::find_if(errors.rbegin(), errors.rend(), isMiss);
  return last == errors.rend() ? errors.end() : std::prev(last.base());
}

} // namespace

std::string pointText(const Point3& p, int decimals) {
  const auto number = [&](double value) {
    return std::isfinite(value) ? fixedText(value, decimals) : std::string("?");
  };
  return fmt::format("X{} Y{} Z{}", number(p.x), number(p.y), number(p.z));
}

std::string endingText(const RunFacts& facts) {
  const PictureResult end = endOf(facts);
  if (end.word == "PASS") return "";
  return fmt::format("{}: {}", end.word, end.text);
}

bool isSaidByTravel(const RunFacts& facts) {
  return count(facts, {Outcome::OutsideTravel}) > 0 && facts.end.text.ends_with("OVER-TRAVEL");
}

PictureResult resultOf(const Picture& picture, const RunFacts& facts) {
  PictureResult out = endOf(facts);
  const bool ended = out.word == "PASS";
  const std::uint64_t collisions = collisionsOf(facts);
  const std::uint64_t travel = count(facts, {Outcome::OutsideTravel});
  const std::uint64_t faults = count(facts, {Outcome::EarlyContact, Outcome::NoSignal});
  const std::uint64_t misses = count(facts, {Outcome::Miss, Outcome::SetterMiss});
  const bool crashed = collisions + travel + faults > 0;
  const auto named = std::find_if(picture.errors.begin(), picture.errors.end(), [&](const PictureError& e) {
    return !e.fault && e.kind == (crashed ? PictureError::Kind::Error : PictureError::Kind::UsedMiss);
  });
  const bool measuredNothing = !crashed && facts.usedMisses > 0 && out.verdict != Verdict::Fail;
  // One that fails the run before one that leaves a doubt.
  const RunFault* fault = nullptr;
  for (const RunFault& one : facts.faults)
    if (fault == nullptr || (fault->verdict != Verdict::Fail && one.verdict == Verdict::Fail)) fault = &one;
  if (fault != nullptr && (out.verdict == Verdict::Fail || (!ended && fault->verdict != Verdict::Fail)))
    fault = nullptr;
  if (crashed) {
    const std::string then =
        ended || isSaidByTravel(facts) ? "" : fmt::format("; then {}", endingText(facts));
    out.verdict = Verdict::Fail;
    out.word = collisions > 0 ? "COLLISION" : travel > 0 ? "OVER-TRAVEL" : "PROBE FAULT";
    // What happened; the list of errors has the rest of the sentence, what to do.
    out.text = named == picture.errors.end() ? "the picture ends before it" : named->text;
    out.text = out.text.substr(0, out.text.find(';')) + then;
  } else if (measuredNothing) {
    const std::string then = ended ? "" : fmt::format("; then {}", endingText(facts));
    out.verdict = Verdict::Fail;
    out.word = "FAIL: MEASURED WITHOUT A TOUCH";
    out.text = fmt::format("{} nothing, and the {} took {} for the surface{}",
                           facts.usedMisses == 1 ? std::string("a measuring move met")
                                                 : fmt::format("{} measuring moves met", facts.usedMisses),
                           facts.subject, facts.usedMisses == 1 ? "its end" : "their ends", then);
  } else if (fault != nullptr) {
    out.verdict = fault->verdict;
    out.word = fault->word;
    out.text = fault->text + (ended ? "" : fmt::format("; then {}", endingText(facts)));
  } else if (ended && misses > 0) {
    out.verdict = Verdict::Doubt;
    out.word = "PASS, WITH MISSES";
    out.text = fmt::format("the {} came to its end, and {} nothing: right for a move to a position, wrong "
                           "for one that measures",
                           facts.subject,
                           misses == 1 ? "a skip move met" : fmt::format("{} skip moves met", misses));
  }
  const bool atSetter = facts.events[static_cast<std::size_t>(Outcome::SetterMiss)] > 0;
  if (ended && !crashed && !measuredNothing && !picture.part && picture.contacts.empty() && !atSetter)
    out.text += "; no part was given, so nothing could be touched";

  if (out.verdict == Verdict::Pass && facts.warnings > 0)
    out.text += fmt::format("; {}, listed below", plural(facts.warnings, "warning", "warnings"));

  const bool faulty = !crashed && !measuredNothing && fault != nullptr;
  // Nothing worse has happened than its last miss.
  const bool missed = !crashed && !measuredNothing && !faulty && ended && misses > 0;
  const auto shown = faulty   ? std::find_if(picture.errors.begin(), picture.errors.end(),
                                             [&](const PictureError& e) { return e.fault; })
                     : missed ? lastMiss(picture.errors)
                              : named;
  if ((crashed || measuredNothing || faulty || missed) && shown != picture.errors.end()) {
    const PictureError& error = *shown;
    out.error = static_cast<std::size_t>(shown - picture.errors.begin());
    if (const std::optional<std::size_t> block = blockOf(picture, error)) {
      out.place = placeOf(picture.blocks[*block]);
      out.block = picture.blocks[*block].text;
    }
    out.position = positionAt(picture, error.at, error.move);
  } else if (!ended && !measuredNothing && !faulty) {
    out.place = facts.callers.empty() || facts.callers == facts.block.program
                    ? placeOf(facts.block)
                    : facts.callers + (facts.block.place.empty() ? "" : "; " + facts.block.place);
    out.block = facts.block.text;
    if (!picture.moves.empty())
      out.position = positionAt(picture, picture.moves.back().to, picture.moves.size() - 1);
  }
  if (collisions > 0 || picture.part) out.counts.push_back(plural(collisions, "collision", "collisions"));
  if (travel > 0) out.counts.push_back(plural(travel, "over-travel", "over-travels"));
  if (faults > 0) out.counts.push_back(plural(faults, "probe fault", "probe faults"));
  if (picture.part || misses > 0) out.counts.push_back(plural(misses, "miss", "misses"));
  out.counts.push_back(plural(picture.contacts.size(), "contact", "contacts"));
  out.counts.push_back(plural(moveCount(picture), "move", "moves"));
  if (facts.warnings > 0) out.counts.push_back(plural(facts.warnings, "warning", "warnings"));
  return out;
}

} // namespace dotek::sim
