// The probing macros that a run may call: by their text, where Dotek has it, else by their meaning.
#pragma once

#include "project/ProgramLibrary.h"
#include "project/Session.h"
#include "sim/picture/Picture.h"
#include "sim/vendor/VendorMacros.h"
#include "stdlib/Control.h"
#include "stdlib/MacroSet.h"

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace dotek::sim {

using project::ProgramLibrary;
using project::Session;

class SimMacros final : public MacroMeaning {
public:
  // `chosen`: the only set that counts; nothing: all. nullptr: there is no such set, reported. Sets with a
  // text give it to the library where one of its programs calls them and has no program of that number.
  // `all`: the sets are kept although nothing calls them without a program, for kindOf().
  static std::unique_ptr<SimMacros> load(const std::optional<std::string>& chosen, bool all,
                                         const stdlib::Control& control, ProgramLibrary& library,
                                         Session& session);

  // What the skip moves of a call are for, by the signatures; nothing: no set has the program.
  std::optional<PathKind> kindOf(std::uint32_t program, std::span<const double> locals) const;
  // What a call found whose macro ran by a text of Dotek's; nothing: it has none, or measures nothing.
  std::optional<Measurement> foundBy(std::uint32_t program, std::span<const double> locals,
                                     const Machine& machine) const;
  // Of a stylus that was calibrated, mm; the variables of a set go first.
  void setStylusRadius(double radius);

  bool knows(std::uint32_t program) const override;
  // Several sets that know the program: inconclusive.
  bool run(Machine& machine, std::uint32_t program, std::span<const double> locals) override;

private:
  std::vector<const stdlib::MacroSet*> sets_; // of the session
  MeasuringCycles cycles_;                    // that say what their calls measure
  std::deque<VendorMacros> meanings_;         // of the sets without a text
  std::set<std::uint32_t> texts_; // programs of sets with a text that the programs do not bring themselves
};

} // namespace dotek::sim
