// Measurements at angles: a touch along a direction, two walls across one, three touches of a circle, and the
// direction of a face.
#include "backends/cycle/MeasureCall.h"

#include <fmt/format.h>

namespace dotek::backends::cycle {

using stdlib::ArgumentRole;

namespace {

// The text as a factor: "(a + b)".
std::string factor(const std::string& text) {
  return text.find(' ') == std::string::npos || text.find(" mm") + 3 == text.size() ||
                 text.find(" deg") + 4 == text.size()
             ? text
             : "(" + text + ")";
}

std::string half(const std::string& text) {
  const bool sum = text.find(" + ") != std::string::npos || text.find(" - ") != std::string::npos;
  return (sum ? "(" + text + ")" : text) + " / 2";
}

constexpr double kRightAngle = 90;

} // namespace

void MeasureCall::leavesRound(const std::array<std::string, 2>& centre, const std::string& size,
                              const std::string& wanted) {
  state_.measured.clear();
  for (const ir::Axis axis : {ir::Axis::X, ir::Axis::Y}) {
    const std::size_t i = ir::indexOf(axis);
    state_.measured[kPositions[i]] = centre[i];
    state_.measured[kErrors[i]] = centre[i] + " - " + factor(hereText(state_, axis));
  }
  state_.measured[ir::ResultName::Size] = state_.measured[ir::ResultName::Main] = size;
  state_.measured[ir::ResultName::SizeError] = size + " - " + factor(wanted);
}

void MeasureCall::angledSurface() {
  const std::string angle = text(find(ArgumentRole::Direction), ir::Kind::Angle);
  const std::string distance = text(find(ArgumentRole::Distance));
  const std::string overtravel = text(find(ArgumentRole::Overtravel));
  if (!tookAll() || state_.failed) return;
  if (angle.empty() || distance.empty())
    return state_.refuse(range_, "a surface at an angle without direction or distance",
                         "state both in the call");
  const std::string cosine = fmt::format("cos({})", angle), sine = fmt::format("sin({})", angle);
  std::array<std::string, 3> expected, found;
  if (call_.setting) keepHere({ir::Axis::X, ir::Axis::Y});
  expected[0] = fmt::format("{} + {} * {}", hereText(state_, ir::Axis::X), factor(distance), cosine);
  expected[1] = fmt::format("{} + {} * {}", hereText(state_, ir::Axis::Y), factor(distance), sine);
  std::optional<Setting> set;
  if (call_.setting && !(set = setting(expected))) return;
  const std::string wall = state_.fresh("wall");
  state_.add(fmt::format("touch along x {}, y {} by {}{} -> {}", cosine, sine, distance,
                         overtravel.empty() ? "" : " overtravel " + overtravel, wall),
             origin_);
  found[0] = wall + ".at_x";
  found[1] = wall + ".at_y";
  state_.measured.clear();
  state_.measured[ir::ResultName::PositionX] = found[0];
  state_.measured[ir::ResultName::PositionY] = found[1];
  state_.measured[ir::ResultName::ErrorX] = fmt::format("{}.error * {}", wall, cosine);
  state_.measured[ir::ResultName::ErrorY] = fmt::format("{}.error * {}", wall, sine);
  if (set) writeSetting(state_, *set, found, origin_);
}

// Two walls across one direction, from the middle.
void MeasureCall::angledPair(bool beside) {
  const std::string angle = text(find(ArgumentRole::Direction), ir::Kind::Angle);
  const ir::CycleArgument* across = find(ArgumentRole::Width);
  if (across == nullptr) across = find(ArgumentRole::Width, ir::Axis::X); // of no axis: counted as the first
  const std::string width = text(across);
  const std::string overtravel = text(find(ArgumentRole::Overtravel));
  const std::string down = beside ? wayDown() : "";
  if (state_.failed || !tookAll()) return;
  if (angle.empty() || width.empty())
    return state_.refuse(range_, "a feature at an angle without direction or width",
                         "state both in the call");
  if (beside && !overtravel.empty())
    return state_.refuse(range_, "the overtravel of this call", "a called cycle has the machine's");
  keepHere({ir::Axis::X, ir::Axis::Y});
  const std::string one = state_.fresh("side"), other = state_.fresh("far_side");
  const std::string size = state_.fresh("found_width");
  if (beside) {
    // The ball's places lie on the line through the start, one beyond each wall.
    state_.add(fmt::format("call rim_outside radius_wanted = {}, direction = {}, {} -> {}", half(width),
                           angle, down, one),
               origin_);
    state_.add(fmt::format("call rim_outside radius_wanted = {}, direction = {} + 180 deg, {} -> {}",
                           half(width), angle, down, other),
               origin_);
    state_.add(fmt::format("{0} = sqrt(square({1}.ball_x - {2}.ball_x) + square({1}.ball_y - {2}.ball_y)) "
                           "- 2 * ball_radius",
                           size, one, other),
               origin_);
  } else {
    const std::string beyond = overtravel.empty() ? "" : " overtravel " + overtravel;
    state_.add(
        fmt::format("touch along x cos({0}), y sin({0}) by {1}{2} -> {3}", angle, half(width), beyond, one),
        origin_);
    state_.add(fmt::format("touch along x -cos({0}), y -sin({0}) by {1}{2} -> {3}", angle, half(width),
                           beyond, other),
               origin_);
    state_.add(fmt::format("{} = {} + {}.error + {}.error", size, factor(width), one, other), origin_);
  }
  const std::string place = beside ? "ball" : "at";
  leavesRound({fmt::format("({0}.{2}_x + {1}.{2}_x) / 2", one, other, place),
               fmt::format("({0}.{2}_y + {1}.{2}_y) / 2", one, other, place)},
              size, width);
}

void MeasureCall::threePoints(bool beside) {
  static constexpr ArgumentRole kAngles[] = {ArgumentRole::FirstAngle, ArgumentRole::SecondAngle,
                                             ArgumentRole::ThirdAngle};
  const std::string diameter = text(find(ArgumentRole::Diameter));
  std::array<std::string, 3> angles;
  for (std::size_t i = 0; i < angles.size(); ++i)
    angles[i] = text(find(kAngles[i]), ir::Kind::Angle);
  const std::string overtravel = text(find(ArgumentRole::Overtravel));
  const std::string down = beside ? wayDown() : "";
  if (state_.failed || !tookAll()) return;
  if (diameter.empty() || angles[0].empty() || angles[1].empty() || angles[2].empty())
    return state_.refuse(range_, "a circle without its diameter or one of three angles",
                         "state all in the call");
  if (!overtravel.empty())
    return state_.refuse(range_, "the overtravel of this call", "a called cycle has the machine's");
  keepHere({ir::Axis::X, ir::Axis::Y});
  std::array<std::string, 3> expected, found, rims;
  expected[0] = hereText(state_, ir::Axis::X);
  expected[1] = hereText(state_, ir::Axis::Y);
  std::optional<Setting> set;
  if (call_.setting && !(set = setting(expected))) return;
  static constexpr const char* kNames[] = {"first", "second", "third"};
  std::string points;
  for (std::size_t i = 0; i < rims.size(); ++i) {
    rims[i] = state_.fresh(kNames[i]);
    state_.add(fmt::format("call {} radius_wanted = {}, direction = {}{}{} -> {}",
                           beside ? "rim_outside" : "rim_inside", half(diameter), angles[i],
                           beside ? ", " : "", down, rims[i]),
               origin_);
    points += fmt::format("{0}x_{1} = {2}.ball_x, y_{1} = {2}.ball_y", i == 0 ? "" : ", ", i + 1, rims[i]);
  }
  const std::string ring = state_.fresh("ring");
  state_.add(fmt::format("// The ball's middle runs on a circle that is {} by the ball.",
                         beside ? "larger" : "smaller"),
             origin_);
  state_.add(fmt::format("call circle_3 {} -> {}", points, ring), origin_);
  const std::string size = state_.fresh("found_diameter");
  state_.add(fmt::format("{} = 2 * ({}.radius {} ball_radius)", size, ring, beside ? "-" : "+"), origin_);
  leavesRound({ring + ".centre_x", ring + ".centre_y"}, size, diameter);
  found[0] = ring + ".centre_x";
  found[1] = ring + ".centre_y";
  if (set) writeSetting(state_, *set, found, origin_);
}

// Two touches of one face, halves of the spacing on both sides of the start.
void MeasureCall::faceAngle() {
  const ir::Axis normal = *call_.axis;
  const ir::Axis face = normal == ir::Axis::X ? ir::Axis::Y : ir::Axis::X;
  const ir::CycleArgument* target = find(ArgumentRole::Target, normal);
  const ir::CycleArgument* apart = find(ArgumentRole::Spacing, face);
  const ir::CycleArgument* stated = find(ArgumentRole::FaceAngle);
  const std::string limit = text(find(ArgumentRole::AngleTolerance), ir::Kind::Angle);
  const std::string overtravel = text(find(ArgumentRole::Overtravel));
  if (!tookAll()) return;
  if (target == nullptr || apart == nullptr)
    return state_.refuse(range_, "the angle of a face without its place or the spacing",
                         "state both in the call");
  std::string spacing = text(apart);
  const std::string place = workText(state_, coordinate(*target), normal, range_);
  std::string expected = text(stated, ir::Kind::Angle);
  if (state_.failed) return;
  if (expected.empty()) expected = literal(normal == ir::Axis::X ? kRightAngle : 0, ir::Kind::Angle);
  const double* known = ir::constantValue(apart->value);
  if (known != nullptr && *known < 0)
    return state_.refuse(range_, "a spacing below 0", "state it without sign");
  // The macro takes it without its sign.
  if (known == nullptr) spacing = fmt::format("abs({})", spacing);
  const std::string across = smallLetter(face), into = smallLetter(normal);
  const std::string beyond = overtravel.empty() ? "" : " overtravel " + overtravel;
  const std::string one = state_.fresh("near"), other = state_.fresh("far");
  if (known == nullptr) {
    const std::string name = state_.fresh("spacing");
    state_.add(fmt::format("{} = {}", name, spacing), origin_);
    spacing = name;
  }
  state_.add(fmt::format("protected move by {} -{}", across, half(spacing)), origin_);
  state_.add(fmt::format("touch {} to {}{} -> {}", into, place, beyond, one), origin_);
  state_.add(fmt::format("protected move by {} {}", across, spacing), origin_);
  state_.add(fmt::format("touch {} to {}{} -> {}", into, place, beyond, other), origin_);
  state_.add(fmt::format("protected move by {} -{}", across, half(spacing)), origin_);
  const std::string rise = fmt::format("{}.at - {}.at", other, one);
  const std::string turn = state_.fresh("turn"), off = state_.fresh("turn_error");
  state_.add(normal == ir::Axis::Y ? fmt::format("{} = atan({}, {})", turn, rise, spacing)
                                   : fmt::format("{} = atan({}, {})", turn, spacing, rise),
             origin_);
  // A face has two directions, 180 degrees apart: the one nearer to the expected counts.
  const double* nominal = stated == nullptr ? nullptr : ir::constantValue(stated->value);
  const std::string difference = expected == "0 deg" ? turn : fmt::format("{} - {}", turn, factor(expected));
  state_.add(fmt::format("{} = {}", off, difference), origin_);
  if (stated != nullptr && (nominal == nullptr || *nominal != (normal == ir::Axis::X ? kRightAngle : 0))) {
    state_.add("// A face has two directions: the one nearer to the expected counts.", origin_);
    state_.add(fmt::format("{0} = {0} - 180 deg * round({0} / 180 deg)", off), origin_);
  }
  if (!limit.empty()) alarmBeyond(off, limit, "The angle is out of tolerance");
  state_.measured.clear();
  state_.measured[ir::ResultName::Angle] = expected == "0 deg" ? off : fmt::format("{} + {}", expected, off);
  state_.measured[ir::ResultName::AngleError] = off;
}

} // namespace dotek::backends::cycle
