// Programs of Macro B converted to Mikroprog, with what is said of them.
#pragma once

#include "MikroprogHelper.h"
#include "backends/mikroprog/Programs.h"
#include "frontend/macrob/Lower.h"
#include "frontend/macrob/Parse.h"
#include "stdlib/Control.h"

#include <algorithm>
#include <set>
#include <string>

namespace dotek::tests {

inline const stdlib::Control& sourceControl(bool lathe) {
  static const stdlib::DataFiles files;
  static const auto turning = stdlib::Control::load(files, "fanuc-0i-tf"),
                    milling = stdlib::Control::load(files, "fanuc-0i-md");
  return lathe ? *turning : *milling;
}
inline const stdlib::MikroprogControl& targetControl(bool lathe) {
  static const auto turning = loadMikroprog("mikroprog-s280"), milling = loadMikroprog("mikroprog-mill");
  return lathe ? turning : milling;
}

struct Converted {
  SourceMap sources;
  Diagnostics diagnostics;
  std::optional<ir::ProgramFile> programs;
  std::optional<std::vector<backends::EmittedLine>> lines;

  std::string text() const {
    std::string out;
    for (const auto& line : *lines)
      out += line.text + "\n";
    return out;
  }
  // Lines of the source that the result, or a message, speaks of.
  bool speaksOf(std::uint32_t line) const {
    for (const Diagnostic& one : diagnostics.all())
      if (one.range.hasPlace() && sources.line(one.range) == line) return true;
    if (!lines) return false;
    return std::any_of(lines->begin(), lines->end(), [&](const backends::EmittedLine& one) {
      return std::any_of(one.ranges.begin(), one.ranges.end(),
                         [&](SourceRange range) { return range.hasPlace() && sources.line(range) == line; });
    });
  }
  std::set<std::uint32_t> errorLines() const {
    std::set<std::uint32_t> out;
    for (const Diagnostic& one : diagnostics.all())
      if (one.severity == Severity::Error && one.range.hasPlace()) out.insert(sources.line(one.range));
    return out;
  }
};

inline Converted converted(const std::string& text, bool lathe = true) {
  Converted out;
  const stdlib::Control& source = sourceControl(lathe);
  const FileId file = out.sources.add(SourceFile("a.nc", text, Encoding::Cp1250));
  const auto parsed = frontend::macrob::parse(file, out.sources, Limits(), out.diagnostics);
  out.programs = frontend::macrob::lower(parsed, source, out.sources, out.diagnostics,
                                         frontend::macrob::LowerFor::Translation);
  if (!out.programs || out.programs->programs.empty()) return out;
  out.lines =
      backends::mikroprog::emitProgram(*out.programs, {targetControl(lathe), source, "a"}, out.diagnostics);
  return out;
}

} // namespace dotek::tests
