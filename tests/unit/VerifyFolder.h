// A cycle folder whose cases are drawn, for tests of the drawing.
#pragma once

#include "frontend/gibbs/Run.h"
#include "project/CycleFolder.h"
#include "verify/Draw.h"

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dotek::tests {

// A ball on a stem with a body, as the cases of these tests have it.
inline sim::Probe drawnProbe(double ballRadius) {
  sim::Probe probe;
  probe.ballDiameter = 2 * ballRadius;
  probe.effectiveRadius = ballRadius;
  probe.stemDiameter = 1.4 * ballRadius;
  probe.stemLength = 50;
  probe.bodyDiameter = 40;
  probe.bodyLength = 60;
  return probe;
}

class VerifyFolder {
public:
  explicit VerifyFolder(const std::string& path)
      : session_(options_), folder_(project::loadCycleFolder(path, session_)) {}

  std::vector<verify::DrawField> fields() const {
    std::vector<verify::DrawField> out;
    for (const frontend::gibbs::Field& each : frontend::gibbs::declaredFields(*folder_.cycle)) {
      verify::DrawField field;
      field.name = each.name.text;
      field.initial = each.value;
      field.decimals = 2;
      if (field.name == "G") field.kind = ir::Kind::WorkOffset;
      out.push_back(std::move(field));
    }
    return out;
  }
  verify::Draws draws(std::uint64_t seed) const {
    return {fields(), {"tool_radius", "retract", "clearance", "start_x", "start_y", "start_z"}, {}, seed};
  }

  bool passes(const verify::Case& drawn) {
    auto context = running(drawn);
    return frontend::gibbs::runChecks(*folder_.cycle->cycleData, context).verdict ==
           frontend::gibbs::ChecksResult::Verdict::Passes;
  }
  // nullopt: it could not be computed.
  std::optional<std::vector<frontend::gibbs::PathMove>> moves(const verify::Case& drawn) {
    auto context = running(drawn);
    return frontend::gibbs::runToolPath(*folder_.cycle->toolPath, context);
  }
  static verify::DrawnPath path(const std::vector<frontend::gibbs::PathMove>& moves,
                                const verify::Case& drawn) {
    const auto host = [&](const char* name) { return drawn.hosts.at(name); };
    return verify::drawnPath(moves, {host("start_x"), host("start_y"), host("start_z")}, host("retract"),
                             host("tool_radius"));
  }
  // Settles the hosts; "" or why this case is none.
  std::string judge(verify::Case& drawn, const verify::Draws& draws) {
    if (!passes(drawn)) return "checks";
    const auto made = moves(drawn);
    if (!made) return "no path";
    draws.settleHosts(drawn, path(*made, drawn));
    const verify::DrawnPath drawnPath = path(*made, drawn);
    return reached(drawnPath, drawn);
  }
  static std::string reached(const verify::DrawnPath& drawnPath, const verify::Case& drawn) {
    const double radius = drawn.hosts.at("tool_radius");
    const auto touches = drawnPath.nominal();
    const auto part = verify::partOf(touches, radius, radius, {});
    if (!part) return "no part";
    const sim::Probe probe = drawnProbe(radius);
    if (std::string why = verify::whyNotReached(drawnPath, *part, probe); !why.empty()) return why;
    const std::string why = verify::whyNotReached(drawnPath, verify::withError(*part, touches, drawn.error),
                                                  probe, verify::mostOff(touches, drawn.error));
    return why.empty() ? "" : "off its place: " + why;
  }

private:
  frontend::gibbs::RunContext running(const verify::Case& drawn) {
    std::map<std::string, double> folded;
    for (const auto& [name, value] : drawn.values)
      folded[frontend::gibbs::foldCase(name)] = value;
    return {
        session_.sources(),
        session_.gibbsKeywords(),
        session_.limits(),
        session_.diagnostics(),
        folded,
        drawn.hosts,
        {},
        [this](const std::string& name, SourceRange where) { return folder_.loader->macro(name, where); },
        [this](const std::string& name, SourceRange where) { return folder_.loader->dialog(name, where); }};
  }

  project::CommonOptions options_;
  project::Session session_;
  project::CycleFolder folder_;
};

} // namespace dotek::tests
