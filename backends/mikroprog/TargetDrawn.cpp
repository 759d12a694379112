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
  frontend::gibbs::RunContext context{
      session.sources(),
      session.gibbsKeywords(),
      session.limits(),
      session.diagnostics(),
      fields.macroValues(),
      hosts,
      session.options().assume,
      [&](const std::string& name, SourceRange where) { return folder.loader->macro(name, where); },
      [&](const std::string& name, SourceRange where) { return folder.loader->dialog(name, where); },
      &folder.loader->programs()};
  // Paths count from the retract plane, which a macro that writes places takes off again.
  const double plane = hosts.contains("retract") ? hosts.at("retract") : hosts.at("clearance");
  context.hosts.emplace("retract", plane);
  const auto moves = frontend::gibbs::runToolPath(*folder.cycle->toolPath, context);
  if (!moves) return {};
  const verify::DrawnPath path = verify::drawnPath(*moves, {hosts.at("start_x"), hosts.at("start_y"), plane},
                                                   plane, hosts.at("tool_radius"));
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
