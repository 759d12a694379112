// Fragments of Fusion posts in tests: convert, run, compare.
#pragma once

#include "backends/fusion/Run.h"
#include "driver/Driver.h"
#include "support/Decimal.h"
#include "tests/GoldenRunner.h"
#include "tests/policy/Tree.h"

#include <doctest/doctest.h>

namespace dotek::tests {

inline std::string messagesOf(const driver::Outcome& outcome) {
  return renderText(outcome.diagnostics, outcome.sources, 10);
}

inline driver::ConvertOptions toFusion(const std::string& folder, const std::string& prog) {
  driver::ConvertOptions out;
  out.inputs = {folder};
  out.source.prog = prog;
  out.to = "fusion";
  return out;
}

inline std::string fragmentOf(const driver::ConvertOptions& options) {
  const driver::Outcome outcome = driver::convert(options);
  REQUIRE_MESSAGE(outcome.status == 0, messagesOf(outcome));
  return outcome.output;
}

// Lines without their N number and the blanks around it.
inline std::vector<std::string> withoutNumbers(const std::string& text) {
  std::vector<std::string> out;
  for (const std::string& line : linesOf(text)) {
    std::size_t at = line.find_first_not_of(' ');
    if (at == std::string::npos) continue;
    if (line[at] == 'N') at = std::min(line.find_first_not_of("0123456789", at + 1), line.size());
    at = std::min(line.find_first_not_of(' ', at), line.size());
    out.push_back(line.substr(at));
  }
  return out;
}

inline bool holds(const std::string& text, const std::string& line) {
  const auto lines = withoutNumbers(text);
  return std::find(lines.begin(), lines.end(), line) != lines.end();
}

// One process for all scripts of a test process.
inline script::Runner& scripts() {
  static script::Runner runner({runningProgram(), Limits()});
  return runner;
}

inline backends::fusion::RunResult runFragment(std::string_view text, std::string_view prefix,
                                               const backends::fusion::RunInput& input) {
  backends::fusion::Fragment fragment(scripts());
  backends::fusion::RunResult out;
  out.fault = fragment.load(text, prefix);
  return out.fault ? out : fragment.run(input);
}

inline backends::fusion::RunResult runPost(std::string_view post, std::string_view prefix,
                                           const backends::fusion::RunInput& input) {
  backends::fusion::Fragment fragment(scripts());
  backends::fusion::RunResult out;
  out.fault = fragment.loadPost(post, prefix);
  return out.fault ? out : fragment.run(input);
}

inline std::string evaluated(std::string_view code) {
  return backends::fusion::evaluate(scripts(), code);
}

inline std::string faultOf(const backends::fusion::RunResult& result) {
  return result.fault ? result.fault->text : "";
}

inline std::string reportOf(const backends::fusion::RunResult& result) {
  std::string out = result.text + faultOf(result);
  for (const auto& error : result.errors)
    out += "\nerror: " + error;
  return out;
}

} // namespace dotek::tests
