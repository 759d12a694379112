// A Prog in a test: its text, tree and diagnostics.
#pragma once

#include "frontend/compost/Parse.h"

#include <algorithm>
#include <string>
#include <vector>

namespace dotek::tests {

struct Prog {
  SourceMap sources;
  Diagnostics diagnostics;
  frontend::compost::Program program;

  explicit Prog(std::string text, Encoding encoding = Encoding::Utf8, const Limits& limits = {}) {
    const FileId file = sources.add(SourceFile("p", std::move(text), encoding));
    program = frontend::compost::parse(file, sources, limits, diagnostics);
  }

  // `severity-initial line:column code`, in the order of printing.
  std::vector<std::string> findings() {
    diagnostics.sort();
    std::vector<std::string> result;
    for (const Diagnostic& one : diagnostics.all()) {
      const LineColumn place = sources.file(one.range.file).place(one.range.begin);
      result.push_back(std::to_string(place.line) + ":" + std::to_string(place.column) + " " +
                       std::string(one.code));
    }
    return result;
  }

  std::string only() {
    const std::vector<std::string> all = findings();
    std::string result;
    for (const std::string& one : all) {
      if (!result.empty()) result += ", ";
      result += one;
    }
    return result;
  }

  std::string dump() const { return frontend::compost::dumpAst(program, sources); }

  // The tree without places.
  std::string shape() const {
    std::string result;
    const std::string tree = dump();
    for (std::size_t at = 0; at < tree.size();) {
      const std::size_t end = tree.find('\n', at);
      std::string line = tree.substr(at, end - at);
      const std::size_t text = line.find_first_not_of(' ');
      if (text != std::string::npos && line[text] >= '0' && line[text] <= '9')
        line.erase(text, line.find(' ', text) + 1 - text);
      result += line + "\n";
      at = end + 1;
    }
    return result;
  }

  const Diagnostic& at(std::size_t index) {
    diagnostics.sort();
    return diagnostics.all().at(index);
  }

  // The text with the fix of one finding applied.
  std::string fixed(const Diagnostic& finding) const {
    std::string text = sources.file(0).bytes();
    if (finding.fix)
      for (const Edit& edit : finding.fix->edits)
        text.replace(edit.range.begin, edit.range.end - edit.range.begin, edit.text);
    return text;
  }
};

} // namespace dotek::tests
