// Moves, arcs, threads and single cycles of a lathe.
#include "backends/mikroprog/ProgramWriter.h"

#include "backends/common/PlainText.h"
#include "ir/Match.h"
#include "support/Decimal.h"
#include "support/Source.h"
#include "support/messages/Mikroprog.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace dotek::backends::mikroprog {

using stdlib::Function;

namespace {

constexpr double kOffArc = 0.005; // mm that the end may lie off an arc
constexpr double kFlatArc = 170;  // degrees up to which a rounded radius changes nothing that counts

} // namespace

bool ProgramWriter::hasAxes() const {
  for (const char letter : std::string_view("XYZUVWABC"))
    if (find(letter) != nullptr) return true;
  return false;
}

void ProgramWriter::dwell(SourceRange range, Parts& parts) {
  std::optional<double> seconds;
  int given = 0;
  for (const char letter : std::string_view("PXU"))
    if (const ir::Word* word = find(letter)) {
      ++given;
      const double* const value = ir::constantValue(word->value);
      const bool bare = ir::numberWithoutPoint(word->value) != nullptr;
      taken_ += letter;
      if (value == nullptr) return void(number(*word));
      seconds = letter == 'P' || (bare && source_.countsIncrements(letter)) ? *value / 1000 : *value;
    }
  if (given != 1) return cannot(range, "a dwell takes one of P, X and U", "write P with milliseconds");
  if (*seconds < 0) return cannot(range, "a time below 0", "write the seconds");
  parts.words.push_back("G4 E" + shown(*seconds));
}

void ProgramWriter::reference(SourceRange range, Parts& parts) {
  std::size_t count = 0;
  bool straight = true;
  for (const char letter : control_.axes) {
    const char increment = source_.turning ? source_.turning->incrementOf(letter) : letter;
    if (find(increment) == nullptr) continue;
    ++count;
    const auto value = take(increment);
    straight = straight && value == 0.0 && (source_.turning || state_.incremental.value_or(false));
  }
  if (count != control_.axes.size() || !straight)
    return cannot(range,
                  fmt::format("the reference run of this control, G98, takes all of {} and goes by no point",
                              control_.axes),
                  source_.turning ? "write `G28 U0 W0`, or a move to a safe place"
                                  : "write a move to a safe place");
  dropped(range, "the order of the axes on the way to the reference point",
          "G98 has one of its own, and is slow at the switches");
  parts.words.emplace_back("G98");
  state_.at = {};
  parts.moves = true;
}

bool ProgramWriter::target(std::array<std::optional<double>, 3>& to, std::string& named) {
  for (std::size_t i = 0; i < kProgramAxes.size(); ++i) {
    const char axis = kProgramAxes[i];
    const char increment = source_.turning ? source_.turning->incrementOf(axis) : '\0';
    const ir::Word* const absolute = find(axis);
    const ir::Word* const way = increment != 0 ? find(increment) : nullptr;
    const ir::Word* const word = absolute != nullptr ? absolute : way;
    if (word == nullptr) continue;
    if (!control_.hasAxis(axis)) {
      cannot(word->range, fmt::format("this control has no axis {}", axis), "leave the word out");
      return false;
    }
    const auto value = take(word->address);
    if (!value) return false;
    if (absolute != nullptr && way != nullptr) {
      cannot(way->range, fmt::format("{} and {} in one block", axis, increment), "write one of them");
      return false;
    }
    if (way == nullptr && !state_.incremental) {
      cannot(word->range, "whether coordinates are absolute here is not known, after a subprogram or in one",
             "write G90 or G91 before it");
      return false;
    }
    const bool counts = way != nullptr || *state_.incremental;
    if (counts && !state_.at[i]) {
      cannot(word->range,
             fmt::format("where {} is before this way is not known here, and it is written as a coordinate",
                         axis),
             "write an absolute coordinate before it");
      return false;
    }
    to[i] = counts ? *state_.at[i] + *value : *value;
    named += axis;
  }
  return true;
}

std::string ProgramWriter::placeText(const std::array<std::optional<double>, 3>& to, std::string_view named) {
  std::string out;
  for (const char axis : named)
    out += fmt::format(" {}{}", axis, shown(*to[kProgramAxes.find(axis)]));
  return out;
}

