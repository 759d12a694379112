// What convert and verify are reported, and the pieces of what convert gives.
#pragma once

#include "project/Options.h"
#include "support/Diagnostics.h"
#include "support/LineMap.h"
#include "support/OutputFile.h"
#include "support/Source.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dotek::targets {

// A target is a view of a project and speaks of its parts by their names.
using namespace project; // NOLINT(google-build-using-namespace)

// How a call of a cycle of the cycle language is written.
enum class Calls : std::uint8_t {
  Inline,     // the called cycle in its place
  Subprogram, // a program of the same file
  Vendor,     // a call of the macro set where it has the cycle, else in its place
};

// What a translation is, for who writes it and for who compares it with its source.
struct TranslationOptions {
  std::vector<std::string> inputs; // folders of cycles, files of programs; verify takes one
  CommonOptions common;
  SourceOptions source;
  std::string to;                         // verify: "": the path of the macro against the posted program
  std::string control;                    // "": the target's first
  std::string fromControl;                // that programs are written for; "": the same
  std::optional<std::string> probeMacros; // nothing: the set that the source calls
  std::string datum;                      // --datum of mikroprog: "", "g92" or "operator"
  Calls calls = Calls::Inline;            // --calls, of files of the cycle language
  NamedTexts results;                     // --result NAME=#NUMBER, of files of the cycle language
  // Told from time to time how many cases are done; from one thread at a time.
  std::function<void(const std::string& text)> progress;
};

// Of verify and of convert --verify. Text: the line of the verdict. The others: a document beside it.
enum class ReportFormat : std::uint8_t { Text, Markdown, Html, Json };

struct ConvertOptions : TranslationOptions {
  std::optional<std::uint32_t> programNumber;
  NamedTexts letters;                                              // --arg NAME=LETTER
  NamedTexts defaults;                                             // --default NAME=VALUE
  bool useDefaults = false;                                        // --defaults use
  bool switchProbe = false;                                        // --probe-power macro
  bool oneFile = false;                                            // -o: several inputs are an error
  std::optional<std::pair<std::uint64_t, std::uint64_t>> renumber; // first N number of programs, step
  bool wholePost = false;                                          // --whole-post, of fusion
  NamedTexts variables; // --var N=VALUE, of programs: what is written are the plain blocks of a run with them
  bool helpersApart = false;          // --helpers, of fusion: what fragments share is given by itself
  bool verify = false;                // --verify: what does not agree with its source is not given
  bool keepGoing = false;             // --keep-going: an input that is refused takes no other with it
  std::optional<ReportFormat> report; // --report: what verify says of each input is given, too
  std::string date, remark;           // that these documents bear; "": none
};

// An argument of a program that convert has written.
struct OutputArgument {
  std::string name; // of the parameter or the host input
  char letter = 0;
};

// The result of one input, by itself.
struct ConvertedInput {
  OutputFile file;
  MappedResult map; // places are of `sources`
  std::vector<OutputArgument> arguments;
  std::set<std::uint32_t> handedBack; // common variables in which its programs hand results to one another
  std::string macros;                 // the set that it calls; "": none
  Diagnostics said;                   // by convert, of this input
  SourceMap sources;
};

struct VerifyOptions : TranslationOptions {
  std::optional<std::string> part, machine; // paths
  // A program that is looked at instead of what convert writes now: the same arguments, edited by hand. Path.
  std::optional<std::string> translation;
  std::optional<std::uint32_t> programNumber; // of what convert writes
  std::uint64_t cases = 1000;
  std::uint64_t seed = 1;
  double minAgreed = 95;     // percent of the cases that have to agree
  double tolerance = 1e-6;   // mm
  std::uint32_t jobs = 0;    // 0: one for each processor
  NamedTexts variables;      // --var N=VALUE, of programs: not drawn
  bool oneOfSeveral = false; // what --set and --field name may be of another input
  bool byConvert = false;    // what the report names as its command is `convert --verify`
  bool allowEdits = false;   // lines of it that no case tells from what convert writes are warnings
  // Of what convert writes: --default, --defaults use, --probe-power macro, --arg.
  bool switchProbe = false;
  NamedTexts defaults;
  bool useDefaults = false;
  NamedTexts letters;
  // What convert wrote; nullptr: verify converts the input itself.
  std::shared_ptr<const ConvertedInput> converted;
  // Of a replay: values of fields and host inputs, which the translation gets as arguments like drawn ones.
  NamedTexts values;
  // Of a replay: where the part is, X, Y, Z, mm, and turned about Z, degrees; the system that is active.
  std::optional<std::array<double, 4>> partError;
  std::optional<std::uint32_t> activeSystem; // 54 to 59
  ReportFormat format = ReportFormat::Text;
  std::string date;    // that the document bears; "": none
  std::string remark;  // the same: a line below its title
  bool replay = false; // one case, all of whose values are given: nothing is made smaller
  // Given each case by its number, edge cases after the others: whether it agrees, and what the
  // translation did, as `sim` traces it (docs/sim.md). Before it is a line `start X Y Z`, after it the
  // zeros of the work systems and the variables that the source stores. In any order, from one thread at a
  // time.
  std::function<void(std::uint64_t number, bool agrees, const std::string& trace)> traces;
};

} // namespace dotek::targets
