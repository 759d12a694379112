// Parses pieces of macro text in tests.
#pragma once

#include "frontend/gibbs/Cycle.h"
#include "stdlib/DataFiles.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace dotek::tests {

struct GibbsHarness {
  SourceMap sources;
  Limits limits;
  Diagnostics diagnostics;

  static const stdlib::GibbsKeywords& keywords() {
    static const stdlib::DataFiles files;
    static const stdlib::GibbsKeywords loaded = stdlib::GibbsKeywords::load(files);
    return loaded;
  }
  frontend::gibbs::ParseContext context() { return {sources, keywords(), limits, diagnostics}; }
  FileId add(const std::string& text, const std::string& name = "x.mac", Encoding encoding = Encoding::Utf8) {
    return sources.add(SourceFile(name, text, encoding));
  }
  frontend::gibbs::Macro macro(const std::string& text) {
    return frontend::gibbs::parseMacro(add(text), context());
  }
  frontend::gibbs::Macro checked(const std::string& text) {
    frontend::gibbs::Macro made = macro(text);
    frontend::gibbs::checkMacro(made, {}, context());
    diagnostics.sort();
    return made;
  }
  frontend::gibbs::Dialog dialog(const std::string& text) {
    frontend::gibbs::Dialog made = frontend::gibbs::parseDialog(add(text, "x.dlg"), context());
    frontend::gibbs::checkDialog(made, context());
    diagnostics.sort();
    return made;
  }
  frontend::gibbs::DefineData defines(const std::string& text) {
    frontend::gibbs::DefineData made =
        frontend::gibbs::parseDefineData(add(text, "DefineData.txt"), context());
    frontend::gibbs::checkDefineData(made, context());
    diagnostics.sort();
    return made;
  }
  // "code@line:column code@line:column ..."
  std::string codes() const {
    std::string all;
    for (const Diagnostic& d : diagnostics.all()) {
      const LineColumn place = sources.file(d.range.file).place(d.range.begin);
      if (!all.empty()) all += " ";
      all += std::string(d.code) + "@" + std::to_string(place.line) + ":" + std::to_string(place.column);
    }
    return all;
  }
  std::string messages() const {
    std::string all;
    for (const Diagnostic& d : diagnostics.all())
      all += d.message + "\n";
    return all;
  }
  std::size_t errors() const {
    return static_cast<std::size_t>(
        std::count_if(diagnostics.all().begin(), diagnostics.all().end(),
                      [](const Diagnostic& d) { return d.severity == Severity::Error; }));
  }
};

// One finding at the place, of a macro that is parsed and checked.
inline std::string findings(const std::string& text) {
  GibbsHarness h;
  h.checked(text);
  return h.codes();
}
inline std::string firstMessage(const std::string& text) {
  GibbsHarness h;
  h.checked(text);
  return h.diagnostics.empty() ? "" : h.diagnostics.all().front().message;
}

} // namespace dotek::tests