void ProgramWriter::feedDropped() {
  if (state_.feed && state_.feedRange.hasPlace() && !diagnostics_.hasErrors())
    dropped(state_.feedRange, "`F" + numberText(*state_.feed) + "`", "no move takes it");
}

bool ProgramWriter::feed(std::optional<double>& out) {
  const ir::Word* const word = find('F');
  if (word == nullptr) return true;
  if (ir::numberWithoutPoint(word->value) != nullptr && state_.perRevolution.value_or(true) &&
      source_.decimal == stdlib::DecimalMode::Increment) {
    cannot(word->range, "what F counts without a point is not known in feed per revolution",
           "write the point");
    return false;
  }
  out = take('F');
  if (out && *out <= 0) {
    cannot(word->range, "a feed is above 0", "write the feed");
    return false;
  }
  if (!out) return false;
  feedDropped();
  state_.feed = out;
  state_.feedRange = word->range;
  state_.feedLost = false;
  return true;
}

bool ProgramWriter::motionKnown(SourceRange range) {
  if (state_.motion == Function::ThreadingCycle)
    cannot(range,
           "it is a pass of the thread cycle that is in force, and how the thread runs out of it is a "
           "parameter of its control",
           "write its passes as G32");
  else if (!state_.refusedMotion.empty())
    cannot(range, fmt::format("it goes on with `{}`, which has no counterpart", state_.refusedMotion),
           "write its moves as blocks");
  else if (!state_.motion)
    cannot(range, "which motion is in force here is not known", "write G0, G1, G2 or G3 in the block");
  return !refused_;
}

void ProgramWriter::move(SourceRange range, Parts& parts) {
  std::optional<double> feed;
  if (!this->feed(feed)) return;
  if (!hasAxes() && find('I') == nullptr && find('J') == nullptr && find('K') == nullptr) return;
  if (!motionKnown(range)) return;
  parts.moves = true;
  std::array<std::optional<double>, 3> to = state_.at;
  std::string named;
  if (!target(to, named)) return;
  const Function motion = *state_.motion;
  const bool feeds = motion != Function::Rapid && motion != Function::Thread;
  if (feeds && state_.feedLost)
    return cannot(range,
                  "which feed is in force here is not known: no move before has it, or the unit has changed",
                  "write F in the block");
  if (std::exchange(state_.inThread, motion == Function::Thread) && motion == Function::Thread)
    return cannot(range,
                  "a pass that goes on from the block before it, and here each G33 waits for the mark of the "
                  "spindle",
                  "write it as one pass");
  const std::string at = placeText(to, named),
                    f = feeds && state_.feed ? " F" + shown(*std::exchange(state_.feed, std::nullopt)) : "";
  switch (motion) {
  case Function::Rapid: parts.words.push_back("G0" + at); break;
  case Function::Feed: parts.words.push_back("G1" + at + f); break;
  case Function::Thread: return thread(range, to, named, feed, parts);
  case Function::TurningCycle:
  case Function::FacingCycle: return singleCycle(range, to, named, f, parts);
  default: {
    const auto radius = arcRadius(range, to);
    if (!radius) return;
    parts.words.push_back(fmt::format("{}{} R{}{}", motion == Function::ArcClockwise ? "G2" : "G3",
                                      placeText(to, arcAxes()), shown(*radius), f));
  }
  }
  state_.at = to;
}

std::string_view ProgramWriter::arcAxes() const {
  return state_.plane == Function::PlaneZX ? "XZ" : state_.plane == Function::PlaneYZ ? "YZ" : "XY";
}

