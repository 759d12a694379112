#include "tests/unit/FaultJudge.h"

#include "stdlib/DataFiles.h"
#include "stdlib/MacroSet.h"
#include "support/Diagnostics.h"
#include "tests/GoldenRunner.h"
#include "tests/policy/Tree.h"

#include <fmt/format.h>
#include <functional>

namespace dotek::tests {

std::size_t deedsOf(const std::string& trace) {
  std::string out, last, at;
  for (const std::string& line : linesOf(trace)) {
    const bool moves = line.starts_with("rapid ") || line.starts_with("feed ");
    const std::size_t begin = line.find(" X"), end = line.find(" F");
    const std::string to = begin == std::string::npos ? "" : line.substr(begin, end - begin);
    const bool nothing = line == last || (moves && to == at);
    last = line;
    if (moves || line.starts_with("system ") || line.starts_with("start "))
      at = to;
    else if (line.find(" X") != std::string::npos)
      at.clear(); // it may have moved
    if (!nothing) out += line + "\n";
  }
  return std::hash<std::string>()(out);
}

Told toldBy(driver::VerifyOptions options) {
  Told out;
  options.traces = [&](std::uint64_t number, bool agrees, const std::string& trace) {
    out.traces.emplace(number, deedsOf(trace));
    if (agrees) out.agreeing.insert(number);
  };
  const driver::Outcome outcome = driver::verify(options);
  out.status = outcome.status;
  out.messages = renderText(outcome.diagnostics, outcome.sources, 3);
  return out;
}

FaultWords faultWordsOf(const std::string& program) {
  FaultWords out;
  out.radius = {"#520"};
  out.probeOn = {"M31"};
  for (const char* name : kFaultSets) {
    const stdlib::MacroSet set = *stdlib::MacroSet::load(stdlib::DataFiles(), name);
    for (const stdlib::MacroSignature& one : set.signatures) {
      if (one.intent == stdlib::Intent::ProbeOn)
        out.probeOn.insert(fmt::format("G65P{}", one.program));
      else if (one.intent == stdlib::Intent::ProtectedMove)
        out.travels.insert(one.program);
      else if (one.intent != stdlib::Intent::ProbeOff)
        out.measures.insert(one.program);
    }
  }
  out.measures.insert(8801); // one touch, of the others
  // "(A #1 TOOL_RADIUS ...": the header's list of arguments.
  for (const std::string& line : linesOf(program)) {
    const std::size_t sign = line.find('#');
    if (line.starts_with("(") && sign == 3 && line.find(" TOOL_RADIUS ") != std::string::npos)
      out.radius.insert(line.substr(sign, line.find(' ', sign) - sign));
  }
  return out;
}

} // namespace dotek::tests
