// Runs the call of a measured feature on a stand: by the meaning of its macro, or by the text of our own.
#pragma once

#include "frontend/macrob/Lower.h"
#include "frontend/macrob/Parse.h"
#include "sim/machine/Compile.h"
#include "sim/vendor/VendorMacros.h"
#include "stdlib/DataFiles.h"
#include "tests/MeasuringCycles.h"
#include "tests/unit/MeasuredFeatures.h"
#include "verify/Stand.h"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <vector>

namespace dotek::tests {

struct MeasuredProbe {
  double noise = 0, preTravel = 0;
  std::uint64_t seed = 0;
};

class MeasuredRunner {
public:
  // `set`: a macro set; `text`: of macros that run by it, "" for those that run by their meaning.
  MeasuredRunner(const std::string& control, const std::string& set, const std::string& text = "")
      : control_(*stdlib::Control::load(stdlib::DataFiles(), control)),
        set_(*stdlib::MacroSet::load(stdlib::DataFiles(), set)), stand_(control_, {&set_}, limits_) {
    limits_.simSteps = 20000;
    if (!text.empty()) macros_ = read(text);
  }
  MeasuredRunner(const MeasuredRunner&) = delete;
  MeasuredRunner& operator=(const MeasuredRunner&) = delete;

  const std::string& set() const { return set_.name; }
  bool readable() const { return readable_; } // the text of the macros
  // Where results go: #551 and the following, in the order of the feature.
  static constexpr std::uint32_t kResults = 551;

  // The feature's call, then its results. nullopt: the set has no such call.
  std::optional<verify::Record> run(const MeasuredFeature& feature, const MeasuredProbe& probe = {},
                                    sim::Trace* trace = nullptr) {
    const auto call = feature.calls.find(set_.name);
    if (call == feature.calls.end()) return std::nullopt;
    std::string blocks = call->second + "\n";
    std::set<std::uint32_t> stores;
    if (set_.name != "easyprobe")
      for (const MeasuredResult& result : feature.results) {
        const auto to = kResults + static_cast<std::uint32_t>(stores.size());
        blocks += fmt::format("#{}=#{}\n", to, result.variable);
        stores.insert(to);
      }
    sim::World world(feature.part, probeOf(feature, probe));
    return run(blocks, feature.start, stores, world, feature.ball - probe.preTravel, probe.seed, trace);
  }

  verify::Record run(const std::string& blocks, const sim::Point3& start,
                     const std::set<std::uint32_t>& stores, sim::World& world, double radius,
                     std::uint64_t seed = 0, sim::Trace* trace = nullptr) {
    const std::optional<ir::ProgramFile> main = read("O1\n" + blocks + "M30\n");
    REQUIRE(main);
    std::vector<const ir::Program*> programs = {&main->programs.front()};
    if (macros_)
      for (const ir::Program& program : macros_->programs)
        programs.push_back(&program);
    const sim::Bytecode code = sim::compile(programs, control_, sources_);
    verify::Entry entry;
    entry.start = start;
    entry.probeOn = true;
    entry.noiseSeed = seed;
    if (set_.needsSkipPosition) entry.variables = {{520, radius}};
    sim::VendorMacros meaning(set_, control_, measuringCycles());
    meaning.setStylusRadius(radius);
    stand_.setTrace(trace);
    return stand_.run(code, world, entry, stores, &meaning);
  }

  static sim::Probe probeOf(const MeasuredFeature& feature, const MeasuredProbe& wanted = {}) {
    sim::Probe out;
    out.ballDiameter = 2 * feature.ball;
    out.effectiveRadius = feature.ball;
    out.length = verify::kToolLength;
    out.stemDiameter = feature.ball;
    out.stemLength = 60;
    out.bodyDiameter = 40;
    out.bodyLength = 50;
    out.preTravel = wanted.preTravel;
    out.noise = wanted.noise;
    out.overtravel = wanted.preTravel + 4 * wanted.noise;
    return out;
  }

private:
  std::optional<ir::ProgramFile> read(const std::string& text) {
    const FileId id = sources_.add(SourceFile("test", text, Encoding::Utf8));
    Diagnostics found;
    const frontend::macrob::File tree = frontend::macrob::parse(id, sources_, limits_, found);
    std::optional<ir::ProgramFile> file;
    if (!found.hasErrors()) file = frontend::macrob::lower(tree, control_, sources_, found);
    readable_ = file.has_value();
    return file;
  }

  const stdlib::Control control_;
  const stdlib::MacroSet set_;
  Limits limits_;
  SourceMap sources_;
  bool readable_ = true;
  std::optional<ir::ProgramFile> macros_;
  verify::Stand stand_;
};

// The text of our own macros.
inline std::string ownMacroText() {
  const stdlib::DataFiles files;
  const stdlib::DataFile* const file = files.find("macrob", "dotek");
  REQUIRE(file != nullptr);
  return std::string(file->text);
}

} // namespace dotek::tests
