// The middle of a bore, a pocket, a boss or a web: two contacts along each axis and the middle between them.
#include "backends/mikroprog/State.h"
#include "ir/Linear.h"
#include "support/Decimal.h"

#include <fmt/format.h>

namespace dotek::backends::mikroprog {

namespace {

constexpr double kFirstStep = 32.768; // mm; a power of two of the last
constexpr double kLastStep = 0.002;   // the middle is right to half of it
constexpr std::uint32_t kBelowX = 11; // condition O: P90 <= X; 13 for Y

double sum(double a, double b) {
  return ir::exactSum(a, b).value_or(a + b);
}

struct Plan {
  double half = 0;   // from the middle to a contact of the ball's centre, as expected
  double widest = 0; // from contact to contact, at most
  double first = 0;  // step that the walk begins with: all steps together pass `widest`
  // Of what is touched from outside: how far beside the contact the ball goes down and comes up, and where it
  // is before and after, and at the touches (Z, in the coordinates of the source). 0: from within.
  double beside = 0, above = 0, depth = 0;
  bool outside() const { return beside > 0; }
};

std::string record(const State& state, std::string_view function) {
  return fmt::format("{} @{}.{}", state.code(function), state.options.fileName, state.control.dataEnding);
}

// Walks from the left contact, at -W, to -W/2. P90 is moved by each step that it may take and stay below the
// coordinate; for every other step the axis moves by half of it, and P90 with it. W is the sum of those, so
// their halves lead to the middle, and the walk never passes it.
void writeWalk(State& state, ir::Axis axis, const Plan& plan, Mark entry, const ir::Origin& from) {
  const char letter = ir::letterOf(axis);
  const ir::Origin origin = made("walk to the middle between the contacts", from);
  const SourceRange range = from.range();
  state.subprograms.push_back({entry, {}});
  Sheet& sheet = state.subprograms.back().sheet;
  const std::string condition = fmt::format("O{}", kBelowX + 2 * static_cast<std::uint32_t>(axis));
  const std::string feed = " F" + numberWord(state, state.host("return_feed"), range);
  sheet.comment(fmt::format("WALK TO THE MIDDLE ALONG {}", letter), origin);
  sheet.place(entry);
  sheet.add(state.code("incremental"), origin);
  bool first = true;
  for (double step = plan.first; step > kLastStep / 2; step /= 2) {
    const std::string whole = numberWord(state, step, range), half = numberWord(state, step / 2, range);
    const Mark next = state.mark();
    sheet.add("P90=P90+" + whole, origin);
    sheet.jump(state.code("jump-if"), next, condition, origin, first ? "KEEP THE STEP" : "");
    sheet.add("P90=P90-" + half, origin);
    sheet.add(fmt::format("{} {}{}{}", state.code("feed"), letter, half, first ? feed : ""), origin);
    sheet.place(next);
    first = false;
  }
  sheet.add(state.code("absolute"), origin);
  sheet.add(state.code("return"), origin);
}

void protectedTo(State& state, ir::Axis axis, double place, std::string reason, const ir::Origin& origin) {
  ir::Move move;
  move.motion = ir::Motion::Protected;
  move.axes[ir::indexOf(axis)] = ir::Coordinate{ir::constant(place), ir::Frame::Work, nullptr};
  protectedMove(state, move, made(std::move(reason), origin));
}

// Over one side and down beside it; `out`: in the coordinates of the source.
void downBeside(State& state, ir::Axis axis, const Plan& plan, double out, const ir::Origin& origin) {
  protectedTo(state, axis, out, "beside the feature", origin);
  protectedTo(state, ir::Axis::Z, plan.depth, "down beside the feature", origin);
}

// One axis from outside, by comparing. The first contact becomes minus the way off the wall, so that the
// place above the other side, as far off its wall, is at minus twice the way from there to the middle.
void compareOutside(State& state, ir::Axis axis, const Plan& plan, double centre, double nominal,
                    const ir::Origin& origin) {
  const SourceRange range = origin.range();
  AxisState& now = state.axes[ir::indexOf(axis)];
  const double over = state.overtravel();
  const auto word = [&](double value) { return axisWord(state, axis, value, range); };
  const std::string feed = " F" + numberWord(state, state.host("return_feed"), range);
  const ir::Origin way = made("middle by comparing", origin);
  state.sheet.comment(fmt::format("MIDDLE ALONG {}", ir::letterOf(axis)), way);
  downBeside(state, axis, plan, sum(centre, sum(plan.half, plan.beside)), origin);
  ++state.probeMoves;
  search(state, axis, sum(sum(sum(centre, now.shift), plan.half), -over), origin, "WALL ON THE PLUS SIDE");
  state.sheet.add(state.code("set-position") + " " + word(-plan.beside), way, "FOR THE COMPARISON");
  now.shift = sum(-plan.beside, -sum(centre, plan.half));
  state.sheet.add(fmt::format("{} {}{}", state.code("feed"), word(0), feed), made("off the wall", origin));
  protectedTo(state, ir::Axis::Z, plan.above, "up beside the feature", origin);
  downBeside(state, axis, plan, sum(centre, -sum(plan.half, plan.beside)), origin);
  ++state.probeMoves;
  search(state, axis, sum(sum(sum(centre, now.shift), -plan.half), over), origin, "WALL ON THE MINUS SIDE");
  state.sheet.add(state.code("incremental"), way);
  state.sheet.add(fmt::format("{} {}{}", state.code("feed"), word(-plan.beside), feed),
                  made("off the wall", origin));
  state.sheet.add(state.code("absolute"), way);
  protectedTo(state, ir::Axis::Z, plan.above, "up beside the feature", origin);
  state.sheet.add("P90=" + numberWord(state, -2 * plan.first, range), way);
  const Mark entry = state.mark();
  state.sheet.jump(state.code("call"), entry, "", way, "TO THE MIDDLE");
  state.sheet.add("P90=P90+" + numberWord(state, plan.beside, range), way);
  state.sheet.add(record(state, "record-value"), made("record of the size", origin),
                  fmt::format("SIZE = -2*P90 - {}", numberText(2 * state.host("tool_radius"))));
  state.sheet.add(state.code("set-position") + " " + word(nominal), origin);
  writeWalk(state, axis, plan, entry, origin);
  now.shift = sum(nominal, -centre);
  now.at = centre;
  now.datum = true;
}

// The same by documented functions alone: a record of each contact, and back over the middle.
void recordOutside(State& state, ir::Axis axis, const Plan& plan, double centre, const ir::Origin& origin) {
  const AxisState& now = state.axes[ir::indexOf(axis)];
  const double over = state.overtravel();
  for (const double side : {1.0, -1.0}) {
    const double out = sum(centre, side * sum(plan.half, plan.beside));
    downBeside(state, axis, plan, out, origin);
    ++state.probeMoves;
    search(state, axis, sum(sum(centre, now.shift), side * sum(plan.half, -over)), origin,
           side > 0 ? "WALL ON THE PLUS SIDE" : "WALL ON THE MINUS SIDE");
    mikroprog::record(state, origin);
    state.sheet.add(fmt::format("{} {} F{}", state.code("feed"),
                                axisWord(state, axis, sum(out, now.shift), origin.range()),
                                numberWord(state, state.host("return_feed"), origin.range())),
                    made("off the wall", origin));
    protectedTo(state, ir::Axis::Z, plan.above, "up beside the feature", origin);
  }
  protectedTo(state, axis, centre, "back over the middle", origin);
}

// One axis, by comparing: the first contact becomes 0, so the second is at minus their distance.
void compareAxis(State& state, ir::Axis axis, const Plan& plan, double centre, double nominal,
                 const ir::Origin& origin) {
  const SourceRange range = origin.range();
  AxisState& now = state.axes[ir::indexOf(axis)];
  const double over = state.overtravel();
  const auto word = [&](double value) { return axisWord(state, axis, value, range); };
  const ir::Origin way = made("middle of the bore by comparing", origin);
  state.sheet.comment(fmt::format("MIDDLE ALONG {}", ir::letterOf(axis)), way);
  ++state.probeMoves;
  search(state, axis, sum(sum(sum(centre, now.shift), plan.half), over), origin, "WALL ON THE PLUS SIDE");
  state.sheet.add(state.code("set-position") + " " + word(0), way, "FOR THE COMPARISON");
  state.sheet.add(fmt::format("{} {} F{}", state.code("feed"), word(-plan.half),
                              numberWord(state, state.host("return_feed"), range)),
                  made("off the wall", origin));
  ++state.probeMoves;
  search(state, axis, -plan.widest, origin, "WALL ON THE MINUS SIDE");
  state.sheet.add("P90=" + numberWord(state, -2 * plan.first, range), way);
  const Mark entry = state.mark();
  state.sheet.jump(state.code("call"), entry, "", way, "TO THE MIDDLE");
  state.sheet.add(record(state, "record-value"), made("record of the diameter", origin),
                  fmt::format("DIAMETER = {} - 2*P90", numberText(2 * state.host("tool_radius"))));
  state.sheet.add(state.code("set-position") + " " + word(nominal), origin);
  writeWalk(state, axis, plan, entry, origin);
  now.shift = sum(nominal, -centre);
  now.datum = true;
}

// One axis by documented functions alone: a record of each contact, and back to where the probe stood.
void recordAxis(State& state, ir::Axis axis, const Plan& plan, double centre, const ir::Origin& origin) {
  const AxisState& now = state.axes[ir::indexOf(axis)];
  const double over = state.overtravel();
  const double here = sum(centre, now.shift);
  const std::string back =
      fmt::format("{} {} F{}", state.code("feed"), axisWord(state, axis, here, origin.range()),
                  numberWord(state, state.host("return_feed"), origin.range()));
  for (const double side : {1.0, -1.0}) {
    ++state.probeMoves;
    search(state, axis, sum(here, side * sum(plan.half, over)), origin,
           side > 0 ? "WALL ON THE PLUS SIDE" : "WALL ON THE MINUS SIDE");
    mikroprog::record(state, origin);
    state.sheet.add(back, made("back to where the measurement began", origin));
  }
}

} // namespace

void middle(State& state, const std::vector<ir::Axis>& axes, const Feature& feature,
            const ir::ExpressionPtr& size, const std::optional<ir::OffsetSetting>& setting,
            const ir::Origin& origin) {
  const SourceRange range = origin.range();
  std::array<double, 2> centre{}, nominal{};
  for (const ir::Axis axis : axes) {
    if (!checkAxis(state, axis, range)) return;
    const std::optional<double> here = hereOf(state, axis, range);
    if (!here) return;
    centre[ir::indexOf(axis)] = *here;
  }
  const std::optional<double> diameter = rangedValueOf(state, 'D', size, feature.size, false, range);
  if (!diameter) return;
  const double radius = state.host("tool_radius");
  Plan plan;
  if (feature.outside) {
    const std::optional<double> above = hereOf(state, ir::Axis::Z, range);
    if (!above || !checkAxis(state, ir::Axis::Z, range)) return;
    plan.above = *above;
    plan.depth = feature.outside->depth;
    plan.beside = feature.outside->clearance;
  }
  plan.half = sum(*diameter / 2, plan.outside() ? radius : -radius);
  plan.widest = plan.outside() ? sum(2 * plan.half, 4 * plan.beside) : sum(2 * plan.half, state.overtravel());
  if (plan.half <= 0) {
    state.refuse<diag::MikroprogCannot>(
        range,
        fmt::format("the ball of radius {} does not fit into the {} of {}", numberText(radius), feature.name,
                    numberText(*diameter)),
        fmt::format("give the size of the {}, or another radius", feature.name));
    return;
  }
  for (plan.first = kFirstStep; 2 * plan.first <= plan.widest; plan.first *= 2) {
  }
  std::string system;
  if (setting) {
    const std::optional<double> number = valueOf(state, setting->system, range);
    if (!number || !guardSystem(state, *number, range)) return;
    system = numberText(*number);
    for (const ir::Axis axis : axes) {
      const std::size_t i = ir::indexOf(axis);
      const auto value = valueOf(state, setting->nominal[i], range);
      if (!value) return;
      nominal[i] = *value;
    }
  }
  const bool compares = setting && state.options.datum == Datum::SetPosition;
  if (compares && !onlyDatum(state, system, range)) return;
  if (compares && !relyOn(state, {10, 13, 7}, fmt::format("the middle of a {}", feature.name), range)) return;
  if (compares && !relyOn(state, {12, 23}, "a datum and its record", range)) return;
  if (!relyOn(state, {20, 22}, "a search along one axis", range)) return;
  if (!plan.outside()) {
    guard(state, origin);
    --state.probeMoves; // counted below
  }
  for (const ir::Axis axis : axes) {
    const std::size_t i = ir::indexOf(axis);
    if (plan.outside() && compares)
      compareOutside(state, axis, plan, centre[i], nominal[i], origin);
    else if (plan.outside())
      recordOutside(state, axis, plan, centre[i], origin);
    else if (compares)
      compareAxis(state, axis, plan, centre[i], nominal[i], origin);
    else
      recordAxis(state, axis, plan, centre[i], origin);
  }
  state.feed.reset();
  if (!setting || state.failed) return;
  if (compares) {
    state.diagnostics.report<diag::OffsetNumberDropped>(
        range, system, state.code("set-position") + " sets the active system itself",
        state.code("reference") + " alone brings the old one back; `--datum operator` records the contacts");
    state.remarks.push_back(fmt::format("WORK OFFSET {} NOT WRITTEN: THE ACTIVE SYSTEM IS SET, {} ENDS THAT",
                                        system, state.code("reference")));
    std::string by;
    if (state.axes[0].shift == 0 && state.axes[1].shift == 0)
      state.remarks.push_back("MOVES AFTER A DATUM ARE IN THE CORRECTED SYSTEM");
    for (const ir::Axis axis : axes)
      if (const double shift = state.axes[ir::indexOf(axis)].shift; shift != 0) {
        by += fmt::format(", {} by {} mm", ir::letterOf(axis), numberText(shift));
        state.remarks.push_back(fmt::format("AFTER THE DATUM {} COUNTS {} MM MORE THAN IN THE SOURCE",
                                            ir::letterOf(axis), numberText(shift)));
      }
    state.diagnostics.report<diag::SystemCorrected>(range, by);
    return;
  }
  std::string place;
  for (const ir::Axis axis : axes)
    place += (place.empty() ? "" : " ") + axisWord(state, axis, nominal[ir::indexOf(axis)], range);
  state.sheet.add(state.code("stop") + " ;" + fmt::format(fmt::runtime(state.control.enterCentre), place),
                  origin);
  state.guarded = false;
  state.diagnostics.report<diag::OffsetNumberDropped>(range, system, "no function writes a stored shift",
                                                      "the program stops for an entry by hand");
  state.remarks.push_back(fmt::format("WORK OFFSET {} NOT WRITTEN: THE OPERATOR ENTERS THE SHIFT", system));
}

} // namespace dotek::backends::mikroprog
