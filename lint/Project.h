// What one run of the linter looks at: all inputs of the command line as trees, cycle folders joined with the
// Progs that name them, and the IR where it can be had.
#pragma once

#include "frontend/compost/Summary.h"
#include "frontend/gibbs/Cycle.h"
#include "frontend/macrob/Ast.h"
#include "frontend/mikroprog/Reading.h"
#include "ir/Cycle.h"
#include "ir/Program.h"
#include "lint/Rule.h"
#include "project/Options.h"
#include "stdlib/ComPostKeywords.h"
#include "stdlib/Control.h"
#include "stdlib/Form.h"
#include "stdlib/GibbsKeywords.h"
#include "stdlib/MacroSet.h"
#include "support/Limits.h"

#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace dotek::project {
class Compilation;
}
namespace dotek::frontend::gibbs {
class CheckedFile;
}

namespace dotek::lint {

class Analyses;

namespace compost = frontend::compost;
namespace gibbs = frontend::gibbs;
namespace macrob = frontend::macrob;
namespace mikroprog = frontend::mikroprog;

// A cycle folder with a Prog that has a branch for it.
struct Joined {
  const gibbs::Cycle* cycle = nullptr;
  const compost::Program* prog = nullptr;
  const compost::Routine* routine = nullptr; // that posts the cycle; nullptr: none or several
  // What convert works on; nothing where the Prog's blocks have no single meaning. A field that the folder
  // lacks is a parameter without default.
  std::shared_ptr<const ir::Cycle> lowered;
  bool checksLowered = false;
};

// One file of NC programs.
struct NcFile {
  const macrob::File* file = nullptr;
  std::shared_ptr<const ir::ProgramFile> lowered; // nullptr: some block cannot be read
};

// Everything outlives the run.
struct Project {
  const SourceMap& sources;
  const Limits& limits;
  const stdlib::GibbsKeywords& gibbsKeywords;
  const stdlib::ComPostKeywords& compostKeywords;
  std::span<const stdlib::MacroSet> macroSets = {}; // all, where a Prog or an NC program is linted
  const stdlib::Form* form = nullptr;
  const stdlib::Control* control = nullptr;     // --control
  const stdlib::Control* postControl = nullptr; // of the form; nullptr: it names none
  std::vector<const compost::Program*> progs = {};
  std::vector<const gibbs::Cycle*> cycles = {};
  std::vector<const gibbs::Macro*> macros = {}; // outside cycle folders, or called within one
  std::vector<const gibbs::Dialog*> dialogs = {};
  std::vector<const gibbs::DefineData*> defines = {};
  std::vector<NcFile> programs = {};
  std::vector<const mikroprog::Reading*> sufPrograms = {};
  std::vector<Joined> joined = {};
  std::span<const stdlib::Control> controls = {}; // all profiles, where --control names none
  // The macros, dialogs and DefineData.txt as shared checks look at them.
  std::vector<const gibbs::CheckedFile*> checked = {};
  std::shared_ptr<Analyses> analyses = nullptr; // of this project
  // Of --field and dotek.toml: a field of the post and the variable that it prints, where a cycle has it.
  dotek::project::NamedTexts fields = {};
  std::set<std::string> sets = {}; // names of --set

  // Those of cycle folders too, in the order of reading.
  std::vector<const gibbs::Macro*> allMacros() const;
  std::vector<const gibbs::Dialog*> allDialogs() const;
};

// Fills `joined`: each cycle with the Progs that name it, lowered where `lower` says so. Where several cycles
// of a name or several Progs are there, those that lie nearest to one another: in the deepest folder that
// holds both, seen from the cycle or from the Prog.
void join(Project& project, dotek::project::Compilation& compilation, bool lower);

} // namespace dotek::lint
