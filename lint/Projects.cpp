#include "lint/Projects.h"

#include "lint/Analyses.h"
#include "lint/PostFile.h"
#include "project/FormChoice.h"

#include <algorithm>
#include <filesystem>
#include <tuple>

namespace dotek::lint {

using dotek::project::CycleFolder;

const Config& Projects::configOf(FileId file) {
  if (file == kNoFile) return none_;
  return *configs_.of(compilation_.session().sources().file(file).name());
}

Settings Projects::settingsOf(FileId file) {
  const Config& config = configOf(file);
  Settings out;
  out.control = options_.control.empty() ? config.control : options_.control;
  out.form = options_.source.form.value_or(config.form);
  out.formGiven = !out.form.empty();
  if (!out.formGiven) out.form = dotek::project::kDefaultForm;
  out.probe = stdlib::merged(compilation_.session().probeCodes(), config.probe);
  return out;
}

bool Projects::isExcluded(FileId file) {
  if (!configOf(file).exclude) return false;
  const std::string& name = compilation_.session().sources().file(file).name();
  return std::find(options_.paths.begin(), options_.paths.end(), name) == options_.paths.end();
}

const std::deque<Project>& Projects::gather(dotek::project::LoweringInputs& inputs,
                                            const std::deque<mikroprog::Reading>& sufPrograms,
                                            const std::deque<gibbs::CheckedFile>& checked,
                                            const std::deque<PostFile>& posts) {
  inputs_ = &inputs;
  std::set<Settings> all;
  const auto note = [&](const auto& files) {
    for (const auto& one : files)
      all.insert(settingsOf(one.file));
  };
  note(compilation_.macros());
  note(compilation_.dialogs());
  note(compilation_.defines());
  note(compilation_.programs());
  for (const mikroprog::Reading& reading : sufPrograms)
    all.insert(settingsOf(reading.program.file));
  note(posts);
  std::map<std::string, std::set<Settings>> named; // cycles, by the Progs that name them
  for (const auto& prog : compilation_.progs()) {
    const Settings settings = settingsOf(prog->file);
    all.insert(settings);
    for (const std::string& cycle : compost::cycleIds(*prog))
      named[cycle].insert(settings);
  }
  const auto settingsOfCycle = [&](const CycleFolder& folder) {
    const auto at = named.find(folder.name);
    return at == named.end() ? std::set{settingsOf(folder.place)} : at->second;
  };
  for (const CycleFolder& folder : compilation_.folders())
    all.merge(settingsOfCycle(folder));
  if (all.empty()) all.insert(settingsOf(kNoFile));

  for (const Settings& settings : all) {
    Project& project = begin(settings);
    const auto take = [&](const auto& files, auto& into) {
      for (const auto& one : files)
        if (settingsOf(one.file) == settings) into.push_back(&one);
    };
    for (const auto& prog : compilation_.progs())
      if (settingsOf(prog->file) == settings) project.progs.push_back(prog.get());
    for (const CycleFolder& folder : compilation_.folders()) {
      if (!settingsOfCycle(folder).contains(settings)) continue;
      if (folder.cycle) project.cycles.push_back(folder.cycle.get());
      for (const gibbs::CheckedFile& file : folder.checked)
        project.checked.push_back(&file);
    }
    take(compilation_.macros(), project.macros);
    take(compilation_.dialogs(), project.dialogs);
    take(compilation_.defines(), project.defines);
    for (const macrob::File& file : compilation_.programs())
      if (settingsOf(file.file) == settings)
        project.programs.push_back({&file, compilation_.lower(file, project.control)});
    for (const mikroprog::Reading& reading : sufPrograms)
      if (settingsOf(reading.program.file) == settings) project.sufPrograms.push_back(&reading);
    take(checked, project.checked);
    take(posts, project.analyses->posts);
    // The order of the PATHs is none.
    const SourceMap& sources = compilation_.session().sources();
    const auto earlier = [&](FileId a, FileId b) { return sources.file(a).name() < sources.file(b).name(); };
    std::stable_sort(project.programs.begin(), project.programs.end(),
                     [&](const NcFile& a, const NcFile& b) { return earlier(a.file->file, b.file->file); });
    // Without the control of the post nobody knows what its blocks mean.
    join(project, compilation_, project.postControl != nullptr);
  }
  return projects_;
}

Project& Projects::begin(const Settings& settings) {
  dotek::project::Session& session = compilation_.session();
  // An unknown control is an error, and what holds on every control is said beside it.
  const stdlib::Control* control = nullptr;
  if (!settings.control.empty() && session.data().find("mikroprog", settings.control) == nullptr) {
    control = session.control(settings.control, settings.probe);
    if (control == nullptr && unknownControls_.insert(settings.control).second)
      dotek::project::loadControl(settings.control, session);
  }
  inputs_->control = control == nullptr ? std::nullopt : std::optional(*control);
  inputs_->sourceControl = inputs_->control;
  useForm(settings);
  Project& project = projects_.emplace_back(
      Project{session.sources(), session.limits(), session.gibbsKeywords(), session.compostKeywords()});
  const bool blocks = !compilation_.progs().empty() || !compilation_.programs().empty();
  if (inputs_->form) {
    project.form = &forms_.emplace_back(*inputs_->form);
    if (!project.form->control.empty())
      project.postControl = session.control(project.form->control, settings.probe);
  }
  project.control = control;
  if (blocks) project.macroSets = session.macroSets(control != nullptr ? control : project.postControl);
  project.analyses = std::make_shared<Analyses>();
  const dotek::project::CommonOptions& options = session.options();
  project.fields = options.field;
  project.fields.insert(project.fields.end(), options.projectField.begin(), options.projectField.end());
  for (const auto& [name, value] : options.set)
    project.sets.insert(name);
  std::error_code error;
  project.analyses->wholeFolder =
      !options_.programs.empty() ||
      std::any_of(options_.paths.begin(), options_.paths.end(),
                  [&](const std::string& path) { return std::filesystem::is_directory(path, error); });
  if (control == nullptr && blocks) {
    // A text that names no control is a mill's: the codes of a lathe mean something else.
    const std::vector<stdlib::Control>& all = compilation_.controls(settings.probe);
    const auto lathes = std::find_if(all.begin(), all.end(),
                                     [](const stdlib::Control& one) { return one.turning.has_value(); });
    project.controls = {all.begin(), lathes};
  }
  return project;
}

// What nobody looks at is not loaded; a form that is not there is reported all the same.
void Projects::useForm(const Settings& settings) {
  const std::string& name = settings.form;
  dotek::project::Session& session = compilation_.session();
  inputs_->form.reset();
  inputs_->formChoice = {name, settings.formGiven};
  const bool known = session.data().find("forms", name) != nullptr;
  if (unknownForms_.contains(name) || (known && compilation_.progs().empty())) return;
  dotek::project::useForm(*inputs_, name, session);
  if (!inputs_->form) unknownForms_.insert(name);
}

void keepOneOfEach(Diagnostics& diagnostics) {
  std::set<std::tuple<std::string_view, FileId, std::uint32_t, std::uint32_t, std::string>> seen;
  std::erase_if(diagnostics.all(), [&](const Diagnostic& d) {
    return !seen.insert({d.code, d.range.file, d.range.begin, d.range.end, d.message}).second;
  });
}

} // namespace dotek::lint
