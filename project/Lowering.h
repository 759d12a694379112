// From a cycle folder and a Prog to the IR: what convert, dump and verify begin with.
#pragma once

#include "frontend/compost/Ast.h"
#include "ir/Cycle.h"
#include "ir/PrintedText.h"
#include "project/CycleFolder.h"
#include "project/FormChoice.h"
#include "project/Job.h"
#include "project/Session.h"
#include "stdlib/Control.h"
#include "stdlib/Form.h"
#include "stdlib/MacroSet.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dotek::project {

// Profile where no --control is given.
inline constexpr std::string_view kDefaultControl = "fanuc-0i-md";

// The control of this name. nullopt: there is none, reported.
std::optional<stdlib::Control> loadControl(const std::string& name, Session& session);
// Reports codes of the user for the probe that mean something else on the control that is written.
void checkProbeCodes(const stdlib::Control& control, Session& session);

// What one command reads before its first cycle.
struct LoweringInputs {
  FormChoice formChoice; // of --prog
  std::optional<stdlib::Form> form;
  std::shared_ptr<const frontend::compost::Program> program; // nullptr: no --prog
  // --control, else the first of the target; nothing: no target is named.
  std::optional<stdlib::Control> control;
  std::optional<stdlib::Control> sourceControl; // of the machine that the post writes for
  std::optional<Job> job;
  std::map<std::string, double> givenHosts;         // --host
  std::map<std::string, double> hosts;              // the same, then the job
  std::vector<std::pair<std::string, double>> sets; // --set
  std::optional<std::string> routine;               // --routine, else the job's
  SourceRange routineAt;
  bool oneOfSeveral = false; // cycles: a name of --set or --field may be that of another one
};

// What --set may hold: numbers, or literals of the cycle language as well (`18mm`), which each input judges.
enum class SetTexts : std::uint8_t { Numbers, Literals };

// Reports and gives nothing where an option, the Prog or a data file has a defect. `control` may be "".
std::optional<LoweringInputs> loadLoweringInputs(const SourceOptions& source, const std::string& control,
                                                 Session& session, SetTexts sets = SetTexts::Numbers);
// The first half of it, what the command line and the job say and the form of --prog, without its control;
// and the Prog. false: reported.
std::optional<LoweringInputs> loadSettings(const SourceOptions& source, Session& session,
                                           SetTexts sets = SetTexts::Numbers);
bool loadProgInto(LoweringInputs& inputs, const SourceOptions& source, Session& session);

// The form of this name, and the control that it is of. What is missing is reported.
void useForm(LoweringInputs& inputs, const std::string& name, Session& session);

// A cycle that a call is a program of (frontend/cycle/Lower.h).
struct LoweredProgram {
  ir::Cycle cycle;                        // one without a name is called by none
  std::map<ir::VariableId, double> fixed; // as of LoweredCycle
  std::map<ir::VariableId, char> letters;
  std::vector<std::string> results;  // in the order of ir::handedBack()
  std::set<std::string> readResults; // those that some caller reads
};
struct CycleInPlace {
  SourceRange call;
  std::string cycle, why;
};

struct LoweredCycle {
  ir::Cycle cycle;
  const stdlib::MacroSet* macros = nullptr;  // the set that the source calls; nullptr: none
  std::map<ir::VariableId, double> fixed;    // by --set, --host, the job
  std::map<std::string, double> fixedByName; // the same, as the command line names them
  std::set<ir::VariableId> givenDefaults;    // defaults that the command line gave
  std::vector<ir::PrintedBlock> printed;     // what the Prog prints, block by block; empty without a Prog
  // Fields that CycleData.mac computes from others: locals, with the text of what is computed.
  std::map<ir::VariableId, std::string> computed;
  std::map<ir::VariableId, char> letters; // that the source wishes for arguments
  std::vector<LoweredProgram> programs;   // that ir::kProgram calls, by its number
  std::vector<CycleInPlace> inPlace;      // calls that could be none of a program
  bool checked = true; // the checks of the dialog are lowered; false of a lenient one that cannot read them
};

// Strict refuses and reports what has no single meaning, as a result that somebody runs needs it. Lenient
// reports what holds whatever the target and the values are (CertainFindings.h), and nothing else: a field
// that the folder lacks is a parameter without default, checks that cannot be read are left out, and values
// that they reject are taken. For who judges what is written.
enum class Strictness : std::uint8_t { Strict, Lenient };

// `usedSets` collects the names of --set that the cycle knows and, where it is one of several, the pairs
// POSTFIELD=VARIABLE of --field. nullopt where something has no single meaning:
// reported by a strict lowering.
std::optional<LoweredCycle> lowerCycle(const CycleFolder& folder, const LoweringInputs& inputs,
                                       std::set<std::string>& usedSets, Session& session,
                                       Strictness strictness = Strictness::Strict);

} // namespace dotek::project
