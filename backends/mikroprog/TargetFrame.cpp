#include "backends/mikroprog/TargetFrame.h"

#include "sim/mikroprog/Dialect.h"
#include "stdlib/MacroSet.h"
#include "support/Decimal.h"
#include "verify/Interference.h"
#include "verify/PathPieces.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::targets {

namespace dialect = sim::mikroprog;

namespace {

using sim::PathKind;
using stdlib::MacroAlarm;
using verify::Aspect;
using verify::Difference;
using verify::Mark;
using verify::Piece;

constexpr double kSame = 1e-8; // mm: sums of coordinates that come to the same
constexpr double kDatum = 0.5; // by how much a datum may move what follows, mm
constexpr std::uint32_t kZ = 2;
constexpr double kDown = -0.99; // of a direction along Z

bool isProbeMove(const Piece& piece) {
  return piece.kind == PathKind::Protected || piece.kind == PathKind::Measuring;
}

// The operator may have moved the probe at each stop, so it is asked again.
std::optional<Difference> unasked(const verify::Record& ran, bool height) {
  const Mark* stop = nullptr;
  std::size_t marks = 0; // before the piece
  for (std::size_t i = 0; i < ran.pieces.size(); ++i) {
    const Piece& piece = ran.pieces[i];
    for (; marks < ran.marks.size() && ran.marks[marks].pieces <= i; ++marks)
      if (ran.marks[marks].kind == Mark::Kind::Stop) stop = &ran.marks[marks];
    const bool first = stop == nullptr;
    if (!isProbeMove(piece) && !(height && first)) continue;
    const std::size_t since = first ? 0 : static_cast<std::size_t>(stop - ran.marks.data()) + 1;
    const bool asked =
        std::any_of(ran.questions.begin(), ran.questions.end(), [&](const verify::Question& question) {
          return question.pieces <= i && question.marks >= since;
        });
    if (asked) continue;
    const std::string before = !first ? fmt::format("the probe moves after the stop `{}`", stop->text)
                               : isProbeMove(piece) ? std::string("the first probe move")
                                                    : std::string("the program moves");
    return Difference{Aspect::Ending, "nothing asks for contact before " + before, {}, piece.range};
  }
  return std::nullopt;
}

bool flows(const verify::Surroundings& with) {
  using Coolant = sim::Machine::Coolant;
  return with.coolant != Coolant::NotSwitched && with.coolant != Coolant::Off;
}

// What the source has switched off at its first measure is off before the probe moves.
std::optional<Difference> unsettled(const verify::Record& source, const verify::Record& ran, bool height) {
  if (source.measures.empty()) return std::nullopt;
  const verify::Surroundings& wanted = source.measures.front().with;
  const bool turns = std::any_of(source.pieces.begin(), source.pieces.end(), [&](const Piece& piece) {
    return piece.with.spindle != 0 && piece.with.spindle != source.before.spindle;
  });
  for (const Piece& piece : ran.pieces) {
    if (piece.kind == PathKind::Measuring) break;
    if (piece.kind != PathKind::Protected && !height) continue;
    const bool spindle = wanted.spindle == 0 && !turns && piece.with.spindle != 0;
    const bool coolant = wanted.coolant == sim::Machine::Coolant::Off && flows(piece.with);
    if (!spindle && !coolant) continue;
    return Difference{Aspect::State,
                      fmt::format("{} at a {} move before the first measure",
                                  spindle ? "the spindle turns" : "the coolant flows",
                                  sim::pathKindName(piece.kind)),
                      source.measures.front().range, piece.range};
  }
  return std::nullopt;
}

} // namespace

std::optional<MikroprogTail> takeEnding(verify::Record& ran, const stdlib::MikroprogControl& control) {
  if (ran.ending == verify::Ending::Alarm)
    ran.ending = verify::Ending::Inconclusive; // a fault of the control
  if (!ran.endedAt.hasPlace() && !ran.pieces.empty()) ran.endedAt = ran.pieces.back().range;
  if (ran.ending != verify::Ending::Finished) return std::nullopt;
  for (auto mark = ran.marks.rbegin(); mark != ran.marks.rend(); ++mark) {
    if (mark->kind != Mark::Kind::Stop) continue;
    const bool missing = mark->text == control.notFound;
    if (!missing && mark->text != control.collision) return std::nullopt;
    ran.ending = verify::Ending::Alarm;
    ran.text = mark->text;
    ran.alarmKind = macroAlarmName(missing ? MacroAlarm::ProbeFail : MacroAlarm::PathObstructed);
    ran.endedAt = mark->range;
    MikroprogTail out{ran.end.z, ran.end.z - mark->zero.z, {}};
    const std::size_t first = ran.pieces.size() - verify::retractsAtEnd(ran);
    out.moves.assign(ran.pieces.begin() + static_cast<std::ptrdiff_t>(first), ran.pieces.end());
    if (!out.moves.empty()) ran.end = out.moves.front().from;
    // What the ball leans on while it comes up is the operator's, who has read the stop.
    for (const Piece& piece : out.moves)
      std::erase_if(ran.events, [&](const auto& event) { return event.second == piece.range; });
    ran.pieces.resize(first);
    return out;
  }
  return std::nullopt;
}

