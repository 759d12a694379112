// Cycles written for Mikroprog, read back, and run against a part.
#pragma once

#include "FanucHelper.h"
#include "backends/mikroprog/Emit.h"
#include "frontend/mikroprog/Check.h"
#include "frontend/mikroprog/Lower.h"
#include "frontend/mikroprog/Parse.h"
#include "sim/machine/Run.h"
#include "sim/mikroprog/Dialect.h"
#include "stdlib/MikroprogControl.h"

#include <cmath>

namespace dotek::tests {

inline stdlib::MikroprogControl loadMikroprog(std::string_view name) {
  auto out = stdlib::MikroprogControl::load(stdlib::DataFiles(), name);
  REQUIRE(out);
  return std::move(*out);
}

struct MikroprogEmission {
  std::optional<std::vector<backends::EmittedLine>> lines;
  Diagnostics diagnostics;

  std::string text() const {
    std::string out;
    if (lines)
      for (const auto& line : *lines)
        out += line.text + "\r\n";
    return out;
  }
  // Blocks without comments and numbers of blocks.
  std::vector<std::string> blocks() const {
    std::vector<std::string> out;
    if (!lines) return out;
    for (const auto& line : *lines) {
      if (!line.text.starts_with("N")) continue;
      const std::string words = line.text.substr(line.text.find(' ') + 1);
      out.push_back(words.substr(0, words.find(" ;")));
    }
    return out;
  }
  bool has(std::string_view block) const {
    const auto all = blocks();
    return std::find(all.begin(), all.end(), block) != all.end();
  }
  std::set<std::string> codes() const {
    std::set<std::string> out;
    for (const Diagnostic& d : diagnostics.all())
      out.emplace(d.code);
    return out;
  }
};

// What to emit with; the profile lives as long as it does.
struct MikroprogTarget {
  stdlib::MikroprogControl control;
  backends::mikroprog::EmitOptions options;

  explicit MikroprogTarget(std::string_view name = "mikroprog-mill")
      : control(loadMikroprog(name)), options{control, "TEST", {}, {}, {}, false, {}, false, {}} {
    options.hosts = {{"tool_radius", 3}, {"overtravel", 5}, {"return_feed", 1000},
                     {"clearance", 5},   {"start_x", -10},  {"start_y", 10}};
  }
  MikroprogTarget(const MikroprogTarget&) = delete;
  MikroprogTarget& operator=(const MikroprogTarget&) = delete;

  MikroprogEmission emit(const ir::Cycle& cycle) const {
    MikroprogEmission out;
    out.lines = backends::mikroprog::emit(cycle, options, out.diagnostics);
    CHECK(out.lines.has_value() == !out.diagnostics.hasErrors());
    return out;
  }
};

// A program as it is read; what the control would refuse goes to `findings`.
inline ir::Program readBack(const std::string& text, const stdlib::MikroprogControl& control,
                            SourceMap& sources, std::set<std::string>* findings = nullptr) {
  Diagnostics diagnostics;
  const FileId file = sources.add(SourceFile("test.suf", text, Encoding::Cp852));
  const auto program = frontend::mikroprog::parse(file, sources, diagnostics);
  if (findings != nullptr) frontend::mikroprog::refuse({program, control, sources}, diagnostics);
  for (const Diagnostic& d : diagnostics.all())
    if (findings != nullptr) findings->emplace(d.code);
  auto out = frontend::mikroprog::lower(program, sources);
  REQUIRE_MESSAGE(out, text);
  return std::move(out->programs.front());
}

// A program on the machine of its control, with what it does beside moving.
struct MikroprogRun : sim::MotionWatcher {
  struct Record {
    bool isValue = false;
    double value = 0;
  };

  const stdlib::MikroprogControl control;
  SourceMap sources;
  ir::Program program;
  sim::mikroprog::Profile profile;
  sim::Machine machine;
  sim::Bytecode code;
  Limits limits;
  std::optional<sim::Run> run;
  std::vector<Record> records;
  std::vector<std::string> stops;
  std::size_t datums = 0;

  MikroprogRun(const std::string& text, stdlib::MikroprogControl of)
      : control(std::move(of)), program(readBack(text, control, sources)), profile(control),
        machine(profile.machine, profile.dialect), code(sim::mikroprog::compile(program, profile, sources)) {
    machine.setWatcher(this);
  }
  sim::Ending ending() const { return machine.end().ending; }
  const std::string& why() const { return machine.end().text; }
  std::uint32_t line() const { return sources.line(run->place()); }
  std::string lastStop() const { return stops.empty() ? "" : stops.back(); }
  void start() { run.emplace(machine, code, limits).run(); }

  void moved(const sim::MachineMotion&) override {}
  void positionSet() override { ++datums; }
  void paused(std::string_view text) override { stops.emplace_back(text); }
  void recorded(std::string_view, std::optional<double> value) override {
    records.push_back({value.has_value(), value.value_or(0)});
  }
};

// A block of material between `low` and `high`, in coordinates of the machine at which the probe has contact.
struct Box : sim::SkipSignal {
  std::array<double, 3> low{-1e6, -1e6, -1e6}, high{1e6, 1e6, 1e6};

  std::optional<double> contact(const sim::SkipMove& move) override {
    double enter = 0, leave = 1;
    bool outward = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const double from = move.machineFrom[i], way = move.machineTo[i] - from;
      if (from < low[i] - 1e-9 || from > high[i] + 1e-9) {
        if (way == 0) return std::nullopt;
      } else if ((std::abs(from - low[i]) < 1e-9 && way < 0) ||
                 (std::abs(from - high[i]) < 1e-9 && way > 0)) {
        outward = true;
      }
      if (way == 0) continue;
      const double a = (low[i] - from) / way, b = (high[i] - from) / way;
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (outward || enter > leave) return std::nullopt;
    return enter;
  }
};

// The wall of a bore, where the ball's centre has contact at `reach` from the middle.
struct Ring : sim::SkipSignal {
  double x = 0, y = 0, reach = 0, top = 0;

  std::optional<double> contact(const sim::SkipMove& move) override {
    const double fx = move.machineFrom[0] - x, fy = move.machineFrom[1] - y;
    const double dx = move.machineTo[0] - move.machineFrom[0], dy = move.machineTo[1] - move.machineFrom[1];
    const double a = dx * dx + dy * dy;
    if (move.machineTo[2] > top || a == 0) return std::nullopt;
    const double b = fx * dx + fy * dy, c = fx * fx + fy * fy - reach * reach;
    const double share = (-b + std::sqrt(b * b - a * c)) / a;
    const bool inward = c > -1e-6 && b < 0;
    return share >= 0 && share <= 1 && !inward ? std::optional(share) : std::nullopt;
  }
};

} // namespace dotek::tests
