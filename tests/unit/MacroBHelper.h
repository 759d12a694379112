// A file of macro programs in a test: its text, tree and findings.
#pragma once

#include "frontend/macrob/Check.h"
#include "frontend/macrob/Format.h"
#include "frontend/macrob/Parse.h"
#include "stdlib/DataFiles.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace dotek::tests {

struct MacroFile {
  SourceMap sources;
  Diagnostics diagnostics;
  frontend::macrob::File file;

  explicit MacroFile(std::string text, frontend::macrob::Reader reader = frontend::macrob::Reader::Fast,
                     const Limits& limits = {}, Encoding encoding = Encoding::Utf8)
      : MacroFile(std::move(text), frontend::macrob::Text::Program, reader, limits, encoding) {}
  // As --from listing reads it, or not.
  MacroFile(std::string text, frontend::macrob::Text kind,
            frontend::macrob::Reader reader = frontend::macrob::Reader::Fast, const Limits& limits = {},
            Encoding encoding = Encoding::Utf8) {
    const FileId id = sources.add(SourceFile("p.nc", std::move(text), encoding));
    file = frontend::macrob::parse(id, sources, limits, diagnostics, kind, reader);
  }

  // Runs the checks; "": without a control.
  MacroFile& check(const std::string& control = "") {
    std::optional<stdlib::Control> profile;
    if (!control.empty()) profile = stdlib::Control::load(stdlib::DataFiles(), control);
    frontend::macrob::checkFile(file, profile ? &*profile : nullptr, sources, diagnostics);
    return *this;
  }

  // `E 3:7 code` in the order of printing; E, W or N for the severity.
  std::vector<std::string> findings() {
    diagnostics.sort();
    std::vector<std::string> out;
    for (const Diagnostic& one : diagnostics.all()) {
      const LineColumn place = sources.file(one.range.file).place(one.range.begin);
      const char severity = one.severity == Severity::Error     ? 'E'
                            : one.severity == Severity::Warning ? 'W'
                                                                : 'N';
      out.push_back(std::string(1, severity) + " " + std::to_string(place.line) + ":" +
                    std::to_string(place.column) + " " + std::string(one.code));
    }
    return out;
  }

  // All findings in one text, separated by "; ".
  std::string told() {
    std::string out;
    for (const std::string& one : findings())
      out += (out.empty() ? "" : "; ") + one;
    return out;
  }

  // The text with the fix of the finding with this code (the first one) applied; "": there is none.
  std::string fixed(const std::string& code) {
    diagnostics.sort();
    const auto found = std::find_if(diagnostics.all().begin(), diagnostics.all().end(),
                                    [&](const Diagnostic& one) { return one.code == code && one.fix; });
    if (found == diagnostics.all().end()) return "";
    std::string text = sources.file(0).bytes();
    std::vector<Edit> edits = found->fix->edits;
    std::stable_sort(edits.begin(), edits.end(),
                     [](const Edit& a, const Edit& b) { return a.range.begin > b.range.begin; });
    for (const Edit& edit : edits)
      text.replace(edit.range.begin, edit.range.end - edit.range.begin, edit.text);
    return text;
  }

  std::string dump(bool places = false) const { return frontend::macrob::dumpAst(file, sources, places); }
  std::optional<std::string> format() const { return frontend::macrob::format(file, sources); }
};

// Findings of one program, checked for a control.
inline std::string told(const std::string& text, const std::string& control = "") {
  return MacroFile(text).check(control).told();
}

} // namespace dotek::tests
