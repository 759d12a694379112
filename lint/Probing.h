// What the statements of a program or a cycle mean to a probe.
#pragma once

#include "ir/Dataflow.h"
#include "lint/Project.h"
#include "stdlib/ReadCall.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <vector>

namespace dotek::lint {

// What one statement does, as far as the data of controls and macro sets tell.
struct ProbeStep {
  enum class Kind : std::uint8_t {
    None,
    On,        // probe switched on
    Off,       // probe switched off
    Protected, // move that stops at a contact
    Measure,
    PackCall, // a call of a macro of the same pack whose meaning is not known: may do anything
    OwnCall,  // a call of a program of these files that switches no probe, nor calls one that may
    Call,     // another call: may do anything
  };
  Kind kind = Kind::None;
  std::uint32_t program = 0; // of a call
};

// AsBefore: nothing has switched it yet. Mixed: paths disagree, or a call may have switched it.
enum class ProbeState : std::uint8_t { AsBefore, Off, On, Mixed };

// Whether a call with these letters can be one of the set: letters that its signatures do not have are
// optional ones of the vendor's. Another vendor may have a macro of the same number.
bool mayBeOf(const stdlib::MacroSet& set, std::uint32_t program, std::string_view letters);

// The call as the set reads it, each letter once and those aside that no signature of the program has.
stdlib::CallReading readKnown(const stdlib::MacroSet& set, std::uint32_t program, std::string_view letters);

class Probing {
public:
  explicit Probing(const Project& project);

  ProbeStep step(const ir::CycleStatement& statement) const;
  ProbeStep step(const ir::ProgramStatement& statement) const;
  // State before each statement; nothing where no path leads. Of a program NcProgram keeps it; `flow` is that
  // of the body.
  std::vector<std::optional<ProbeState>> states(const std::vector<ir::CycleStatement>& body) const;
  std::vector<std::optional<ProbeState>> states(const std::vector<ir::ProgramStatement>& body,
                                                const ir::ProgramFlow& flow) const;
  // Calls some macro of a probing set.
  bool probes(const ir::Program& program) const;
  // The program is one of these files, and a G31 is in it or in one that it calls.
  bool skips(std::uint32_t program) const { return skipping_.contains(program); }
  // A program of these files has this number.
  bool isOwn(std::uint32_t program) const { return own_.contains(program); }
  // It is one of these files, and has a move along Z alone after its last G31 or measurement.
  bool liftsAfter(std::uint32_t program) const { return lifting_.contains(program); }

private:
  ProbeStep::Kind codeStep(double code) const;
  ProbeStep blockStep(const ir::NcBlock& block) const;
  ProbeStep callStep(const ir::Call& call) const;
  template <ir::AnyStatement Statement> ProbeStep stepOf(const Statement& statement) const;
  template <ir::AnyStatement Statement>
  std::vector<std::optional<ProbeState>> statesOf(const std::vector<Statement>& body,
                                                  const ir::ProgramFlow& flow) const;

  void readOwn();

  const Project& project_;
  // Programs of the files: without a switch, with a G31, with a move along Z after it.
  std::set<std::uint32_t> quiet_, skipping_, lifting_;
  std::set<std::uint64_t> own_; // all of them, also those that could not be lowered
  // Without --control a code of the builder counts as the one known profile that has it says, where the files
  // probe at all: M31 is a conveyor elsewhere.
  bool guessCodes_ = false;
};

// Computed once a project.
const Probing& probingOf(const Project& project);

using ir::endsProgram;
// M30 or M2 is somewhere in it.
bool endsProgram(const ir::Program& program);

// All programs of all files that could be lowered, up to 20000 statements each.
void eachProgram(const Project& project,
                 const std::function<void(const ir::Program&, const macrob::File&)>& visit);

// Values of the words of a block as far as they are written out.
std::optional<double> wordValue(const ir::NcBlock& block, char address);
bool hasWord(const ir::NcBlock& block, char address);
bool hasCode(const ir::NcBlock& block, char address, double code);
// A measurement with Z, of a face from above or of a boss: it comes back to where it began, above what it
// touched. Of a cycle, whose moves say it: no.
bool endsAbove(const ir::ProgramStatement& statement);
bool endsAbove(const ir::CycleStatement& statement);
// #n of a variable whose number is written out.
std::optional<std::uint32_t> variableNumber(const ir::Expression& expression);
std::optional<std::uint32_t> storedNumber(const ir::ProgramStatement& statement);
// Numbers of the variables that the statement reads, with their places.
void eachRead(const ir::ProgramStatement& statement,
              const std::function<void(std::uint32_t number, SourceRange range)>& visit);
// As above, and those whose number is computed.
void eachRead(const ir::ProgramStatement& statement,
              const std::function<void(std::uint32_t number, SourceRange range)>& visit,
              const std::function<void(const ir::MachineVariable&)>& computed);

} // namespace dotek::lint