std::optional<double> ProgramWriter::arcRadius(SourceRange range,
                                               const std::array<std::optional<double>, 3>& to) {
  const std::size_t first = state_.plane == Function::PlaneZX ? 2 : state_.plane == Function::PlaneYZ ? 1 : 0;
  const std::size_t second = state_.plane == Function::PlaneZX   ? 0
                             : state_.plane == Function::PlaneYZ ? 2
                                                                 : 1;
  const auto refused = [&](const std::string& what, const std::string& instead) {
    cannot(range, what, instead);
    return std::nullopt;
  };
  if (!state_.plane)
    return refused("which plane is in force here is not known", "write G17, G18 or G19 in the block");
  if (!to[first] || !to[second] || !state_.at[first] || !state_.at[second])
    return refused("where the arc begins or ends is not known here", "write both coordinates before it");
  if (find('R') != nullptr) {
    const auto radius = take('R');
    if (radius && *radius <= 0)
      return refused("an arc is at most half a turn here", "write it as arcs of at most half a turn");
    return radius;
  }
  const auto scale = [&](std::size_t axis) { return axis == 0 && control_.isDiameter('X') ? 0.5 : 1.0; };
  constexpr std::string_view kCentres = "IJK";
  const auto offset = [&](std::size_t axis) {
    return find(kCentres[axis]) != nullptr ? take(kCentres[axis]) : std::optional<double>(0);
  };
  const auto cu = offset(first), cv = offset(second);
  if (!cu || !cv) return std::nullopt;
  const double du = (*to[first] - *state_.at[first]) * scale(first),
               dv = (*to[second] - *state_.at[second]) * scale(second);
  const double radius = std::hypot(*cu, *cv);
  if (std::abs(std::hypot(du - *cu, dv - *cv) - radius) > kOffArc)
    return refused("the end of the arc is not on it", "correct the centre or the end");
  double sweep = std::atan2(dv - *cv, du - *cu) - std::atan2(-*cv, -*cu);
  if (state_.motion == Function::ArcClockwise) sweep = -sweep;
  while (sweep <= kSameNumber)
    sweep += 2 * std::numbers::pi;
  const double degrees = sweep * 180 / std::numbers::pi;
  if (degrees > 180 + 1e-3)
    return refused("an arc is at most half a turn here where it is written with R, and no source says what "
                   "I and K count (Q3)",
                   "write it as arcs of at most half a turn");
  const double rounded = std::round(radius * 1000) / 1000;
  if (std::abs(rounded - radius) > kSameNumber && degrees > kFlatArc)
    return refused("the radius of this arc, near half a turn, has more than three decimals",
                   "write it as two arcs");
  return rounded;
}

void ProgramWriter::thread(SourceRange range, const std::array<std::optional<double>, 3>& to,
                           const std::string& named, std::optional<double> lead, Parts& parts) {
  if (lead) state_.cycleTaper = *lead; // F of a thread stays in force
  if (!(state_.cycleTaper > 0))
    return cannot(range, "the pitch of the thread is not known here", "write F in the block");
  if (named.find('Z') == std::string::npos)
    return cannot(range, "a thread takes Z here", "write its moves along Z");
  if (named.find('X') != std::string::npos &&
      (!state_.at[0] || std::abs(*to[0] - *state_.at[0]) > kSameNumber))
    return cannot(range, "along which axis K counts the pitch of a taper is not stated",
                  "write a thread along Z alone");
  state_.feedRange = {}; // K is written
  parts.words.push_back(fmt::format("G33{} K{}", placeText(to, named), shown(state_.cycleTaper)));
  state_.at = to;
}

void ProgramWriter::singleCycle(SourceRange range, std::array<std::optional<double>, 3> to,
                                const std::string& named, const std::string& feed, Parts& parts) {
  if (const auto taper = take('R')) state_.cycleTaper = *taper;
  for (const std::size_t axis : {std::size_t(0), std::size_t(2)}) {
    const bool given = named.find(kProgramAxes[axis]) != std::string::npos;
    if (given) state_.cycleEnd[axis] = to[axis];
    if (!state_.cycleEnd[axis] || !state_.at[axis])
      return cannot(range, "where the cycle begins or ends is not known here",
                    "write X and Z before it and in it");
    to[axis] = state_.cycleEnd[axis];
  }
  const bool facing = *state_.motion == Function::FacingCycle;
  const std::size_t in = facing ? 2 : 0;
  std::array<std::optional<double>, 3> first = state_.at, out = to;
  first[in] = *to[in] + state_.cycleTaper * (in == 0 && control_.isDiameter('X') ? 2 : 1);
  out[in] = state_.at[in];
  parts.words.push_back("G0" + placeText(first, facing ? "Z" : "X"));
  legs_ = {"G1" + placeText(to, "XZ") + feed, "G1" + placeText(out, facing ? "Z" : "X"),
           "G0" + placeText(state_.at, facing ? "X" : "Z")};
}

} // namespace dotek::backends::mikroprog
