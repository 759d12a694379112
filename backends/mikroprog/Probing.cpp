// Protected moves and measurements of one surface.
#include "backends/mikroprog/State.h"
#include "ir/Linear.h"
#include "support/Decimal.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

namespace dotek::backends::mikroprog {

namespace {

constexpr std::uint32_t kTouchProbe = 7; // condition O: contact of touch probe A

double sum(double a, double b) {
  return ir::exactSum(a, b).value_or(a + b);
}

// Coordinate of the controlled point where the ball touches a surface at `face`, moving by the sign of `way`.
double contactAt(const State& state, ir::Axis axis, double face, double way) {
  const double radius = state.host("tool_radius");
  if (axis == ir::Axis::Z && !state.options.lengthToCentre) return way < 0 ? face : sum(face, -2 * radius);
  return sum(face, way < 0 ? radius : -radius);
}

// Where the path of the source shows the surface that a travel along the axis from `from` to `end` meets;
// nothing: it shows none there. Of several on one line the nearest is met.
std::optional<double> drawnFace(State& state, ir::Axis axis, double from, double end) {
  constexpr double kPrinted = 0.01; // mm: what a post may round a coordinate by
  if (!state.drawn)
    state.drawn = state.options.drawnSurfaces ? state.options.drawnSurfaces() : std::vector<DrawnSurface>();
  const double way = end > from ? 1 : -1;
  std::optional<double> out;
  for (const DrawnSurface& one : *state.drawn) {
    if (one.axis != axis || one.upward != (end > from)) continue;
    const bool besideLine = std::any_of(std::begin(ir::kAxes), std::end(ir::kAxes), [&](ir::Axis other) {
      if (other == axis || (other == ir::Axis::Z && state.options.lengthToCentre)) return false;
      const std::optional<double>& at = state.axes[ir::indexOf(other)].at;
      return at && std::abs(*at - one.contact[ir::indexOf(other)]) > kPrinted;
    });
    const bool onTheWay = (one.face - from) * way > 0 && (end - one.face) * way > -kPrinted;
    if (besideLine || !onTheWay) continue;
    if (!out || (*out - one.face) * way > 0) out = one.face;
  }
  return out;
}

// Whether the statements after `index` go on in the direction of `back` at least to `to`, along that axis
// alone: they are the path back.
bool leavesByItself(State& state, std::size_t index, ir::Axis axis, double to, double back) {
  const auto& list = state.cycle.body;
  for (std::size_t i = index + 1; i < list.size(); ++i) {
    enum class Goes : std::uint8_t { On, Away, Back };
    const Goes goes = match(
        list[i], [](const ir::OneOf<ir::Comment, ir::Store> auto&) { return Goes::On; },
        [](const ir::SetMode& node) {
          return node.mode == ir::Mode::Absolute || node.mode == ir::Mode::RapidMotion ||
                         node.mode == ir::Mode::FeedMotion
                     ? Goes::On
                     : Goes::Away;
        },
        [&](const ir::Move& node) {
          if (node.motion == ir::Motion::Protected) return Goes::Away;
          for (const ir::Axis other : ir::kAxes)
            if (node.axes[ir::indexOf(other)].has_value() != (other == axis)) return Goes::Away;
          const ir::Coordinate& target = *node.axes[ir::indexOf(axis)];
          const double* value = ir::constantValue(target.value);
          if (target.frame != ir::Frame::Work || target.system != nullptr || value == nullptr)
            return Goes::Away;
          return (*value - to) * back >= 0 ? Goes::Back : Goes::Away;
        },
        [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Measure, ir::CallCycle, ir::ProbePower,
                           ir::Assign, ir::Return, ir::Spindle, ir::Coolant, ir::Dwell, ir::Stop, ir::Alarm,
                           ir::OpaqueBlock, ir::Port, ir::Print> auto&) { return Goes::Away; });
    if (goes != Goes::On) return goes == Goes::Back;
  }
  return false;
}

// The system moves under the coordinates that follow.
void shiftSystem(State& state, ir::Axis axis, double face, double nominal, const ir::Origin& origin) {
  AxisState& now = state.axes[ir::indexOf(axis)];
  now.datum = true;
  now.shift = sum(nominal, -face);
  if (std::abs(now.shift) < 1e-9) now.shift = 0;
  if (axis == ir::Axis::Z) state.raised = std::max(state.raised, now.shift);
  if (now.shift == 0 && !state.remarked.insert("corrected").second) return;
  const std::string by =
      now.shift == 0 ? ""
                     : fmt::format(", {} {} by {} mm", ir::letterOf(axis),
                                   now.shift > 0 ? "greater" : "smaller", numberText(std::abs(now.shift)));
  state.diagnostics.report<diag::SystemCorrected>(origin.range(), by);
  if (now.shift != 0)
    state.remarks.push_back(fmt::format("AFTER THE DATUM {} COUNTS {} MORE THAN IN THE SOURCE",
                                        ir::letterOf(axis), shownLength(state, axis, now.shift)));
  else
    state.remarks.push_back("MOVES AFTER A DATUM ARE IN THE CORRECTED SYSTEM");
}

void setPosition(State& state, ir::Axis axis, double contact, double face, double nominal,
                 const std::string& system, const ir::Origin& origin) {
  if (!relyOn(state, {12}, "G92 along one axis", origin.range())) return;
  if (axis == ir::Axis::Y && !relyOn(state, {22}, "G92 with Y", origin.range())) return;
  if (!onlyDatum(state, system, origin.range())) return;
  const std::string code = state.code("set-position");
  state.sheet.add(code + " " + axisWord(state, axis, contact, origin.range()), origin,
                  fmt::format("CONTACT OF {}; S{} NOT WRITTEN", shownPlace(state, axis, nominal), system));
  state.diagnostics.report<diag::OffsetNumberDropped>(
      origin.range(), system, code + " sets the active system itself",
      state.code("reference") +
          " alone brings the old one back; `--datum operator` stops for an entry by hand");
  if (state.remarked.insert("offset " + system).second)
    state.remarks.push_back(fmt::format("WORK OFFSET {} NOT WRITTEN: THE ACTIVE SYSTEM IS SET, {} ENDS THAT",
                                        system, state.code("reference")));
  shiftSystem(state, axis, face, nominal, origin);
}

void askOperator(State& state, ir::Axis axis, double contact, const std::string& system,
                 const ir::Origin& origin) {
  const std::string here = axisWord(state, axis, contact, origin.range());
  state.sheet.add(state.code("stop") + " ;" + fmt::format(fmt::runtime(state.control.enterShift), here),
                  origin);
  state.guarded = false;
  state.diagnostics.report<diag::OffsetNumberDropped>(
      origin.range(), system, "no function writes a stored shift", "the program stops for an entry by hand");
  if (state.remarked.insert("offset " + system).second)
    state.remarks.push_back(fmt::format("WORK OFFSET {} NOT WRITTEN: THE OPERATOR ENTERS THE SHIFT", system));
}

} // namespace

bool onlyDatum(State& state, const std::string& system, SourceRange range) {
  if (!state.datumSystem) state.datumSystem = system;
  if (*state.datumSystem == system) return true;
  state.refuse<diag::DatumOfSeveralSystems>(range, system, *state.datumSystem, state.code("set-position"));
  return false;
}

bool guardSystem(State& state, double system, SourceRange range) {
  constexpr double kFirst = 54, kLast = 59;
  if (system >= kFirst && system <= kLast) return true;
  state.refuse<diag::SystemRange>(range, numberText(system), "write one of those");
  return false;
}

void guard(State& state, const ir::Origin& origin) {
  ++state.probeMoves;
  if (state.guarded) return;
  state.guarded = true;
  ++state.guards;
  state.usesCollision = true;
  state.sheet.jump(state.code("jump-if"), state.collision, fmt::format("O{}", kTouchProbe),
                   made("contact before the probe moves", origin), "PROBE ALREADY IN CONTACT");
}

void protectedMove(State& state, const ir::Move& move, const ir::Origin& origin) {
  const SourceRange range = origin.range();
  std::string words = state.code("probe-move");
  bool several = false, any = false;
  for (const ir::Axis axis : ir::kAxes) {
    const auto& target = move.axes[ir::indexOf(axis)];
    if (!target) continue;
    const std::optional<double> to = placeOf(state, *target, axis, range);
    if (!to) return;
    AxisState& now = state.axes[ir::indexOf(axis)];
    const bool lift =
        move.point == ir::ProbePoint::Lowest && axis == ir::Axis::Z && state.options.lengthToCentre;
    now.at = lift ? sum(*to, state.host("tool_radius")) : *to;
    state.reaches(axis, *now.at);
    words += " " + axisWord(state, axis, sum(*now.at, now.shift), range);
    several = any;
    any = true;
    if (axis == ir::Axis::Y && !relyOn(state, {22}, "G31 with Y", range)) return;
  }
  if (!any) return;
  if (!relyOn(state, {20, 21}, several ? "a protected move of several axes" : "a protected move", range))
    return;
  std::string comment;
  if (move.feed != nullptr) {
    const std::optional<double> feed = rangedValueOf(state, 'F', move.feed, "a feed", false, range);
    if (!feed) return;
    comment = "F" + numberText(*feed) + " NOT KEPT";
    state.diagnostics.report<diag::FeedDropped>(
        range, numberText(*feed), state.code("probe-move") + " moves at a speed of the control");
  }
  state.feed.reset(); // the source's macro leaves a feed that nobody knows
  guard(state, origin);
  const Mark next = state.mark();
  state.usesCollision = true;
  state.sheet.jump(std::move(words), next, "", origin, std::move(comment));
  state.sheet.jump(state.code("jump"), state.collision, "", made("contact on the path", origin));
  state.sheet.place(next);
}

void search(State& state, ir::Axis axis, double target, const ir::Origin& origin, std::string comment) {
  state.usesNotFound = true;
  state.sheet.jump(state.code("probe-move") + " " + axisWord(state, axis, target, origin.range()),
                   state.notFound, "", origin, std::move(comment));
}

void record(State& state, const ir::Origin& origin) {
  relyOn(state, {23}, "a record of the contact", origin.range());
  state.sheet.add(fmt::format("{} @{}.{}", state.code("record-position"), state.options.fileName,
                              state.control.dataEnding),
                  made("record of the contact", origin));
}

void measure(State& state, const ir::Measure& measure, std::size_t index) {
  const ir::Origin& origin = state.cycle.body[index].origin;
  const SourceRange range = origin.range();
  if (measure.feature == ir::Feature::Bore) {
    middle(state, {ir::Axis::X, ir::Axis::Y}, {"bore", "a diameter"}, measure.diameter, measure.setting,
           origin);
    return;
  }
  const ir::Axis axis = measure.axis;
  if (!measure.target) {
    state.refuse<diag::MikroprogCannot>(range, "the surface has no place", "nothing says where to search");
    return;
  }
  if (!checkAxis(state, axis, range)) return;
  const std::optional<double> from = hereOf(state, axis, range);
  const std::optional<double> end = from ? placeOf(state, *measure.target, axis, range) : std::nullopt;
  if (!end) return;
  AxisState& now = state.axes[ir::indexOf(axis)];
  const double way = *end - *from;
  if (way == 0) {
    state.refuse<diag::MikroprogCannot>(range, "the travel to the surface is 0",
                                        "it has no direction to search in");
    return;
  }
  if (!relyOn(state, {20}, "a search along one axis", range)) return;
  if (axis == ir::Axis::Y && !relyOn(state, {22}, "G31 with Y", range)) return;
  // A travel may lead beyond its surface; a place is that of the surface.
  const bool travels = measure.target->frame == ir::Frame::Here;
  const std::optional<double> drawn = travels ? drawnFace(state, axis, *from, *end) : std::nullopt;
  const double face = drawn.value_or(*end);
  const double over = state.overtravel();
  guard(state, origin);
  search(state, axis, sum(sum(*end, way < 0 ? -over : over), now.shift), origin,
         "SURFACE EXPECTED AT " + shownPlace(state, axis, sum(face, now.shift)));
  record(state, origin);
  if (measure.setting) {
    const ir::ExpressionPtr& given = measure.setting->nominal[ir::indexOf(axis)];
    const std::optional<double> nominal = valueOf(state, given, range);
    const std::optional<double> system = valueOf(state, measure.setting->system, range);
    if (!nominal || !system || !guardSystem(state, *system, range)) return;
    if (axis == ir::Axis::Z && !state.options.lengthToCentre && state.remarked.insert("tip").second) {
      state.diagnostics.report<diag::LengthToTip>(range);
      state.remarks.push_back("Z COUNTS TO THE LOWEST POINT OF THE BALL");
    }
    const double before = (*nominal - *from) * (way < 0 ? -1 : 1);
    if (travels && !drawn && before > 0 && before < std::abs(way)) {
      const std::string letter(1, ir::letterOf(axis));
      state.refuse<diag::TravelPastNominal>(range, numberText(std::abs(way) - before), letter,
                                            numberText(*nominal), letter, numberText(*end));
      return;
    }
    const double contact = contactAt(state, axis, *nominal, way);
    if (state.options.datum == Datum::SetPosition)
      setPosition(state, axis, contact, face, *nominal, numberText(*system), origin);
    else
      askOperator(state, axis, contact, numberText(*system), origin);
  }
  state.feed.reset();
  if (state.failed) return;
  if (!state.oneOfSeveral && leavesByItself(state, index, axis, *from, way < 0 ? 1 : -1)) {
    state.diagnostics.report<diag::RetreatMerged>(range);
    if (state.remarked.insert("retreat").second)
      state.remarks.push_back("THE PATH BACK FROM A SURFACE IS THE MOVE OF THE SOURCE AFTER IT");
    return;
  }
  state.sheet.add(fmt::format("{} {} F{}", state.code("feed"),
                              axisWord(state, axis, sum(*from, now.shift), range),
                              numberWord(state, state.host("return_feed"), range)),
                  made("back to where the measurement began", origin));
}

} // namespace dotek::backends::mikroprog
