// The arguments of a command line, taken apart. The only user of CLI11.
#pragma once

#include "driver/Driver.h"
#include "driver/LintCache.h"
#include "driver/ProgramTools.h"
#include "driver/RunPost.h"
#include "driver/SimDevice.h"

#include <iosfwd>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dotek::cli {

enum class Command : unsigned char {
  Post,
  RunPost,
  Convert,
  Lint,
  Dump,
  Explain,
  List,
  New,
  NewCycle,
  NewMacros,
  NewJob,
  NewPost,
  Init,
  Check,
  Fmt,
  Doc,
  Preview,
  Sim,
  Verify,
  Lsp,
  Outline,
  Renumber,
  Flatten
};

enum class ColorMode : unsigned char { Auto, Always, Never };

struct Arguments {
  Command command = Command::Post;
  std::vector<std::string> inputs;
  driver::CommonOptions common;
  driver::SourceOptions source;
  std::optional<std::pair<std::uint64_t, std::uint64_t>> sequence;
  std::string output;             // -o
  std::string standardInputName;  // --stdin-filename
  bool json = false;              // of sim and outline: --json
  std::string format = "text";    // of lint and check
  bool watch = false;             // of lint
  bool statistics = false;        // of lint: --statistics
  std::string baselineFile;       // of lint: --write-baseline
  driver::LintCache cache;        // of lint: --cache; its folder is "" without
  driver::RunPostOptions runPost; // common aside
  driver::LintOptions lint;       // paths, common and source aside
  driver::ConvertOptions convert; // inputs, common and source aside
  std::string outputFolder;       // -d
  std::string mapFile;            // --map
  std::string helpersFile;        // --helpers
  std::string reportFile;         // --report
  driver::SimOptions sim;         // common aside
  sim::DeviceOptions device;      // of sim
  std::string traceFile;          // --trace
  std::string svgFile, htmlFile;  // --svg, --html
  std::string stockMapFile;       // --stock-map
  driver::VerifyOptions verify;   // inputs, common and source aside
  bool quiet = false;
  ColorMode color = ColorMode::Auto;
  bool force = false; // of --force: outputs that are write-protected are replaced
  driver::Stage stage = driver::Stage::Ast;
  bool write = false, check = false;       // of fmt: --write, --check
  bool diff = false;                       // of fmt
  driver::RenumberCommandOptions renumber; // inputs and common aside
  std::uint32_t maxErrors = 50;
};

// As it is typed: "lint"; of `new job` and the like "".
std::string_view commandName(Command command);

// Fills `parsed`. A status where nothing is left to do: help, version, or wrong arguments.
std::optional<int> parseArguments(const std::vector<std::string>& arguments, Arguments& parsed,
                                  std::ostream& out, std::ostream& err);

} // namespace dotek::cli