double mostRaised(const verify::Record& source, const sim::Point3& zero, double ballRadius) {
  double out = 0;
  for (const verify::Measure& measure : source.measures) {
    const auto datum = std::find_if(measure.datums.begin(), measure.datums.end(),
                                    [](const auto& one) { return one.first.second == kZ; });
    if (datum == measure.datums.end()) continue;
    for (std::size_t i = 0; i < std::min(measure.nominal.size(), measure.contacts.size()); ++i) {
      if (measure.nominal[i].direction.z > kDown) continue;
      // An edge is met beside the lowest point, which counts all the same.
      const double nominal = measure.contacts[i].centre.z - ballRadius - datum->second;
      const double meant = measure.drawn ? measure.drawn->z : measure.nominal[i].point.z;
      out = std::max(out, nominal - (meant - zero.z));
    }
  }
  return out;
}

std::string tailFault(const MikroprogTail& tail, const MikroprogRetract& wanted) {
  if (tail.height < wanted.least - kDatum) return "after the stop nothing takes the probe up";
  if (std::abs(tail.z - wanted.z) > wanted.tolerance)
    return fmt::format("after the stop the probe goes up to Z{} against Z{}", fixedText(tail.z, 3),
                       fixedText(wanted.z, 3));
  for (const Piece& piece : tail.moves)
    if (!piece.feed || std::abs(*piece.feed - wanted.feed) > kSame)
      return fmt::format("after the stop the probe goes up at F{} against F{}",
                         numberText(piece.feed.value_or(0)), numberText(wanted.feed));
  return "";
}

std::optional<Difference> textFault(const ir::Program& program, const stdlib::MikroprogControl& control) {
  const auto found = [](Aspect aspect, std::string text, SourceRange range = {}) {
    return Difference{aspect, std::move(text), {}, range};
  };
  for (const dialect::SkipMoveUse& one : dialect::skipMoves(program, control)) {
    const SourceRange range = program.body[one.statement].origin.range();
    if (one.use == dialect::SkipUse::Blind)
      return found(Aspect::Ending, "a G31 without a block to go to", range);
    if (one.use == dialect::SkipUse::Neither || !one.stop)
      return found(Aspect::Ending,
                   "a G31 that neither guards nor searches: of contact and no contact one has to go on and "
                   "the other to end in its tail",
                   range);
    const bool searches = one.use == dialect::SkipUse::Search;
    const std::string text = dialect::textBeside(program, *one.stop);
    const std::string& wanted = searches ? control.notFound : control.collision;
    if (text != wanted)
      return found(Aspect::Ending,
                   fmt::format("a G31 that {} ends in the stop `{}` against `{}`",
                               searches ? "finds nothing" : "meets something", text, wanted),
                   range);
  }
  const std::vector<std::string> said = dialect::functionsFirst(program, control);
  const char* const plane = control.hasAxis('Y') ? "plane-xy" : "plane-zx";
  for (const std::string_view wanted :
       {std::string_view(plane), std::string_view("absolute"), std::string_view("feed-per-minute")}) {
    const std::string& group = control.function(wanted).group;
    const auto last = std::find_if(said.rbegin(), said.rend(), [&](const std::string& one) {
      return !one.empty() && control.function(one).group == group;
    });
    if (last != said.rend() && *last == wanted) continue;
    return found(Aspect::State, fmt::format("the program does not say {} before its first move",
                                            control.function(wanted).code()));
  }
  return std::nullopt;
}

std::vector<Difference> frameFaults(const verify::Record& source, const verify::Record& ran, bool height) {
  std::vector<Difference> out;
  if (std::optional<Difference> one = unasked(ran, height)) out.push_back(std::move(*one));
  if (std::optional<Difference> one = unsettled(source, ran, height)) out.push_back(std::move(*one));
  return out;
}

std::optional<Difference> startFault(const verify::Record& ran, const verify::Record& beside,
                                     const sim::Point3& by) {
  const auto moves = [](const verify::Record& record) {
    std::vector<Piece> out = record.pieces;
    std::erase_if(out, [](const Piece& piece) { return verify::near(piece.from, piece.to, kSame); });
    return out;
  };
  const std::vector<Piece> a = moves(ran), b = moves(beside);
  const auto isWay = [&](const Piece& piece) {
    const sim::Point3 start{ran.start.x, ran.start.y, piece.from.z};
    return piece.kind == PathKind::Rapid && verify::near(piece.from, start + by, kSame) &&
           verify::near(piece.to, start, kSame);
  };
  const auto way = std::find_if(b.begin(), b.end(), isWay);
  const std::size_t at = static_cast<std::size_t>(way - b.begin());
  bool same = way != b.end() && b.size() == a.size() + 1;
  for (std::size_t i = 0; same && i < a.size(); ++i) {
    const Piece& other = b[i < at ? i : i + 1];
    const sim::Point3 off = i < at ? by : sim::Point3{};
    same = other.kind == a[i].kind && verify::near(other.from, a[i].from + off, kSame) &&
           verify::near(other.to, a[i].to + off, kSame);
  }
  if (same) return std::nullopt;
  return Difference{Aspect::Path,
                    "begun beside its start point, the program does not go there first",
                    {},
                    b.empty() ? SourceRange{} : b.front().range};
}

} // namespace dotek::targets
