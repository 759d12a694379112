#include "cli/Cli.h"

#include "cli/Arguments.h"
#include "driver/Driver.h"
#include "support/Files.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <memory>
#include <ostream>
#include <unistd.h>

namespace dotek::cli {
namespace {

// Prints what a command found and wrote; the status of the process.
class Printer {
public:
  Printer(std::ostream& out, std::ostream& err, std::uint32_t maxErrors)
      : out_(out), err_(err), maxErrors_(maxErrors) {}

  // Results to standard output or `-o`, diagnostics to standard error.
  int result(const driver::Outcome& outcome, const std::string& file) {
    err_ << renderText(outcome.diagnostics, outcome.sources, maxErrors_);
    if (outcome.status != 0) {
      out_ << outcome.output;
      return outcome.status;
    }
    if (file.empty()) {
      out_ << outcome.output;
      return kDone;
    }
    Diagnostics writing;
    if (writeAtomically(file, outcome.output, writing)) return kDone;
    err_ << renderText(writing, outcome.sources, maxErrors_);
    return kUsage;
  }

  // Programs to standard output, `-o` or `-d`; the map beside them.
  int programs(const driver::Outcome& outcome, const Arguments& arguments) {
    err_ << renderText(outcome.diagnostics, outcome.sources, maxErrors_);
    if (outcome.status != 0) return outcome.status;
    std::vector<std::pair<std::string, const std::string*>> writes;
    if (!arguments.outputFolder.empty()) {
      for (const driver::OutputFile& file : outcome.files)
        writes.emplace_back(arguments.outputFolder + "/" + file.name, &file.text);
    } else if (!arguments.output.empty()) {
      writes.emplace_back(arguments.output, &outcome.output);
    }
    if (!arguments.mapFile.empty()) writes.emplace_back(arguments.mapFile, &outcome.map);
    Diagnostics writing;
    if (!writeAllAtomically(writes, arguments.outputFolder, writing)) {
      err_ << renderText(writing, outcome.sources, maxErrors_);
      return kUsage;
    }
    if (arguments.output.empty() && arguments.outputFolder.empty()) out_ << outcome.output;
    return kDone;
  }

  // The trace goes to standard output while the program runs, or to `--trace`; what stops the run is no
  // defect of the trace.
  int simulation(driver::SimOptions& options, const Arguments& arguments) {
    Diagnostics writing;
    std::unique_ptr<AtomicFile> file;
    bool ran = false; // each run has a last line; a refused program has no trace
    if (!arguments.traceFile.empty()) {
      file = AtomicFile::create(arguments.traceFile, writing);
      if (file)
        options.trace = [&](std::string_view text) {
          ran = true;
          file->write(text);
        };
    } else if (!arguments.quiet && !options.json) {
      options.trace = [&](std::string_view text) { out_ << text; };
    }
    driver::Outcome outcome;
    if (writing.empty()) outcome = driver::sim(options);
    out_ << outcome.output;
    err_ << renderText(outcome.diagnostics, outcome.sources, maxErrors_);
    if (file && ran && outcome.status != 2) file->commit(writing);
    std::vector<std::pair<std::string, const std::string*>> pictures;
    for (const driver::OutputFile& one : outcome.files)
      pictures.emplace_back(one.name == "svg" ? arguments.svgFile : arguments.htmlFile, &one.text);
    if (outcome.status != 2 && !pictures.empty()) writeAllAtomically(pictures, "", writing);
    err_ << renderText(writing, SourceMap(), maxErrors_);
    return writing.hasErrors() ? kUsage : outcome.status;
  }

  // The report counts also where something differs; a terminal sees how far the run is.
  int verification(driver::VerifyOptions& options, const Arguments& arguments) {
    if (isatty(STDERR_FILENO) == 1) {
      options.progress = [&](std::uint64_t done, std::uint64_t all) {
        err_ << "\r" << done << " of " << all << " cases" << (done == all ? "\r\x1b[K" : "") << std::flush;
      };
    }
    const driver::Outcome outcome = driver::verify(options);
    err_ << renderText(outcome.diagnostics, outcome.sources, maxErrors_);
    Diagnostics writing;
    if (arguments.output.empty())
      out_ << outcome.output;
    else if (outcome.status != kUsage && !writeAtomically(arguments.output, outcome.output, writing))
      err_ << renderText(writing, outcome.sources, maxErrors_);
    return writing.hasErrors() ? kUsage : outcome.status;
  }

  // Findings are the result.
  int findings(const driver::Outcome& outcome, const Arguments& arguments) {
    out_ << (arguments.sarif  ? driver::sarif(outcome)
             : arguments.json ? renderJson(outcome.diagnostics, outcome.sources)
                              : renderText(outcome.diagnostics, outcome.sources, maxErrors_));
    return outcome.status;
  }

private:
  std::ostream& out_;
  std::ostream& err_;
  std::uint32_t maxErrors_;
};

int runCommand(Arguments& arguments, std::ostream& out, std::ostream& err) {
  Printer printer(out, err, arguments.maxErrors);
  switch (arguments.command) {
  case Command::Post:
    return printer.result(
        driver::post({arguments.inputs, arguments.common, arguments.source, arguments.sequence}),
        arguments.output);
  case Command::Convert: {
    driver::ConvertOptions& options = arguments.convert;
    options.inputs = arguments.inputs;
    options.common = arguments.common;
    options.source = arguments.source;
    options.oneFile = !arguments.output.empty();
    return printer.programs(driver::convert(options), arguments);
  }
  case Command::Lint: {
    driver::LintOptions& options = arguments.lint;
    options.paths = arguments.inputs;
    options.common = arguments.common;
    options.source = arguments.source;
    return printer.findings(driver::lint(options), arguments);
  }
  case Command::Dump:
    return printer.result(driver::dump({arguments.inputs, arguments.stage, arguments.common, arguments.source,
                                        arguments.convert.control}),
                          "");
  case Command::Sim:
    arguments.sim.program = arguments.inputs.empty() ? "" : arguments.inputs.front();
    arguments.sim.common = arguments.common;
    return printer.simulation(arguments.sim, arguments);
  case Command::Verify:
    arguments.verify.inputs = arguments.inputs;
    arguments.verify.common = arguments.common;
    arguments.verify.source = arguments.source;
    return printer.verification(arguments.verify, arguments);
  case Command::Explain: return printer.result(driver::explain(arguments.inputs.front()), "");
  case Command::New:
    return printer.result(driver::newForm({arguments.inputs.back(), arguments.source.prog, arguments.common}),
                          arguments.output);
  case Command::List: return printer.result(driver::list(arguments.inputs.front(), arguments.common), "");
  }
  return kDefect;
}

} // namespace

int run(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  try {
    Arguments parsed;
    if (const std::optional<int> status = parseArguments(arguments, parsed, out, err)) return *status;
    return runCommand(parsed, out, err);
  } catch (const std::bad_alloc&) {
    err << "dotek: error: out of memory; this is a defect of Dotek\n";
  } catch (const std::exception& error) {
    err << "dotek: error: " << error.what() << "; this is a defect of Dotek\n";
  }
  return kDefect;
}

} // namespace dotek::cli
