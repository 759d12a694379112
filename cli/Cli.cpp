#include "cli/Cli.h"

#include "cli/Arguments.h"
#include "driver/Driver.h"
#include "support/Files.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <ostream>

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

  // Findings are the result.
  int findings(const driver::Outcome& outcome, bool json, std::optional<Severity> failOn) {
    out_ << (json ? renderJson(outcome.diagnostics, outcome.sources)
                  : renderText(outcome.diagnostics, outcome.sources, maxErrors_));
    if (outcome.status != 0) return outcome.status;
    const auto& all = outcome.diagnostics.all();
    const bool fails = failOn && std::any_of(all.begin(), all.end(),
                                             [&](const Diagnostic& d) { return d.severity >= *failOn; });
    return fails ? kInputError : kDone;
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
    const driver::LintOptions options{arguments.inputs, arguments.common, arguments.source, arguments.select,
                                      arguments.ignore};
    return printer.findings(driver::lint(options), arguments.json, arguments.failOn);
  }
  case Command::Dump:
    return printer.result(driver::dump({arguments.inputs, arguments.stage, arguments.common, arguments.source,
                                        arguments.convert.control}),
                          "");
  case Command::Explain: return printer.result(driver::explain(arguments.inputs.front()), "");
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
