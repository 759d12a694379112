// Called cycles as programs of the file whose program calls them (--calls subprogram).
#pragma once

#include "backends/fanuc/Emit.h"
#include "project/Lowering.h"
#include "targets/Conversion.h"
#include "targets/KeptResults.h"

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dotek::targets {

// A cycle of the language, with those that it calls, has more names than a control has locals: where they do
// not do, names share one that are not needed at the same time.
std::optional<std::vector<backends::EmittedLine>>
emitSharing(const ir::Cycle& cycle, const backends::fanuc::EmitOptions& emit, bool mayShare,
            const SourceMap& sources, Diagnostics& diagnostics,
            std::vector<backends::fanuc::Argument>& letters, std::uint32_t* alarms = nullptr);

// So deep calls of cycles are programs: what the control leaves beside the program itself and the levels
// that the macros of a set need. A deeper one has its cycle in its place.
std::uint32_t programLevels(const stdlib::Control& control);

// The programs that one cycle calls.
class CalledPrograms {
public:
  CalledPrograms(LoweredCycle& lowered, ConversionContext& context, const stdlib::MacroSet& macros);

  // Numbers from `first` on; results of the called cycles go to common variables. `stored`: of --result,
  // names of values for later runs that a called cycle keeps. false: reported.
  bool prepare(std::uint32_t first, KeptResults& results);
  bool empty() const { return used_.empty(); }
  // Values for later runs that called cycles keep, by name.
  std::set<std::string> stored() const;
  // The options of the program that calls them. false: reported.
  bool addTo(backends::fanuc::EmitOptions& emit);
  // After the program that has so many alarms. false: reported.
  bool append(const backends::fanuc::EmitOptions& emit, std::uint32_t alarms,
              std::vector<backends::EmittedLine>& lines);

  std::uint32_t count() const { return static_cast<std::uint32_t>(used_.size()); }
  const std::set<std::uint32_t>& handedBack() const { return handedBack_; }

private:
  struct One {
    LoweredProgram* lowered = nullptr;
    std::vector<std::string> remarks;
    bool done = false; // its letters are known
  };
  void reach(ir::Cycle& cycle);
  bool takeVariables();
  void name(ir::Cycle& cycle) const;
  void markMoving(ir::Cycle& cycle) const;
  bool learn(std::size_t index, const backends::fanuc::EmitOptions& emit);
  backends::fanuc::EmitOptions optionsOf(std::size_t index, const backends::fanuc::EmitOptions& emit) const;

  LoweredCycle& lowered_;
  ConversionContext& context_;
  const stdlib::MacroSet& macros_;
  std::vector<std::size_t> used_; // in the order in which they are called first
  std::vector<One> all_;
  std::vector<backends::fanuc::CalledProgram> programs_; // by index in LoweredCycle::programs
  std::vector<std::uint32_t> variables_;                 // of results, by their place
  std::set<std::uint32_t> handedBack_;
};

} // namespace dotek::targets
