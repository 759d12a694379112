#include "project/Session.h"
#include "project/PostShape.h"

#include "project/Assumptions.h"
#include "stdlib/CodeSpan.h"
#include "support/Files.h"
#include "support/Tape.h"
#include "support/WholeName.h"
#include "support/messages/Commands.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace dotek::project {

Session::Session(const CommonOptions& options) : options_(options), probeCodes_(options.probeCodes) {
  checkAssumptions(options.assume, diagnostics_);
  for (const std::string& folder : options.data)
    data_.addFolder(folder, options.limits, diagnostics_);
}

const stdlib::GibbsKeywords& Session::gibbsKeywords() {
  if (!gibbs_) gibbs_.emplace(stdlib::GibbsKeywords::load(data_));
  return *gibbs_;
}

const stdlib::ComPostKeywords& Session::compostKeywords() {
  if (!compost_) compost_.emplace(stdlib::ComPostKeywords::load(data_));
  return *compost_;
}

const stdlib::Control* Session::control(const std::string& name) {
  return control(name, probeCodes_);
}

const stdlib::Control* Session::control(const std::string& name, const stdlib::ProbeCodes& codes) {
  const auto [at, isNew] = controls_.try_emplace({name, codes});
  if (isNew) at->second = stdlib::Control::load(data_, name);
  if (isNew && at->second) stdlib::addProbeCodes(*at->second, codes);
  if (isNew && at->second) stdlib::addAuxiliary(*at->second, stdlib::auxiliaryCodes(options_.assume));
  return at->second ? &*at->second : nullptr;
}

void Session::takeProbeCodes(const stdlib::ProbeCodes& codes) {
  probeCodes_ = stdlib::merged(probeCodes_, codes);
}

const std::vector<stdlib::MacroSet>& Session::macroSets(const stdlib::Control* control) {
  const stdlib::MacroPackage* const package =
      control == nullptr || !control->package ? nullptr : &*control->package;
  // A profile of the user's may extend another's package.
  const std::string key =
      package == nullptr
          ? ""
          : fmt::format("{} {} {} {} {} {} {}", package->set, package->shift, package->calibrationFirst,
                        package->calibrationLast, package->radiusX, package->radiusY, package->title);
  const auto [at, fresh] = macroSets_.try_emplace(key);
  if (!fresh) return at->second;
  for (const stdlib::DataFile* file : data_.list("macros")) {
    auto set = stdlib::MacroSet::load(data_, file->name);
    if (!set) continue;
    at->second.push_back(package != nullptr && set->name == package->set ? stdlib::packaged(*set, *package)
                                                                         : std::move(*set));
  }
  return at->second;
}

const stdlib::MacroSet* Session::macroSet(const std::string& name, const stdlib::Control* control) {
  if (name.find('@') != std::string::npos) {
    const auto [at, fresh] =
        macroSets_.try_emplace("set " + name); // beside the lists, whose keys are packages
    if (fresh)
      if (auto set = stdlib::MacroSet::load(data_, name)) at->second.push_back(std::move(*set));
    return at->second.empty() ? nullptr : &at->second.front();
  }
  const bool packaged = control != nullptr && control->package && control->package->set == name;
  const std::vector<stdlib::MacroSet>& sets = macroSets(packaged ? control : nullptr);
  const auto found =
      std::find_if(sets.begin(), sets.end(), [&](const stdlib::MacroSet& set) { return set.name == name; });
  return found == sets.end() ? nullptr : &*found;
}

std::optional<stdlib::Form> Session::form(const std::string& name) {
  std::optional<stdlib::Form> form = stdlib::Form::load(data_, name, compostKeywords());
  if (!form) {
    std::string known;
    for (const stdlib::DataFile* file : data_.list("forms"))
      known += (known.empty() ? "" : ", ") + file->name;
    diagnostics_.report<diag::UnknownForm>({}, name, known);
  }
  return form;
}

void reportUnknownMacroSet(const std::string& name, Session& session) {
  std::string known;
  for (const stdlib::MacroSet& set : session.macroSets())
    known += (known.empty() ? "" : ", ") + set.name;
  session.diagnostics().report<diag::UnknownMacroSet>({}, name, known);
}

