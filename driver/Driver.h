// The public library of Dotek: one function per command. Nothing here prints, exits or throws.
#pragma once

#include "project/Options.h"
#include "support/Diagnostics.h"
#include "support/LineMap.h"
#include "support/Source.h"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dotek::driver {

using project::CommonOptions;
using project::NamedTexts;
using project::SourceOptions;

struct PostOptions {
  std::vector<std::string> folders;
  CommonOptions common;
  SourceOptions source;
  std::optional<std::pair<std::uint64_t, std::uint64_t>> sequence; // start, step
};

struct ConvertOptions {
  std::vector<std::string> inputs; // folders of cycles, files of programs
  CommonOptions common;
  SourceOptions source;
  std::string to;
  std::string control;                    // "": the target's first
  std::string fromControl;                // that programs are written for; "": the same
  std::optional<std::string> probeMacros; // nothing: the set that the source calls
  std::optional<std::uint32_t> programNumber;
  NamedTexts letters;                                              // --arg NAME=LETTER
  NamedTexts defaults;                                             // --default NAME=VALUE
  bool useDefaults = false;                                        // --defaults use
  bool switchProbe = false;                                        // --probe-power macro
  bool oneFile = false;                                            // -o: several inputs are an error
  std::optional<std::pair<std::uint64_t, std::uint64_t>> renumber; // first N number of programs, step
  std::string datum;      // --datum of mikroprog: "", "g92" or "operator"
  bool wholePost = false; // --whole-post, of fusion
  bool verify = false;    // --verify: what does not agree with its source is not given
};

// From which severity on lint fails.
enum class FailOn : std::uint8_t { Note, Warning, Error, Never };

struct LintOptions {
  std::vector<std::string> paths;
  CommonOptions common;
  SourceOptions source;
  // Codes; nothing: what dotek.toml says, else all that are on by default. "all": every code.
  std::optional<std::set<std::string>> select;
  std::set<std::string> ignore;
  std::string control;          // profile that programs are checked for; "": what holds on every control
  std::optional<FailOn> failOn; // nothing: what dotek.toml says, else Warning
  bool fix = false;             // makes the safe repairs, then tells what is left
};

enum class Stage : std::uint8_t { Tokens, Ast, Path, Ir };

struct DumpOptions {
  std::vector<std::string> inputs;
  Stage stage = Stage::Ast;
  CommonOptions common;
  SourceOptions source;
  std::string control; // Ir: as of convert
};

struct SimOptions {
  std::string program; // path
  CommonOptions common;
  std::string control;               // "": the first
  NamedTexts variables;              // --var N=VALUE
  std::vector<std::string> programs; // --programs DIR: what can be called beside the programs of the file
  // --probe-macros: the set of vendors' macros that runs by its meaning; nothing: all.
  std::optional<std::string> probeMacros;
  std::optional<std::string> part, machine; // --part, --machine: paths
  bool svg = false, html = false;           // pictures of the run as files "svg" and "html"
  bool json = false;                        // the output is the summary as JSON
  // Takes the trace while the program runs, in pieces of whole lines. Empty: no trace is made.
  std::function<void(std::string_view)> trace;
};

struct Outcome;

struct VerifyOptions {
  std::vector<std::string> inputs; // one folder of a cycle, or one file of programs
  CommonOptions common;
  SourceOptions source;
  std::string to;      // "": the path of the macro against the posted program
  std::string control; // "": the target's first
  std::string fromControl;
  std::optional<std::string> probeMacros;
  std::optional<std::string> part, machine; // paths
  // A program that is looked at instead of what convert writes now: the same arguments, edited by hand. Path.
  std::optional<std::string> translation;
  std::uint64_t cases = 1000;
  std::uint64_t seed = 1;
  double minProved = 95;   // percent
  double tolerance = 1e-6; // mm
  std::uint32_t jobs = 0;  // 0: one for each processor
  std::string datum;       // of mikroprog, as of convert
  NamedTexts variables;    // --var N=VALUE, of programs: not drawn
  // A result of convert with one file, which is looked at; nullptr: verify converts the input itself.
  std::shared_ptr<const Outcome> converted;
  // Of a replay: values of fields and host inputs, which the translation gets as arguments like drawn ones.
  NamedTexts values;
  // Of a replay: where the part stands, X, Y, Z, mm, and turned about Z, degrees; the system that is active.
  std::optional<std::array<double, 4>> partError;
  std::optional<std::uint32_t> activeSystem; // 54 to 59
  bool replay = false; // one case, all of whose values are given: nothing is made smaller
  // Told from time to time how many of how many cases are done; from one thread at a time.
  std::function<void(std::uint64_t done, std::uint64_t all)> progress;
  // Told of each case by its number, edge cases behind the others: whether it is proved, and what the
  // translation did, as `sim` traces it (docs/sim.md). Before it stands a line `start X Y Z`, behind it the
  // zeros of the work systems and the variables that the source stores. In any order, from one thread at a
  // time.
  std::function<void(std::uint64_t number, bool proved, const std::string& trace)> traces;
};

// One file of a result that may have several; `output` holds them one behind the other.
struct OutputFile {
  std::string name; // "O8000.nc"
  std::string text;
};

// An argument of a program that convert has written.
struct OutputArgument {
  std::string name; // of the parameter or the host input
  char letter = 0;
};

// What a command gives. `status` is 0, 1 or 2 as docs/cli.md says; with a status other than 0 of post,
// `output` is empty.
struct Outcome {
  int status = 0;
  std::string output;
  std::vector<OutputFile> files;  // of convert, and pictures of sim
  std::string map;                // of convert: what --map writes
  std::vector<MappedResult> maps; // the same, file by file; places are of `sources`
  std::string macros;             // of convert: the set that the last result calls; "": none
  std::vector<std::vector<OutputArgument>> arguments; // of convert to fanuc, cycle by cycle
  std::vector<std::string> macrosByCycle;             // the sets that these call
  SourceMap sources;
  Diagnostics diagnostics; // sorted
};

Outcome post(const PostOptions& options);
// Each folder becomes a program, each file of programs another file; with a status other than 0 there is
// none.
Outcome convert(const ConvertOptions& options);
// The diagnostics are the result; status is 2 where a file could not be read, 1 with a finding at or above
// the severity of --fail-on.
Outcome lint(const LintOptions& options);
// The findings of lint as SARIF 2.1.0; paths as they were given.
std::string sarif(const Outcome& outcome);
Outcome dump(const DumpOptions& options);
// Runs a program on a machine. The status is 0 where it came to its end; the trace and the summary are given
// up to the place where it did not.
Outcome sim(const SimOptions& options);
// Runs source and translation on many drawn cases and compares what they do. The output is the report; its
// last line counts: `proved P, idle I, differ D of N`.
Outcome verify(const VerifyOptions& options);
// The text of one message or rule; status 2 for an unknown code.
Outcome explain(const std::string& code);
// `what`: cycles, controls, macros, forms, rules, targets, hosts, limits, assumptions.
Outcome list(const std::string& what, const CommonOptions& options);

} // namespace dotek::driver
