// Arcs, roughing cycles, threads: what follows from where the tool is in the order of the text.
#include "frontend/mikroprog/Check.h"
#include "frontend/mikroprog/Motion.h"
#include "support/Decimal.h"

#include <algorithm>
#include <cmath>

namespace dotek::frontend::mikroprog {

namespace {

constexpr double kRounding = 0.005; // mm, of words with three decimals; also what an arc may be off

std::string thousandths(double value) {
  return numberText(std::round(std::abs(value) * 1000) / 1000);
}

// Why the arc cannot be; "" where it can, or where its ends are not known.
std::string whyNoArc(const Block& block, const MotionState& state, double radius,
                     const stdlib::MikroprogControl& control) {
  if (radius <= 0) return "a radius has no sign and is not 0";
  if (state.plane.empty()) return "";
  const auto first = state.travel(*block.line, state.plane[0], control);
  const auto second = state.travel(*block.line, state.plane[1], control);
  if (!first || !second) return "";
  const double chord = std::hypot(*first, *second);
  if (chord == 0) return "the arc ends where it begins; a full circle needs its centre";
  if (chord > 2 * radius + kRounding)
    return fmt::format("its ends lie {} mm apart, more than the diameter", thousandths(chord));
  return "";
}

// How far the centre at (i, k) from the start is off from lying equally far from both ends, mm.
double offBy(double first, double second, double i, double k) {
  return std::abs(std::hypot(i, k) - std::hypot(first - i, second - k));
}

// Of an arc with I and K: nothing where it fits in a reading of them, or where its ends are not known.
// Whether they count from the start or are coordinates is not known (Q3).
std::optional<double> offCentre(const Block& block, const MotionState& state,
                                const stdlib::MikroprogControl& control) {
  if (state.plane != "XZ" || !state.at[0] || !state.at[2]) return std::nullopt;
  const auto x = state.travel(*block.line, 'X', control), z = state.travel(*block.line, 'Z', control);
  const Word* const i = block.line->find('I');
  const Word* const k = block.line->find('K');
  if ((i != nullptr && !i->value.number) || (k != nullptr && !k->value.number)) return std::nullopt;
  if (i == nullptr && k == nullptr) return std::nullopt;
  if ((!x && block.line->find('X') != nullptr) || (!z && block.line->find('Z') != nullptr))
    return std::nullopt;
  const double dx = x.value_or(0), dz = z.value_or(0);
  const double di = i != nullptr ? *i->value.number : 0, dk = k != nullptr ? *k->value.number : 0;
  double least = offBy(dx, dz, di, dk);
  if (i != nullptr && k != nullptr) {
    least = std::min(least, offBy(dx, dz, di - *state.at[0], dk - *state.at[2]));
    least = std::min(least, offBy(dx, dz, di / 2 - *state.at[0], dk - *state.at[2]));
  }
  return least;
}

} // namespace

Findings impossibleArcs(const Reading& reading) {
  Findings out;
  walkMotion(reading, [&](const Block& block, const MotionState& state) {
    const Word* word = block.line->find('R');
    if (onlyMoves(block) && state.motion.starts_with("arc-") && word == nullptr) {
      const auto off = offCentre(block, state, reading.control);
      if (off && *off > kRounding + 1e-9)
        out.push_back(
            {block.line->range,
             fmt::format("the centre by I and K lies {} mm farther from one end of the arc than from "
                         "the other, in every reading of them (Q3); the control allows 0.005 mm",
                         thousandths(*off))});
      return;
    }
    if (!onlyMoves(block) || !state.motion.starts_with("arc-") || word == nullptr || !word->value.number)
      return;
    const std::string why = whyNoArc(block, state, *word->value.number, reading.control);
    if (!why.empty())
      out.push_back({word->range, fmt::format("`{}`: {}; write the radius of an arc of 180 degrees at most, "
                                              "or the centre with I and K",
                                              reading.text(word->range), why)});
  });
  return out;
}

Findings unequalQuarters(const Reading& reading) {
  Findings out;
  walkMotion(reading, [&](const Block& block, const MotionState& state) {
    for (const Code& code : block.codes) {
      if (code.function == nullptr || (code.function->code() != "G62" && code.function->code() != "G63"))
        continue;
      const auto x = state.travel(*block.line, 'X', reading.control);
      const auto z = state.travel(*block.line, 'Z', reading.control);
      if (!x || !z || std::abs(std::abs(*x) - std::abs(*z)) <= kRounding) continue;
      out.push_back(
          {block.line->range,
           fmt::format("`{}` roughs a quarter of a circle, and the tool travels {} mm along X, {} mm "
                       "along Z; both are the radius",
                       code.function->code(), thousandths(*x), thousandths(*z))});
    }
  });
  return out;
}

Findings feedUnits(const Reading& reading) {
  constexpr double kMostPerRevolution = 5, kLeastPerMinute = 1;
  Findings out;
  std::optional<double> told; // this F is reported
  walkMotion(reading, [&](const Block& block, const MotionState& state) {
    const Word* const word = block.line->find('F');
    if (word != nullptr) told.reset();
    if (!isCut(block, state, reading.control) || !state.perRevolution || !state.feedValue || told) return;
    const double feed = *state.feedValue;
    const bool wrong = *state.perRevolution ? feed > kMostPerRevolution : feed > 0 && feed < kLeastPerMinute;
    if (!wrong) return;
    told = feed;
    out.push_back(
        {word != nullptr ? word->range : block.line->range,
         *state.perRevolution
             ? fmt::format("F{} is {} mm in each revolution under G95; write G94, or a feed of at "
                           "most {} mm",
                           numberText(feed), numberText(feed), numberText(kMostPerRevolution))
             : fmt::format("F{} is {} mm in a minute under G94; write G95, or a feed of at least {} "
                           "mm",
                           numberText(feed), numberText(feed), numberText(kLeastPerMinute))});
  });
  return out;
}

Findings threadsWithoutFeed(const Reading& reading) {
  Findings out;
  walkMotion(reading, [&](const Block& block, const MotionState& state) {
    for (const Code& code : block.codes)
      if (code.function != nullptr && code.function->code() == "G78" && !state.feed)
        out.push_back({block.line->range, "no feed was given before this G78, and it has no F; its infeed "
                                          "needs one"});
  });
  return out;
}

} // namespace dotek::frontend::mikroprog
