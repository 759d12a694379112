// Arcs, roughing cycles, threads: what follows from where the tool is in the order of the text.
#include "frontend/mikroprog/Check.h"
#include "frontend/mikroprog/Motion.h"
#include "support/Decimal.h"

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

} // namespace

Findings impossibleArcs(const Reading& reading) {
  Findings out;
  walkMotion(reading, [&](const Block& block, const MotionState& state) {
    const Word* word = block.line->find('R');
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
