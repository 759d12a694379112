#include "lsp/Workspace.h"

#include "project/CycleFolder.h"
#include "project/InputKind.h"
#include "project/Settings.h"
#include "support/Ascii.h"
#include "support/Printable.h"

#include <algorithm>
#include <filesystem>

namespace dotek::lsp {

namespace fs = std::filesystem;

namespace {

int severityOf(Severity severity) {
  switch (severity) {
  case Severity::Error: return 1;
  case Severity::Warning: return 2;
  case Severity::Note: return 3;
  }
  return 3;
}

bool isFolder(const std::string& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

Found foundOf(const Diagnostic& one, const SourceMap& sources, Units units) {
  Found out;
  const SourceFile& file = sources.file(one.range.file);
  out.code = std::string(one.code);
  out.range = one.range;
  const Json range = rangeOf(file, one.range, units);
  out.line = range["start"]["line"];
  std::string message = one.message;
  Json related = Json::array();
  for (const DiagnosticNote& note : one.notes) {
    if (!note.range.hasPlace()) {
      message += "\nnote: " + note.message;
      continue;
    }
    const SourceFile& where = sources.file(note.range.file);
    related.push_back(
        {{"location", {{"uri", uriOf(where.name())}, {"range", rangeOf(where, note.range, units)}}},
         {"message", asUtf8(note.message)}});
  }
  out.diagnostic = {{"range", range},
                    {"severity", severityOf(one.severity)},
                    {"code", out.code},
                    {"source", "dotek"},
                    {"message", asUtf8(message)}};
  if (!related.empty()) out.diagnostic["relatedInformation"] = related;
  if (one.fix) {
    out.title = asUtf8(one.fix->title);
    out.safe = one.fix->applicability == Fix::Applicability::Safe;
    for (const Edit& edit : one.fix->edits) {
      const SourceFile& where = sources.file(edit.range.file);
      out.edits[where.name()].push_back(
          {{"range", rangeOf(where, edit.range, units)}, {"newText", toUtf8(edit.text, where.encoding())}});
    }
  }
  return out;
}

} // namespace

Workspace::Workspace(std::string scriptProgram)
    : scriptProgram_(std::move(scriptProgram)),
      buffers_(std::make_shared<std::map<std::string, std::string>>()) {}

std::string Workspace::unitOf(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return project::isCycleFolder(folder) ? folder.generic_string() : path;
}

void Workspace::changed(const std::string& path) {
  changed_.insert(unitOf(path));
  indices_.clear(); // names of one file are read in another
}

std::string& Workspace::writable(const std::string& path) {
  if (buffers_.use_count() > 1) buffers_ = std::make_shared<std::map<std::string, std::string>>(*buffers_);
  return (*buffers_)[path];
}

void Workspace::readKinds() {
  const std::map<std::string, std::string> byLanguage = {{"dotek-macrob", "nc"},
                                                         {"dotek-mikroprog", "suf"},
                                                         {"dotek-cycle", "cycle"},
                                                         {"dotek-compost", "prog"},
                                                         {"gcode", "nc"}};
  std::map<std::string, std::string> out;
  for (const auto& [uri, document] : documents_) {
    const auto named = byLanguage.find(document.language);
    const auto byName = project::kindByFileName(document.path);
    const std::string ending = lowerCase(fs::path(document.path).extension().string());
    if (named != byLanguage.end())
      out[document.path] = named->second;
    else if (byName)
      out[document.path] = project::kindName(*byName);
    else if (ending == ".cps" || ending == ".cpi")
      out[document.path] = "cps";
    else if (postOf(document.path) == document.path)
      out[document.path] = "prog";
  }
  kinds_ = std::make_shared<const std::map<std::string, std::string>>(std::move(out));
}

bool Workspace::open(const std::string& uri, const std::string& language, std::int64_t version,
                     std::string text) {
  const std::optional<std::string> path = pathOf(uri);
  if (!path) return false;
  documents_[uri] = {*path, uri, language, version};
  writable(*path) = std::move(text);
  readKinds();
  changed(*path);
  return true;
}

bool Workspace::change(const std::string& uri, std::int64_t version, const Json& changes) {
  const auto at = documents_.find(uri);
  if (at == documents_.end() || !changes.is_array()) return false;
  std::string text = buffers_->at(at->second.path);
  for (const Json& one : changes) {
    if (!one.is_object() || !one.contains("text") || !one["text"].is_string()) return false;
    if (!one.contains("range")) {
      text = one["text"].get<std::string>();
      continue;
    }
    const Json& range = one["range"];
    if (!range.is_object() || !range.contains("start") || !range.contains("end")) return false;
    const auto begin = offsetOf(text, range["start"], units), end = offsetOf(text, range["end"], units);
    if (!begin || !end || *begin > *end) return false;
    text.replace(*begin, *end - *begin, one["text"].get<std::string>());
  }
  at->second.version = version;
  writable(at->second.path) = std::move(text);
  changed(at->second.path);
  return true;
}

void Workspace::close(const std::string& uri) {
  const auto at = documents_.find(uri);
  if (at == documents_.end()) return;
  const std::string path = at->second.path;
  documents_.erase(at);
  readKinds();
  writable(path);
  buffers_->erase(path);
  changed(path);
}

void Workspace::touchAll() {
  onDisk_.clear(); // settings may be others
  readKinds();
  for (const auto& [uri, document] : documents_)
    changed(document.path);
}

const Document* Workspace::find(const std::string& uri) const {
  const auto at = documents_.find(uri);
  return at == documents_.end() ? nullptr : &at->second;
}

driver::CommonOptions Workspace::options(const std::vector<std::string>& inputs) const {
  driver::CommonOptions out;
  out.buffers = buffers_;
  out.bufferKinds = kinds_;
  out.scriptProgram = scriptProgram_;
  project::FlagDefaults defaults = project::flagDefaultsOf(inputs);
  out.data = std::move(defaults.data);
  out.projectField = std::move(defaults.field);
  return out;
}

void Workspace::keep(const driver::Outcome& outcome, const std::vector<std::string>& inputs,
                     const std::string& otherwise, std::map<std::string, std::vector<Found>>& byPath) const {
  const std::string& unit = inputs.front();
  const bool folder = isFolder(unit);
  const auto isElsewhere = [&](const std::string& path) {
    return std::any_of(inputs.begin() + 1, inputs.end(), [&](const std::string& other) {
      return path == other || path.starts_with(other + "/");
    });
  };
  for (const Diagnostic& one : outcome.diagnostics.all()) {
    const std::string path = one.range.hasPlace() ? outcome.sources.file(one.range.file).name() : "";
    if (isElsewhere(path)) continue;
    // What is found in no text, such as a file that is missing from the folder, is shown at the beginning of
    // one.
    if (path.empty() || (folder && path == unit)) {
      Found found;
      found.code = std::string(one.code);
      const Json start = {{"line", 0}, {"character", 0}};
      found.diagnostic = {{"range", {{"start", start}, {"end", start}}},
                          {"severity", severityOf(one.severity)},
                          {"code", found.code},
                          {"source", "dotek"},
                          {"message", asUtf8(one.message)}};
      byPath[otherwise].push_back(std::move(found));
      continue;
    }
    byPath[path].push_back(foundOf(one, outcome.sources, units));
  }
}

Json Workspace::publish(const std::string& path, const std::vector<Found>& found) const {
  Json diagnostics = Json::array();
  for (const Found& one : found)
    diagnostics.push_back(one.diagnostic);
  Json params = {{"uri", uriOf(path)}, {"diagnostics", diagnostics}};
  for (const auto& [uri, document] : documents_)
    if (document.path == path) {
      params["uri"] = uri;
      params["version"] = document.version;
    }
  return {{"jsonrpc", "2.0"}, {"method", "textDocument/publishDiagnostics"}, {"params", params}};
}

std::vector<Json> Workspace::check() {
  std::vector<Json> out;
  std::set<std::string> toCheck = std::exchange(changed_, {});
  // What is found in a cycle depends on the post that prints it.
  for (const auto& [uri, document] : documents_)
    if (const std::string unit = unitOf(document.path); unit != document.path)
      if (toCheck.contains(postOf(unit))) toCheck.insert(unit);
  for (const std::string& unit : toCheck) {
    std::set<std::string> open; // documents of the unit
    for (const auto& [uri, document] : documents_)
      if (document.path == unit || unitOf(document.path) == unit) open.insert(document.path);
    std::map<std::string, std::vector<Found>> byPath;
    for (const std::string& path : open)
      byPath[path];
    if (!open.empty()) {
      driver::LintOptions lint;
      lint.paths = inputsOf(unit);
      lint.common = options(lint.paths);
      keep(driver::lint(lint), lint.paths, *open.begin(), byPath);
    }
    // What had findings and has none any more is published, too.
    for (const std::string& path : std::exchange(told_[unit], {}))
      byPath[path];
    for (auto& [path, found] : byPath) {
      out.push_back(publish(path, found));
      if (!found.empty()) told_[unit].insert(path);
      found_[path] = std::move(found);
    }
    if (open.empty()) told_.erase(unit);
  }
  return out;
}

const std::vector<Found>& Workspace::found(const std::string& path) const {
  static const std::vector<Found> kNone;
  const auto at = found_.find(path);
  return at == found_.end() ? kNone : at->second;
}

const Index& Workspace::index(const Document& document) {
  return indexOf(document.path);
}

} // namespace dotek::lsp
