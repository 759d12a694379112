// Surfaces that ToolPath.mac draws, for places that a travel does not state.
#include "backends/mikroprog/TargetProgram.h"
#include "project/CycleChecks.h"
#include "verify/DrawnPath.h"

#include <utility>

namespace dotek::targets {

using backends::mikroprog::DrawnSurface;

namespace {

// Nothing that is reported here is new: the checks and the path are reported where they are asked for.
class Aside {
public:
  explicit Aside(Diagnostics& diagnostics)
      : diagnostics_(diagnostics), kept_(std::exchange(diagnostics, Diagnostics())) {}
  ~Aside() { diagnostics_ = std::move(kept_); }
  Aside(const Aside&) = delete;
  Aside& operator=(const Aside&) = delete;

private:
  Diagnostics& diagnostics_;
  Diagnostics kept_;
};

} // namespace

std::vector<DrawnSurface> drawnSurfaces(const CycleFolder& folder,
                                        const std::vector<std::pair<std::string, double>>& values,
                                        const std::map<std::string, double>& hosts, Session& session) {
  if (folder.cycle == nullptr || !folder.cycle->toolPath || !folder.cycle->cycleData) return {};
  const Aside aside(session.diagnostics());
  FieldTable fields(folder, {}, session);
  for (const auto& [name, value] : values)
    fields.set(name, value, {});
  runCycleChecks(folder, fields, hosts, session, project::Blame::Nothing);
  std::map<std::string, double> given = hosts;
  // An axis that the control lacks counts for nothing. Paths count from the retract plane, which a macro that
  // writes places takes off again.
  for (const char* start : {"start_x", "start_y"})
    given.emplace(start, 0);
  const double plane = given.emplace("retract", given.at("clearance")).first->second;
  frontend::gibbs::RunContext context = project::runContext(folder, fields, given, session);
  const auto moves = frontend::gibbs::runToolPath(*folder.cycle->toolPath, context);
  if (!moves) return {};
  const verify::DrawnPath path = verify::drawnPath(*moves, {given.at("start_x"), given.at("start_y"), plane},
                                                   plane, given.at("tool_radius"));
  std::vector<DrawnSurface> out;
  for (const verify::DrawnTouch& touch : path.touches) {
    const sim::Point3 &way = touch.touch.direction, &face = touch.touch.point, &at = path.points[touch.move];
    const double along[] = {way.x, way.y, way.z}, places[] = {face.x, face.y, face.z};
    for (const ir::Axis axis : ir::kAxes) {
      const std::size_t i = ir::indexOf(axis);
      if (along[i] == 1 || along[i] == -1) out.push_back({axis, along[i] > 0, places[i], {at.x, at.y, at.z}});
    }
  }
  return out;
}

} // namespace dotek::targets
