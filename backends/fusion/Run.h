// Runs what emit() wrote, on a double of the post kernel in Duktape.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::backends::fusion {

// One operation. Lengths are mm.
struct RunInput {
  bool inch = false; // the document's unit
  std::map<std::string, double>
      properties; // by name, "surfaceX_G"; others keep the value of their definition
  std::vector<std::array<double, 3>> points = {{0, 0, 0}};
  double toolDiameter = 6;
  double toolNumber = 1;
  double toolLengthOffset = 1;
  std::map<std::string, double> cycle; // "clearance", "retract", "probeOvertravel"
};

struct RunResult {
  std::string text;                  // NC, line ends LF
  std::vector<std::string> errors;   // of error(..), in order
  std::vector<std::string> warnings; // of warning(..)
  bool wroteAfterError = false;      // a defect: something was written after an error
  std::string failure;               // "" or what the engine says: a syntax error, an exception
  bool ok() const { return failure.empty() && errors.empty(); }
};

// NC text of a fragment: PREFIX_write(x, y, z) for each point, within the post of postAround(). Runs only
// text that this back end wrote: nothing limits its time but the bound in loops of checks.
RunResult runFragment(std::string_view fragment, std::string_view prefix, const RunInput& input);
// A fragment that runs many times: its text is read once. Each run begins anew. For one thread.
class Fragment {
public:
  Fragment(std::string_view fragment, std::string_view prefix);
  ~Fragment();
  RunResult run(const RunInput& input) const;

private:
  class Prepared;
  const std::string prefix_;
  std::unique_ptr<Prepared> prepared_;
};

// NC text of a whole post: its entry functions in their order; `prefix` chooses the cycle.
RunResult runPost(std::string_view post, std::string_view prefix, const RunInput& input);

// Everything of runFragment() as one script for another engine: prints the NC text with console.log.
std::string scriptFor(std::string_view fragment, std::string_view prefix, const RunInput& input);
// Evaluates `code` after the kernel's double and gives its value as text; of one that throws "throws: ...".
// For tests of the double.
std::string evaluate(std::string_view code);

} // namespace dotek::backends::fusion
