// The flags of the commands: what CLI11 fills, and the parts that several commands share. One Options*.cpp a
// command.
#pragma once

#include "cli/Arguments.h"
#include "driver/Driver.h"
#include "driver/ProgramTools.h"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dotek::cli {

// A wrong command line; the text follows `dotek: error: `.
class UsageError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

// What CLI11 fills; turned into Arguments afterwards. Empty text: the flag was not given.
struct Raw {
  std::vector<std::string> inputs;
  std::vector<std::string> set, field, host, assume, limit, data, include;
  std::string includeRoot, job, encoding, from, prog, routine, cycle, form, clearance, sequence, output;
  std::string format = "text", color = "auto";
  std::string standardInputName; // --stdin-filename
  std::vector<std::string> select, ignore;
  std::string failOn;
  bool fix = false, followLinks = false, listSkipped = false, statistics = false;
  std::string baseline, writeBaseline, changedSince, cache;
  bool watch = false;
  bool write = false, check = false; // of fmt
  std::string stage = "ast";
  std::vector<std::string> letters, defaults;
  std::string to, control, fromControl, renumber, probeMacros, probeOn, probeOff, programNumber, outputFolder,
      mapFile, helpersFile;
  std::string defaultsMode = "alarm";
  std::string probePower = "source";
  std::string calls = "inline";
  std::string datum;
  std::vector<std::string> results;
  std::vector<std::string> variables, shown; // --var, --show
  std::vector<std::string> programs;
  std::vector<std::string> auxiliary; // --auxiliary
  std::string start, step, range;     // of renumber
  bool all = false;                   // of renumber
  bool diff = false;                  // of fmt
  std::string traceFile, svgFile, htmlFile;
  std::string stock, stockMap; // of sim
  std::string part, machine, device, partError, translation;
  std::vector<std::string> values; // --value
  std::string cases, seed, jobs, minAgreed, tolerance, activeSystem;
  std::string report; // --report, of convert
  std::string date;   // --date, of sim, verify and convert
  std::string remark; // --remark, of verify and convert
  std::vector<std::string> workOffsets;
  std::vector<std::string> properties;         // --property
  std::string matrix, otherPost, expect, unit; // of run-post
  std::string tool, length, radius, diameter, at, call;
  bool replay = false, allowEdits = false;
  bool json = false, quiet = false, force = false;
  std::uint32_t maxErrors = 50;
  bool recover = false;
  bool keepGoing = false;
  bool wholePost = false;
  bool verify = false;
  std::string simDatum; // --datum of sim, a place; that of convert is a way
};

// NAME=VALUE in two; throws UsageError where there is no name or no `=`.
std::pair<std::string, std::string> splitPair(const std::string& flag, const std::string& text);

// Decimal digits only, without sign; nothing otherwise.
std::optional<std::uint64_t> wholeNumber(std::string_view text);

// START:STEP of two whole numbers, the step not 0; throws UsageError.
std::pair<std::uint64_t, std::uint64_t> startAndStep(const std::string& flag, const std::string& text);

// A whole number from least to most, `otherwise` where the text is empty; throws UsageError.
std::uint64_t countOf(const std::string& flag, const std::string& text, std::uint64_t otherwise,
                      std::uint64_t least, std::uint64_t most);

// The same for a decimal number.
double numberOf(const std::string& flag, const std::string& text, double otherwise, double least,
                double most);

// A flag of several values, named once for each or with commas between them: `type` is one of them,
// "NAME=VALUE". The help says so.
void addSeveral(CLI::App& app, const char* flag, std::vector<std::string>& into, const std::string& what,
                const std::string& type);
// The same for folders, in whose names a comma may be: once for each.
void addFolders(CLI::App& app, const char* flag, std::vector<std::string>& into, const std::string& what);

// The values of such a flag, taken apart at the commas.
std::vector<std::string> listOf(const std::vector<std::string>& given);
// Pairs of such a flag; throws UsageError as splitPair does.
driver::NamedTexts pairsOf(const std::string& flag, const std::vector<std::string>& given);

// Flags that several commands have.
void addCommon(CLI::App& app, Raw& raw);
void addProbeCodes(CLI::App& app, Raw& raw);
void addValues(CLI::App& app, Raw& raw);
void addStandardInput(CLI::App& app, Raw& raw); // the name of what comes by `-`
void addIncludes(CLI::App& app, Raw& raw);      // which files inputs may name
void addSource(CLI::App& app, Raw& raw);        // what says where the post is
void addTarget(CLI::App& app, Raw& raw);
// Of convert and verify: what a translation is. `to`: what --to says there.
void addTranslation(CLI::App& app, Raw& raw, const std::string& to);
void fillTranslation(const Raw& raw, targets::TranslationOptions& options);
void addForce(CLI::App& app, Raw& raw, const char* also = "");
std::optional<std::uint32_t> programNumberOf(const Raw& raw);
targets::ReportFormat reportFormatOf(const std::string& path); // by the ending of its name
std::string noReport(const std::string& path); // why a name cannot be that of a report; "": it can
driver::CommonOptions commonOf(const Raw& raw);

// The commands: each adds itself to the application, and each with options of its own reads them from what
// was given.
void addPost(CLI::App& app, Raw& raw);
void addRunPost(CLI::App& app, Raw& raw);
// What of a program convert is asked for, and verify that it was: --defaults, --arg, --probe-power.
void addOfProgram(CLI::App& command, Raw& raw);
void addConvert(CLI::App& app, Raw& raw);
void addLint(CLI::App& app, Raw& raw);
void addDump(CLI::App& app, Raw& raw);
void addSim(CLI::App& app, Raw& raw);
void addVerify(CLI::App& app, Raw& raw);
void addNew(CLI::App& app, Raw& raw);
void addInit(CLI::App& app, Raw& raw);
void addCheck(CLI::App& app, Raw& raw);
void addFmt(CLI::App& app, Raw& raw);
void addDoc(CLI::App& app, Raw& raw);
void addPreview(CLI::App& app, Raw& raw);
void addLsp(CLI::App& app, Raw& raw);
void addExplain(CLI::App& app, Raw& raw);
void addOutline(CLI::App& app, Raw& raw);
void addRenumber(CLI::App& app, Raw& raw);
void addFlatten(CLI::App& app, Raw& raw);
// Flags of a run, which `sim` and `flatten` share: part and machine; what an operator sets. simOf() reads
// them.
void addPart(CLI::App& command, Raw& raw, const char* what);
void addSetup(CLI::App& command, Raw& raw);
void addList(CLI::App& app, Raw& raw);

driver::ConvertOptions convertOf(const Raw& raw);
driver::LintOptions lintOf(const Raw& raw);
driver::RunPostOptions runPostOf(const Raw& raw);
void checkDump(const Raw& raw); // throws UsageError
driver::SimOptions simOf(const Raw& raw);
sim::DeviceOptions deviceOf(const Raw& raw);
driver::VerifyOptions verifyOf(const Raw& raw);
driver::RenumberCommandOptions renumberOf(const Raw& raw);

} // namespace dotek::cli
