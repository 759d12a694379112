// Which inputs are judged together, and under which settings.
#pragma once

#include "lint/Config.h"
#include "lint/Project.h"
#include "project/Compilation.h"
#include "stdlib/Control.h"
#include "stdlib/Form.h"

#include <deque>
#include <map>
#include <set>
#include <string>

namespace dotek::lint {

struct PostFile;

// The settings of a file: those of the command line, else those of its dotek.toml.
struct Settings {
  std::string control; // "": what holds on every control
  std::string form;
  bool formGiven = false;   // else it is the one that is taken where nobody names one
  stdlib::ProbeCodes probe; // of the flags, else of dotek.toml
  auto operator<=>(const Settings&) const = default;
};

// Files of one control and one form make one project, so that what is said of a file depends neither on the
// order of the PATHs nor on what lies beside it. Those of a cycle's folder go with the Progs that name the
// cycle.
class Projects {
public:
  Projects(const LintOptions& options, Configs& configs, dotek::project::Compilation& compilation)
      : options_(options), configs_(configs), compilation_(compilation) {}
  Projects(const Projects&) = delete;
  Projects& operator=(const Projects&) = delete;

  const Config& configOf(FileId file);
  Settings settingsOf(FileId file);
  // true: its dotek.toml excludes it, and the command line does not name it.
  bool isExcluded(FileId file);

  // All that the compilation has read, these programs of Mikroprog, these files outside of cycle folders and
  // these posts; what it gives lives as long as they do. An unknown control or form is reported once.
  const std::deque<Project>& gather(dotek::project::LoweringInputs& inputs,
                                    const std::deque<mikroprog::Reading>& sufPrograms,
                                    const std::deque<gibbs::CheckedFile>& checked,
                                    const std::deque<PostFile>& posts);

private:
  Project& begin(const Settings& settings);
  void useForm(const Settings& settings);

  const LintOptions& options_;
  Configs& configs_;
  dotek::project::Compilation& compilation_;
  dotek::project::LoweringInputs* inputs_ = nullptr;
  const Config none_; // of what is in no file
  std::deque<Project> projects_;
  std::deque<stdlib::Form> forms_; // of the projects
  std::set<std::string> unknownControls_, unknownForms_;
};

// A cycle that Progs of several settings name is judged with each of them: what is said twice is said once.
void keepOneOfEach(Diagnostics& diagnostics);

} // namespace dotek::lint