std::optional<FileId> Session::read(const std::string& path, Encoding fallback) {
  const auto known = read_.find(path);
  if (known != read_.end()) return known->second;
  if (read_.size() >= options_.limits.files) {
    diagnostics_.report<diag::TooManyFiles>({}, options_.limits.files);
    return std::nullopt;
  }
  std::optional<std::string> text;
  if (const auto whole = whole_.find(path); whole != whole_.end())
    text = std::move(whole_.extract(whole).mapped());
  else
    text = bytes(path, diagnostics_);
  if (text && text->size() > mostBytes(options_.limits) && !holdsPrograms(path)) {
    reportTooLarge(path, options_.limits, diagnostics_);
    text.reset();
  }
  std::optional<FileId> id;
  if (text)
    id = addText(inputName(path), std::move(*text), fallback, options_.encoding, sources_, diagnostics_);
  read_.emplace(path, id);
  return id;
}

ReadBounds Session::bounds(const std::string& folder) const {
  ReadBounds out;
  if (options_.includeRoot) {
    out.folders.push_back(*options_.includeRoot);
  } else {
    for (const std::string& root : inputRoots_)
      if (ReadBounds{{root}}.allow(folder)) out.folders.push_back(root);
    if (out.folders.empty()) out.folders.push_back(folder);
  }
  out.folders.insert(out.folders.end(), options_.include.begin(), options_.include.end());
  return out;
}

const std::string* Session::buffer(const std::string& path) const {
  if (options_.buffers == nullptr) return nullptr;
  const auto found = options_.buffers->find(wholeName(path));
  return found == options_.buffers->end() ? nullptr : &found->second;
}

bool Session::holdsPrograms(const std::string& path) const {
  const auto told = kinds_.find(path);
  return told != kinds_.end() && (told->second.kind == InputKind::Nc || told->second.kind == InputKind::Suf);
}

std::optional<std::string> Session::bytes(const std::string& path, Diagnostics& diagnostics) {
  std::optional<std::string> out;
  if (const std::string* const held = buffer(path))
    out = *held;
  else if (isStream(path))
    out = options_.streams->read(path, options_.limits, diagnostics);
  else
    out = holdsPrograms(path) ? readPrograms(path, options_.limits, diagnostics)
                              : readBytes(path, options_.limits, diagnostics);
  if (out) blankTape(*out);
  return out;
}

const Recognition* Session::kindOf(const std::string& path, Diagnostics& diagnostics,
                                   std::optional<InputKind> expected) {
  if (const auto told = kinds_.find(path); told != kinds_.end()) return &told->second;
  if (options_.from)
    return &kinds_.emplace(path, Recognition{kindByName(*options_.from), "--from"}).first->second;
  const bool stream = isStream(path);
  const auto before = stream ? read_.end() : read_.find(path); // included by another input
  const bool known = before != read_.end() && before->second;
  const bool whole = stream || known || buffer(path) != nullptr;
  std::optional<std::string> text;
  if (known)
    text = sources_.file(*before->second).bytes().substr(0, kRecognisedBytes);
  else
    text = whole ? bytes(path, diagnostics) : readBeginning(path, kRecognisedBytes, diagnostics);
  if (!text) return nullptr;
  blankTape(*text);
  Recognition found = recognise(stream ? "" : path, *text, expected);
  // Longer texts are what `dotek lint` takes them for.
  constexpr std::size_t kBegun = 80;
  if (showsNothing(found) && text->size() <= kBegun && buffer(path) != nullptr && options_.bufferKinds)
    if (const auto at = options_.bufferKinds->find(wholeName(path)); at != options_.bufferKinds->end())
      found = at->second == "cps" ? Recognition{std::nullopt, std::string(kPostInput)}
                                  : Recognition{kindByName(at->second), "the editor"};
  // Of a longer file only the beginning was read.
  if (found.kind && !whole && text->size() < kRecognisedBytes && text->size() <= mostBytes(options_.limits))
    whole_.emplace(path, std::move(*text));
  return &kinds_.emplace(path, std::move(found)).first->second;
}

} // namespace dotek::project
