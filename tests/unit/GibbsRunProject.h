// A macro project in memory, for tests that run macros.
#pragma once

#include "frontend/gibbs/Parse.h"
#include "frontend/gibbs/Run.h"
#include "stdlib/DataFiles.h"
#include "tests/GoldenRunner.h"

#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <string>

namespace dotek::tests {

namespace gibbs = frontend::gibbs;

inline const stdlib::GibbsKeywords& gibbsKeywords() {
  static const stdlib::DataFiles files;
  static const stdlib::GibbsKeywords keywords = stdlib::GibbsKeywords::load(files);
  return keywords;
}

// Files by name; `main` is run. Fields, hosts and assumptions are set before.
struct GibbsProject {
  std::map<std::string, std::string> files;
  std::map<std::string, double> fields;
  std::map<std::string, double> hosts;
  std::set<std::string> assumptions;
  Limits limits;

  // After a run.
  SourceMap sources;
  Diagnostics diagnostics;
  std::map<std::string, std::unique_ptr<gibbs::Macro>> macros;
  std::map<std::string, std::unique_ptr<gibbs::Dialog>> dialogs;

  GibbsProject() = default;
  explicit GibbsProject(std::string main) { files["main"] = std::move(main); }

  gibbs::ParseContext parsing() { return {sources, gibbsKeywords(), limits, diagnostics}; }

  std::optional<FileId> add(const std::string& name) {
    for (const auto& [file, text] : files) {
      if (gibbs::foldCase(file) == gibbs::foldCase(name) ||
          gibbs::foldCase(file) == gibbs::foldCase(name + ".mac")) {
        return sources.add(SourceFile(file, text, isUtf8(text) ? Encoding::Utf8 : Encoding::Cp1250));
      }
    }
    return std::nullopt;
  }

  const gibbs::Macro* load(const std::string& name) {
    auto& macro = macros[gibbs::foldCase(name)];
    if (!macro) {
      const auto id = add(name);
      if (!id) return nullptr;
      macro = std::make_unique<gibbs::Macro>(gibbs::parseMacro(*id, parsing()));
    }
    return macro.get();
  }

  const gibbs::Dialog* loadDialog(const std::string& name) {
    const auto id = add(name);
    if (!id) return nullptr;
    auto& dialog = dialogs[gibbs::foldCase(name)];
    if (!dialog) dialog = std::make_unique<gibbs::Dialog>(gibbs::parseDialog(*id, parsing()));
    return dialog.get();
  }

  gibbs::RunContext context() {
    std::map<std::string, double> folded;
    for (const auto& [name, value] : fields)
      folded[gibbs::foldCase(name)] = value;
    return {sources,
            gibbsKeywords(),
            limits,
            diagnostics,
            folded,
            hosts,
            assumptions,
            [this](const std::string& name, SourceRange) { return load(name); },
            [this](const std::string& name, SourceRange) { return loadDialog(name); }};
  }

  gibbs::ChecksResult checks() {
    auto running = context();
    return gibbs::runChecks(*load("main"), running);
  }

  // "" where it could not be computed.
  std::string path() {
    auto running = context();
    const auto moves = gibbs::runToolPath(*load("main"), running);
    return moves ? gibbs::pathText(*moves) : "";
  }

  // Verdict and, in brackets, the rejections' texts: "rejected [too small]".
  std::string verdict() {
    const gibbs::ChecksResult result = checks();
    constexpr const char* kNames[] = {"passes", "rejected", "depends", "not run"};
    std::string text = kNames[static_cast<int>(result.verdict)];
    for (const gibbs::Rejection& each : result.rejections)
      text += " [" + each.text + "]";
    for (const std::string& host : result.neededHosts)
      text += " " + host;
    for (const auto& [field, value] : result.changed)
      text += " " + field + "=" + std::to_string(static_cast<int>(value));
    for (const gibbs::Rejection& each : result.shown)
      text += " shown[" + each.text + "]";
    return text;
  }

  // "code@source; code@source"
  std::string findings() const {
    std::string text;
    for (const Diagnostic& each : diagnostics.all()) {
      if (!text.empty()) text += "; ";
      text +=
          std::string(each.code) + "@" + (each.range.hasPlace() ? std::string(sources.text(each.range)) : "");
    }
    return text;
  }
};

// Code and place of what a path macro is refused for; its path where it is not.
inline std::string refusal(const std::string& macro, std::set<std::string> assumptions = {}) {
  GibbsProject project(macro);
  project.assumptions = std::move(assumptions);
  const std::string path = project.path();
  return project.findings().empty() ? path : project.findings();
}

} // namespace dotek::tests
