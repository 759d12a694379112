// Private to the verification of programs: TargetVerify.cpp runs and compares one case, TargetCallers.cpp
// calls the program otherwise, TargetArguments.cpp with other arguments.
#pragma once

#include "backends/fanuc/TargetText.h"
#include "backends/fanuc/TargetVerify.h"
#include "sim/vendor/VendorMacros.h"
#include "targets/Stage.h"
#include "verify/Callers.h"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace dotek::targets {

constexpr std::uint32_t kOwnAlarms = 3000; // of programs

class FanucVerification final : public Verification {
public:
  explicit FanucVerification(const VerificationSource& source);
  bool takesTies() const override { return true; }
  bool meetsLimitsAlike() const override { return comparesExactly() && sourceSet_ == set_; }
  bool prepare() override;
  TargetRun run(const TargetCase& now) override;

private:
  verify::Entry entryOf(const TargetCase& now) const;
  void addArguments(const verify::Case& drawn, verify::Entry& entry) const;
  // `trace`: nullptr: nobody reads it.
  verify::Record runText(const TargetCase& now, const verify::Entry& entry, std::string* trace,
                         verify::Stand::Way way = verify::Stand::Way::Run,
                         const verify::Interference& interference = {});
  // The same on another part.
  verify::Record runIn(sim::World& world, const TargetCase& now, const verify::Entry& entry);
  void add(std::vector<verify::Difference> found, TargetRun& out) const;
  std::string rejects() const;
  // The dialog has rejected the values: the translation raises an alarm, and nothing has moved.
  void compareRejection(const verify::Record& record, const TargetCase& now, TargetRun& out) const;
  // Without a Prog: the path and the touches alone.
  void comparePath(const TargetCase& now, const verify::Record& record, TargetRun& out) const;
  // It goes back to its caller and leaves him what he had in force.
  void compareReturn(const verify::Record& record, const verify::Record* source, TargetRun& out) const;
  verify::CompareRules rulesFor(const TargetCase& now, const verify::Record& source) const;
  // Of a run of the source with other values: its places are those of another posted text.
  verify::CompareRules rulesElsewhere(const TargetCase& now, const verify::Record& source) const;
  bool searchesOn(const verify::Record& source, const verify::Record& record,
                  const verify::CompareRules& rules) const;
  void compareRecords(const TargetCase& now, const verify::Record& record, TargetRun& out) const;

  // ---- callers who break what it demands
  static bool setsSomething(const verify::Record& record, const verify::Entry& entry);
  // An alarm before anything moves or is set; `text`: which one, as far as the control shows it; "": any.
  bool stopsAtOnce(const verify::Record& record, const verify::Entry& entry, std::string_view text) const;
  static std::string didInstead(const verify::Record& record);
  void differs(const std::string& who, const std::string& wanted, const verify::Record& record,
               TargetRun& out);
  // The first caller who sees a difference, of the last run.
  void noteCaller(const std::string& who);
  void callOtherwise(const TargetCase& now, const verify::Entry& entry, const verify::Record& ran,
                     TargetRun& out);
  // From the same place, with another work system or tool length in force than the source selects.
  void callFromOthers(const TargetCase& now, const verify::Entry& entry, TargetRun& out);
  // Where convert has the program ask for its start, by axis.
  std::map<char, double> fixedStarts() const;
  void callWithExternal(const TargetCase& now, const verify::Entry& entry, TargetRun& out);
  // Common variables that nothing of the source writes, and no contract has it write.
  void compareStrays(const TargetCase& now, const verify::Record& record, TargetRun& out) const;
  bool comparesExactly() const;
  bool loadsTool(const TargetCase& now) const;
  const verify::DrawField* fieldOf(const std::string& name) const;
  std::optional<double> defaultOf(const verify::DrawField& field) const;
  // Where the argument is left out: an alarm if it moves something, else the default.
  void callWithout(const OutputArgument& argument, const TargetCase& now, const verify::Entry& entry,
                   TargetRun& out);
  // A tolerance may let both pass: what the program counts with is the same as with the default given. One
  // that is left out and stays null has no default to be another one.
  void compareDefault(const OutputArgument& argument, double value, const verify::Entry& without,
                      const verify::Record& ran, const TargetCase& now, TargetRun& out);
  // Where `G43 H` takes the argument: an offset that is not above 0 has to be an alarm before it is taken.
  void callWithNoOffset(const OutputArgument& argument, const TargetCase& now, const verify::Entry& entry,
                        TargetRun& out);
  // Of a cycle: beside the tool offsets that the control has, and between two of them.
  void callWithTools(const verify::DrawField& field, const TargetCase& now, const verify::Entry& entry,
                     TargetRun& out);
  // Where a check that reads the argument turns, and a step beside it: it does the same with the default
  // given.
  void callAtBounds(const OutputArgument& argument, const verify::DrawField& field, double value,
                    const TargetCase& now, const verify::Entry& entry, TargetRun& out);
  static std::string endingOf(const verify::Record& record);
  // Beside the six work systems, and between two of them.
  void callWithSystems(const verify::DrawField& field, const TargetCase& now, const verify::Entry& entry,
                       TargetRun& out);
  // Values that the list of the dialog does not offer: an alarm each.
  void callBesideList(const verify::DrawField& field, const TargetCase& now, const verify::Entry& entry,
                      TargetRun& out);
  // A macro that the source calls has set this system.
  static bool setsByCall(const TargetCase& now, std::uint32_t system);
  // The system that is in force: what comes after is moved by what was set.
  void callWithActive(const verify::DrawField& field, char letter, const TargetCase& now,
                      const verify::Entry& entry, TargetRun& out);

  const VerificationSource from_;
  const Translation& translation_;
  const stdlib::Control control_;
  const stdlib::MacroSet *sourceSet_, *set_;
  const sim::MeasuringCycles measuring_; // that their calls stand for
  const bool macrosHaveText_;            // those of `set_`, which run by it
  const Limits limits_ = limitsOfRun(from_.session.limits());
  verify::Stand stand_;
  FanucText text_;
  std::map<std::uint32_t, std::uint32_t> stored_; // common variables, by number the line
  // For a picture: what ran last, and the caller of the first difference.
  std::optional<verify::Entry> ran_;
  std::optional<std::pair<std::string, verify::Entry>> differing_;
  std::set<char> atBounds_; // letters of arguments whose defaults were looked at where checks turn
};

} // namespace dotek::targets
