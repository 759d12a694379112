// A vendor's call of a probing macro, written with touches or with cycles of the library.
#pragma once

#include "backends/cycle/State.h"
#include "stdlib/MacroCycle.h"

#include <optional>
#include <string>
#include <vector>

namespace dotek::backends::cycle {

std::string smallLetter(ir::Axis axis);

inline constexpr ir::ResultName kPositions[] = {ir::ResultName::PositionX, ir::ResultName::PositionY,
                                                ir::ResultName::PositionZ};
inline constexpr ir::ResultName kErrors[] = {ir::ResultName::ErrorX, ir::ResultName::ErrorY,
                                             ir::ResultName::ErrorZ};

// What is set: for each axis the measured value and the coordinate that it gets.
struct Setting {
  std::string system;
  std::array<std::string, 3> nominal; // "": the axis is not set
};
void writeSetting(State& state, const Setting& setting, const std::array<std::string, 3>& found,
                  const ir::Origin& origin);

// One call by the parameters that it is given.
class MeasureCall {
public:
  MeasureCall(State& state, const ir::CallCycle& call, const ir::Origin& origin)
      : state_(state), call_(call), origin_(origin), range_(origin.range()) {}

  void write();

private:
  using Role = stdlib::ArgumentRole;

  const ir::CycleArgument* find(const std::string& parameter);
  const ir::CycleArgument* find(Role role) { return find(std::string(stdlib::roleName(role))); }
  const ir::CycleArgument* find(Role role, ir::Axis axis) {
    return find(std::string(stdlib::roleName(role)) + " " + smallLetter(axis));
  }
  std::string text(const ir::CycleArgument* argument, ir::Kind kind = ir::Kind::Length);
  static ir::Coordinate coordinate(const ir::CycleArgument& argument);
  // Whatever was not looked at has no counterpart; false: refused.
  bool tookAll();
  // `expected`: where the feature is, along each axis.
  std::optional<Setting> setting(const std::array<std::string, 3>& expected);
  void alarmBeyond(const std::string& value, const std::string& limit, std::string_view message);
  void alarmOutside(const std::vector<ir::Axis>& axes, const std::array<std::string, 3>& found,
                    const std::array<std::string, 3>& expected, const std::string& zone);
  // Where it begins gets a name: what follows leads away from there.
  void keepHere(const std::vector<ir::Axis>& axes);
  // Arguments for the way down beside a feature, "depth = .., clearance = ..". "": refused.
  std::string wayDown();

  // ---- Measures.cpp: along axes
  void surface();
  void innerCorner();
  void hollow(const std::string& cycle, const std::vector<ir::Axis>& axes, bool beside);
  void walls(const std::vector<ir::Axis>& axes, const std::string& size, const std::string& overtravel,
             std::array<std::string, 3>& found);

  // ---- Oblique.cpp: at angles
  void angledSurface();
  void angledPair(bool beside);
  void threePoints(bool beside);
  void faceAngle();
  void leavesRound(const std::array<std::string, 2>& centre, const std::string& size,
                   const std::string& wanted);

  State& state_;
  const ir::CallCycle& call_;
  const ir::Origin& origin_;
  const SourceRange range_;
  std::set<std::string> known_;
};

} // namespace dotek::backends::cycle
