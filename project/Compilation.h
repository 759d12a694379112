// What belongs together, read once and lowered once: the view that convert, lint, verify and dump share.
#pragma once

#include "frontend/compost/Ast.h"
#include "frontend/gibbs/Ast.h"
#include "frontend/macrob/Ast.h"
#include "frontend/macrob/Forms.h"
#include "ir/Program.h"
#include "project/CallsAs.h"
#include "project/CycleFolder.h"
#include "project/InputKind.h"
#include "project/Lowering.h"
#include "project/Session.h"
#include "stdlib/Control.h"

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dotek::project {

// Used by one thread. What it hands out stays as long as it does.
class Compilation {
public:
  explicit Compilation(Session& session) : session_(session) {}
  Compilation(const Compilation&) = delete;
  Compilation& operator=(const Compilation&) = delete;

  Session& session() const { return session_; }

  // All profiles of controls, by name, with these codes of the probe; loaded when first asked for.
  const std::vector<stdlib::Control>& controls(const stdlib::ProbeCodes& probe);

  // Under which settings cycles are lowered; reads the Prog of the command line. nullptr: a flag, the Prog or
  // a data file has a defect, reported.
  LoweringInputs* load(const SourceOptions& source, const std::string& control);
  // What calls in files of the cycle language become from now on.
  void callAs(const CallsAs& calls) { calls_ = calls; }
  // Before it, where files of the cycle language are among the inputs.
  void takeLiterals() { sets_ = SetTexts::Literals; }
  // Without the controls and before the Prog, for who runs a cycle instead of lowering it; then the Prog.
  LoweringInputs* loadSettings(const SourceOptions& source);
  bool loadProg(const SourceOptions& source); // false: reported

  // Reads inputs as trees; what is wrong with them is reported, without `checked` only what keeps them from
  // being read. nullptr: the file cannot be read.
  const frontend::compost::Program* addProg(const std::string& path, bool checked = true);
  CycleFolder& addFolder(const std::string& path, bool checked = true);
  const frontend::gibbs::Macro& addMacro(FileId file);
  const frontend::gibbs::Dialog& addDialog(FileId file);
  const frontend::gibbs::DefineData& addDefineData(FileId file);
  const frontend::macrob::File& addPrograms(FileId file, frontend::macrob::Forms forms = {},
                                            frontend::macrob::Keep keep = frontend::macrob::Keep::All);

  // The same, in the order in which they were added.
  const std::deque<std::shared_ptr<const frontend::compost::Program>>& progs() const { return progs_; }
  std::deque<CycleFolder>& folders() { return folders_; }
  const std::deque<frontend::gibbs::Macro>& macros() const { return macros_; }
  const std::deque<frontend::gibbs::Dialog>& dialogs() const { return dialogs_; }
  const std::deque<frontend::gibbs::DefineData>& defines() const { return defines_; }
  const std::deque<frontend::macrob::File>& programs() const { return programs_; }

  // The one lowering of a cycle, under the settings of load(). nullopt: it has no single meaning; reported by
  // a strict one.
  std::optional<LoweredCycle> lower(const CycleFolder& folder, Strictness strictness = Strictness::Strict);
  // The same with another Prog than that of the command line and with this routine of it.
  std::optional<LoweredCycle> lower(const CycleFolder& folder,
                                    std::shared_ptr<const frontend::compost::Program> prog,
                                    const frontend::compost::Routine& routine, Strictness strictness);
  // A file of the cycle language, with the values of --set, --host and the job. nullopt: it has a defect,
  // reported.
  std::optional<LoweredCycle> lowerFile(const std::string& path, const SourceOptions& source);
  // A file of the cycle language beside the folders; lower() takes it as it takes them.
  CycleFolder& addFile(const std::string& path);
  // The file that the folder stands for; nullptr: it is a folder.
  const std::string* fileOf(const CycleFolder& folder) const;
  // Names of --set that some cycle knows which was lowered.
  std::set<std::string>& usedSets() { return usedSets_; }
  // Programs as this control reads them, or, without one, as the first that can, for rules. nullptr: none
  // can.
  std::shared_ptr<const ir::ProgramFile> lower(const frontend::macrob::File& file,
                                               const stdlib::Control* control);

private:
  Session& session_;
  std::map<stdlib::ProbeCodes, std::vector<stdlib::Control>> controls_;
  std::optional<LoweringInputs> inputs_;
  SetTexts sets_ = SetTexts::Numbers;
  std::deque<std::shared_ptr<const frontend::compost::Program>> progs_;
  std::deque<CycleFolder> folders_;
  std::deque<frontend::gibbs::Macro> macros_;
  std::deque<frontend::gibbs::Dialog> dialogs_;
  std::deque<frontend::gibbs::DefineData> defines_;
  std::deque<frontend::macrob::File> programs_;
  std::map<const CycleFolder*, std::string> cycleFiles_;
  std::set<std::string> usedSets_;
  CallsAs calls_;
};

} // namespace dotek::project
