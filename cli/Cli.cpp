#include "cli/Cli.h"

#include "cli/Arguments.h"
#include "cli/Diff.h"
#include "cli/Documents.h"
#include "cli/Files.h"
#include "cli/Findings.h"
#include "cli/Progress.h"
#include "cli/StandardInput.h"
#include "cli/Watch.h"
#include "driver/Driver.h"
#include "driver/Facts.h"
#include "driver/LintFix.h"
#include "driver/Preview.h"
#include "driver/ProgramTools.h"
#include "lsp/Serve.h"
#include "project/CycleFolder.h"
#include "project/Settings.h"
#include "sim/run/SimReport.h"
#include "support/FileIdentity.h"
#include "support/Output.h"
#include "support/OutputCheck.h"
#include "support/Printable.h"
#include "support/RenderText.h"
#include "support/Stream.h"
#include "support/Worker.h"
#include "support/messages/Output.h"
#include "support/messages/Sim.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <memory>
#include <ostream>
#include <set>
#include <unistd.h>

namespace dotek::cli {
namespace {

// What a layout changes of a file.
std::string diffOf(const driver::OutputFile& file, const SourceMap& sources) {
  for (FileId id = 0; id < sources.size(); ++id)
    if (sources.file(id).name() == file.name)
      return lineDiff(file.name, sources.file(id).bytes(), file.text, isatty(STDOUT_FILENO) == 1);
  return "";
}

// no-color.org: any value but an empty one.
bool wantsNoColors() {
  const char* const set = std::getenv("NO_COLOR");
  return set != nullptr && *set != '\0';
}

// `auto`: on a terminal that understands them.
Colors colorsOf(ColorMode mode, int descriptor) {
  if (mode != ColorMode::Auto) return mode == ColorMode::Always ? Colors::Terminal : Colors::None;
  const char* const terminal = std::getenv("TERM");
  const bool dumb = terminal == nullptr || std::string_view(terminal) == "dumb";
  return !wantsNoColors() && !dumb && isatty(descriptor) == 1 ? Colors::Terminal : Colors::None;
}

// Prints what a command found and wrote; the status of the process.
class Printer {
public:
  Printer(std::ostream& out, std::ostream& err, const Arguments& arguments)
      : out_(out), err_(err), maxErrors_(arguments.maxErrors),
        outColors_(colorsOf(arguments.color, STDOUT_FILENO)),
        errColors_(colorsOf(arguments.color, STDERR_FILENO)) {}

  // Before anything is done.
  bool canWrite(const Arguments& arguments) {
    Diagnostics found;
    const bool good = checkOutputs(outputsOf(arguments), inputsOf(arguments), arguments.force, found) &&
                      canChangeInputs(arguments, found);
    return begins(good, std::move(found), arguments);
  }

  bool canRead(Arguments& arguments) {
    Diagnostics found;
    const bool good = takeStandardInput(arguments, found);
    return begins(good, std::move(found), arguments);
  }

  // Results to standard output or `-o`, diagnostics to standard error.
  int result(const driver::Outcome& outcome, const Arguments& arguments) {
    err_ << renderText(outcome.diagnostics, outcome.sources, maxErrors_, errColors_);
    if (outcome.status != 0) {
      out_ << outcome.output;
      return outcome.status;
    }
    return write({{orStandardOutput(arguments.output), &outcome.output}}, outcome, arguments) ? kDone
                                                                                              : kUsage;
  }

  // One new file; a line says where it is.
  int begun(const driver::Outcome& outcome, const Arguments& arguments) {
    err_ << renderText(outcome.diagnostics, outcome.sources, maxErrors_, errColors_);
    if (outcome.status != 0) return outcome.status;
    const driver::OutputFile& file = outcome.files.front();
    if (!write({{file.name, &file.text}}, outcome, arguments)) return kUsage;
    out_ << printable(outcome.summary) << "\n";
    return kDone;
  }

  // The program of a post; the map beside it. What --check finds is in the program, which is written all the
  // same.
  int posted(const driver::Outcome& outcome, const Arguments& arguments) {
    const driver::RunPostOptions& options = arguments.runPost;
    const bool found = options.check && !options.diff && !options.expect && outcome.status == kInputError &&
                       !outcome.output.empty();
    if (outcome.status != 0 && !found) return result(outcome, arguments);
    err_ << renderText(outcome.diagnostics, outcome.sources, maxErrors_, errColors_);
    if (!outcome.summary.empty()) err_ << outcome.summary << "\n";
    std::vector<NamedText> texts = {{orStandardOutput(arguments.output), &outcome.output}};
    std::string map;
    if (!arguments.mapFile.empty()) {
      map = renderLineMap(outcome.maps, outcome.sources);
      texts.push_back({arguments.mapFile, &map});
    }
    // The program is no input, though findings are placed in it.
    driver::Outcome inputs;
    for (FileId file = 0; file < outcome.sources.size(); ++file)
      if (const SourceFile& one = outcome.sources.file(file); !options.check || one.name() != options.name)
        inputs.sources.add(one);
    return write(texts, inputs, arguments) ? outcome.status : kUsage;
  }

  // Programs to standard output, `-o` or `-d`; the map beside them.
  int programs(const driver::Outcome& outcome, const Arguments& arguments) {
    err_ << renderText(outcome.diagnostics, outcome.sources, maxErrors_, errColors_);
    if (!arguments.quiet && !outcome.summary.empty()) err_ << outcome.summary << "\n";
    std::vector<NamedText> texts;
    for (const driver::OutputFile& report : outcome.reports)
      texts.push_back({reportPath(arguments, report.name), &report.text});
    // With --keep-going there are results beside what is refused.
    if (outcome.status != 0 && outcome.files.empty()) {
      return texts.empty() || write(texts, outcome, arguments) ? outcome.status : kUsage;
    }
    std::set<std::string> held; // stay what they are
    if (Diagnostics others; !arguments.force) {
      held = heldByOthers(outcome.files, arguments.outputFolder, others);
      err_ << renderText(others, SourceMap(), maxErrors_, errColors_);
      if (!held.empty() && !arguments.convert.keepGoing) return kUsage;
    }
    for (const driver::OutputFile& file : outcome.files)
      if (!arguments.outputFolder.empty() && !held.contains(file.name))
        texts.push_back({arguments.outputFolder + "/" + file.name, &file.text});
    if (arguments.outputFolder.empty())
      texts.push_back({orStandardOutput(arguments.output), &outcome.output});
    std::string map;
    if (!arguments.mapFile.empty()) {
      map = renderLineMap(outcome.maps, outcome.sources);
      texts.push_back({arguments.mapFile, &map});
    }
    if (!arguments.helpersFile.empty()) texts.push_back({arguments.helpersFile, &outcome.helpers});
    if (!write(texts, outcome, arguments)) return kUsage;
    return held.empty() ? outcome.status : kInputError;
  }

  // The trace goes to standard output while the program runs, or to `--trace`; what stops the run is no
  // defect of the trace.
  int simulation(driver::SimOptions& options, const Arguments& arguments) {
    Diagnostics writing;
    const WriteOptions how{arguments.force, &out_};
    std::vector<std::unique_ptr<Output>> outputs;
    const auto add = [&](const std::string& path) {
      auto output = Output::open(path, how, writing);
      if (output) outputs.push_back(std::move(output));
      return !writing.hasErrors();
    };
    bool ran = false; // each run has a last line; a refused program has no trace
    const bool traces = !arguments.traceFile.empty() || (!arguments.quiet && !options.json);
    if (traces && add(orStandardOutput(arguments.traceFile)))
      options.trace = [&, trace = outputs.front().get()](std::string_view text) {
        ran = true;
        trace->write(text);
      };
    driver::Outcome outcome;
    if (writing.empty())
      // A trace on the terminal shows that it runs.
      outcome = [&] {
        const Progress progress("sim", !arguments.quiet && (!options.trace || isatty(STDOUT_FILENO) != 1 ||
                                                            !arguments.traceFile.empty()));
        return driver::sim(options, arguments.device);
      }();
    else if (options.json)
      outcome.output = sim::notRunSummary(writing, SourceMap());
    for (Diagnostic& one : outcome.diagnostics.all()) {
      if (one.code != diag::PictureNotWritten::code) continue;
      for (const std::string& path : {arguments.svgFile, arguments.htmlFile})
        if (std::error_code fault; std::filesystem::is_regular_file(path, fault))
          one.note({}, "`" + path + "` is from an earlier run");
    }
    if (!arguments.quiet || options.json) out_ << outcome.output; // else of a trace that goes to a file
    err_ << renderText(outcome.diagnostics, outcome.sources, maxErrors_, errColors_);
    if (!ran || outcome.status == kUsage) outputs.clear();
    const std::string reportPicture = pictureBeside(arguments.reportFile);
    for (const driver::OutputFile& one : outcome.files) {
      const std::string& path = one.name == "svg"         ? arguments.svgFile
                                : one.name == "html"      ? arguments.htmlFile
                                : one.name == "stock-map" ? arguments.stockMapFile
                                : one.name == "report"    ? arguments.reportFile
                                                          : reportPicture;
      if (outcome.status == kUsage || !add(path)) break;
      outputs.back()->write(one.text);
    }
    const std::vector<std::string> paths = {
        orStandardOutput(arguments.traceFile),  orStandardOutput(arguments.svgFile),
        orStandardOutput(arguments.htmlFile),   orStandardOutput(arguments.stockMapFile),
        orStandardOutput(arguments.reportFile), orStandardOutput(reportPicture)};
    const bool placed =
        !writing.hasErrors() && checkRead(paths, outcome.sources, writing) && placeAll(outputs, writing);
    err_ << renderText(writing, SourceMap(), maxErrors_, errColors_);
    return placed ? outcome.status : kUsage;
  }

  // The report counts also where something differs.
  int verification(const driver::Outcome& outcome, const Arguments& arguments) {
    const driver::VerifyOptions& options = arguments.verify;
    err_ << renderText(outcome.diagnostics, outcome.sources, maxErrors_, errColors_);
    if (outcome.status == kUsage) return kUsage;
    // Nothing ran: an old report stays what it is, and so does a file of the source that nobody has read.
    const bool text = options.format == targets::ReportFormat::Text;
    if (text ? outcome.output.empty() : outcome.files.empty()) return outcome.status;
    const std::string& report = text ? outcome.output : outcome.files.front().text;
    if (!arguments.output.empty() && !outcome.files.empty()) out_ << outcome.output;
    return write({{orStandardOutput(arguments.output), &report}}, outcome, arguments) ? outcome.status
                                                                                      : kUsage;
  }

  // Findings are the result.
  int findings(const driver::Outcome& outcome, const Arguments& arguments) {
    out_ << (arguments.statistics ? statisticsOf(outcome.diagnostics)
             : arguments.format != "text"
                 ? findingsDocument(arguments.format, outcome)
                 : renderText(outcome.diagnostics, outcome.sources, maxErrors_, outColors_));
    out_.flush(); // on a terminal the closing lines come last
    if (!arguments.quiet && !outcome.summary.empty()) err_ << outcome.summary << "\n";
    std::string line = closingLine(outcome.diagnostics);
    if (line.empty() && arguments.watch && outcome.diagnostics.empty()) line = "no findings";
    if (!line.empty() && !arguments.quiet && isatty(STDERR_FILENO) == 1) err_ << line << "\n";
    if (outcome.status == kUsage || arguments.baselineFile.empty()) return outcome.status;
    std::vector<NamedText> texts;
    for (const driver::OutputFile& file : outcome.files)
      texts.push_back({arguments.baselineFile, &file.text});
    return write(texts, outcome, arguments) ? outcome.status : kUsage;
  }

  // Repairs as a patch; findings only where nothing could be read.
  int proposals(const driver::Outcome& outcome, const Arguments& arguments) {
    if (outcome.status > kInputError)
      err_ << renderText(outcome.diagnostics, outcome.sources, maxErrors_, errColors_);
    for (const driver::OutputFile& file : outcome.files)
      out_ << diffOf(file, outcome.sources);
    out_.flush();
    if (!arguments.quiet && !outcome.summary.empty()) err_ << outcome.summary << "\n";
    return outcome.status;
  }

  // One text to standard output, or those that change in place, or the names of these.
  int layout(const driver::Outcome& outcome, const Arguments& arguments) {
    err_ << renderText(outcome.diagnostics, outcome.sources, maxErrors_, errColors_);
    std::vector<NamedText> texts;
    for (const driver::OutputFile& file : outcome.files) {
      const bool changes =
          std::find(outcome.inputs.begin(), outcome.inputs.end(), file.name) != outcome.inputs.end();
      if (arguments.diff && changes) out_ << diffOf(file, outcome.sources);
      if (arguments.check && changes) out_ << printable(file.name) << "\n";
      if (arguments.write && changes) texts.push_back({file.name, &file.text});
      if (!arguments.check && !arguments.diff && !arguments.write && outcome.status == 0)
        texts.push_back({orStandardOutput(arguments.output), &file.text});
    }
    if (arguments.check || arguments.diff)
      return outcome.status != 0 || outcome.inputs.empty() ? outcome.status : kInputError;
    Diagnostics writing;
    const bool done = writeAll(texts, "", {arguments.force, &out_}, writing);
    err_ << renderText(writing, SourceMap(), maxErrors_, errColors_);
    return done ? outcome.status : kUsage;
  }

  // The pages as files of a folder, or their Markdown as one text.
  int catalogue(const driver::Outcome& outcome, const Arguments& arguments) {
    err_ << renderText(outcome.diagnostics, outcome.sources, maxErrors_, errColors_);
    if (outcome.status != 0) return outcome.status;
    std::vector<NamedText> texts;
    if (arguments.outputFolder.empty()) texts.push_back({"-", &outcome.output});
    for (const driver::OutputFile& file : outcome.files)
      if (!arguments.outputFolder.empty())
        texts.push_back({arguments.outputFolder + "/" + file.name, &file.text});
    return write(texts, outcome, arguments) ? outcome.status : kUsage;
  }

private:
  // false: the command is not run; a document that is asked for says so.
  bool begins(bool good, Diagnostics found, const Arguments& arguments) {
    err_ << renderText(found, SourceMap(), maxErrors_, errColors_);
    if (good) return true;
    driver::Outcome refused;
    refused.status = kUsage;
    refused.diagnostics = std::move(found);
    out_ << notRunDocument(commandName(arguments.command), arguments.json, arguments.format, refused);
    return false;
  }

  bool write(const std::vector<NamedText>& texts, const driver::Outcome& outcome,
             const Arguments& arguments) {
    Diagnostics writing;
    std::vector<std::string> paths;
    for (const NamedText& one : texts)
      paths.push_back(one.path);
    const bool done = checkRead(paths, outcome.sources, writing) &&
                      writeAll(texts, outcome.files.empty() ? "" : arguments.outputFolder,
                               {arguments.force, &out_}, writing);
    err_ << renderText(writing, SourceMap(), maxErrors_, errColors_);
    return done;
  }

  std::ostream& out_;
  std::ostream& err_;
  std::uint32_t maxErrors_;
  Colors outColors_, errColors_;
};

// Data files of the project come before those of the command line, which replace them; so does what a flag
// says of the Prog or of a field.
void takeDefaultsOfProject(Arguments& arguments) {
  std::vector<std::string> inputs = inputsOf(arguments);
  if (arguments.command == Command::Init) return;
  if (inputs.empty()) inputs = {"."}; // `list forms`
  project::FlagDefaults defaults = project::flagDefaultsOf(inputs);
  if (arguments.command == Command::Lint) // of several shops below one folder
    for (const std::string& input : inputs)
      if (std::error_code error; std::filesystem::is_directory(input, error))
        for (std::string& one : project::dataBelow(input))
          if (std::find(defaults.data.begin(), defaults.data.end(), one) == defaults.data.end())
            defaults.data.push_back(std::move(one));
  std::vector<std::string>& given = arguments.common.data;
  std::erase_if(defaults.data, [&](const std::string& one) {
    return std::any_of(given.begin(), given.end(),
                       [&](const std::string& flag) { return identify(flag) == identify(one); });
  });
  given.insert(given.begin(), defaults.data.begin(), defaults.data.end());
  arguments.common.projectField = std::move(defaults.field);
  const bool posts = arguments.command == Command::Post || arguments.command == Command::Convert ||
                     arguments.command == Command::Verify || arguments.command == Command::Dump;
  const bool cycles = std::any_of(arguments.inputs.begin(), arguments.inputs.end(), &project::isCycleFolder);
  if (posts && cycles && !arguments.source.prog)
    arguments.source.prog = project::flagDefaultsOf(arguments.inputs).prog;
}

// What may take longer than a second, with a line on the terminal meanwhile.
template <class Work> driver::Outcome shown(const Arguments& arguments, Work work) {
  Progress progress(commandName(arguments.command), !arguments.quiet);
  return work(progress);
}

// The same of a command that says how far it is.
template <class Options, class Work>
driver::Outcome shown(const Arguments& arguments, Options& options, const Work& work) {
  return shown(arguments, [&](Progress& progress) {
    options.progress = [&](const std::string& text) { progress.say(text); };
    driver::Outcome outcome = work(options);
    options.progress = nullptr;
    return outcome;
  });
}

int runCommand(Arguments& arguments, std::ostream& out, std::ostream& err) {
  Printer printer(out, err, arguments);
  if (!printer.canRead(arguments)) return kUsage;
  takeDefaultsOfProject(arguments);
  if (!printer.canWrite(arguments)) return kUsage;
  switch (arguments.command) {
  case Command::Post:
    return printer.result(
        shown(
            arguments,
            [&](Progress&) {
              return driver::post({arguments.inputs, arguments.common, arguments.source, arguments.sequence});
            }),
        arguments);
  case Command::RunPost:
    arguments.runPost.common = arguments.common;
    return printer.posted(shown(arguments, [&](Progress&) { return driver::runPost(arguments.runPost); }),
                          arguments);
  case Command::NewJob:
    arguments.runPost.common = arguments.common;
    return printer.result(driver::newJob(arguments.runPost), arguments);
  case Command::NewPost:
    return printer.result(driver::newPost(arguments.inputs.back(), arguments.common), arguments);
  case Command::Convert: {
    driver::ConvertOptions& options = arguments.convert;
    options.inputs = arguments.inputs;
    options.common = arguments.common;
    options.source = arguments.source;
    options.oneFile = !arguments.output.empty();
    return printer.programs(shown(arguments, options, driver::convert), arguments);
  }
  case Command::Lint: {
    driver::LintOptions& options = arguments.lint;
    options.paths = arguments.inputs;
    options.common = arguments.common;
    options.source = arguments.source;
    const auto lint = [&](const driver::LintOptions& of) {
      return arguments.cache.folder.empty() ? driver::lint(of) : driver::lint(of, arguments.cache);
    };
    if (arguments.diff) return printer.proposals(shown(arguments, options, driver::proposeFixes), arguments);
    if (arguments.watch)
      return watch(
          options.paths,
          [&](int& status) {
            const driver::Outcome outcome = shown(arguments, options, lint);
            status = printer.findings(outcome, arguments);
            std::set<std::string> read;
            for (FileId file = 0; file < outcome.sources.size(); ++file)
              read.insert(outcome.sources.file(file).name());
            return read;
          },
          out, err);
    return printer.findings(shown(arguments, options, lint), arguments);
  }
  case Command::Dump:
    return printer.result(shown(arguments,
                                [&](Progress&) {
                                  return driver::dump({arguments.inputs, arguments.stage, arguments.common,
                                                       arguments.source, arguments.convert.control});
                                }),
                          arguments);
  case Command::Sim:
    arguments.sim.program = arguments.inputs.empty() ? "" : arguments.inputs.front();
    arguments.sim.common = arguments.common;
    return printer.simulation(arguments.sim, arguments);
  case Command::Verify:
    arguments.verify.inputs = arguments.inputs;
    arguments.verify.common = arguments.common;
    arguments.verify.source = arguments.source;
    return printer.verification(shown(arguments, arguments.verify, driver::verify), arguments);
  case Command::Explain: return printer.result(driver::explain(arguments.inputs.front()), arguments);
  case Command::New:
    if (!arguments.convert.fromControl.empty())
      return printer.result(
          driver::newControl({arguments.inputs.back(), arguments.convert.fromControl, arguments.common}),
          arguments);
    return printer.result(driver::newForm({arguments.inputs.back(), arguments.source.prog, arguments.common}),
                          arguments);
  case Command::Init:
    return printer.begun(driver::init({arguments.inputs.empty() ? "." : arguments.inputs.front(),
                                       arguments.convert.control, arguments.force, arguments.common}),
                         arguments);
  case Command::NewCycle:
    return printer.result(driver::newCycle(arguments.inputs.back(), arguments.common), arguments);
  case Command::NewMacros:
    return printer.result(driver::newMacros(arguments.inputs.back(), arguments.common), arguments);
  case Command::Check:
    return printer.findings(shown(arguments,
                                  [&](Progress&) {
                                    return driver::check({arguments.inputs, arguments.common});
                                  }),
                            arguments);
  case Command::Fmt:
    return printer.layout(shown(arguments,
                                [&](Progress&) {
                                  return driver::layOut({arguments.inputs, arguments.common});
                                }),
                          arguments);
  case Command::Doc:
    return printer.catalogue(shown(arguments,
                                   [&](Progress&) {
                                     return driver::catalogue({arguments.inputs, arguments.common});
                                   }),
                             arguments);
  case Command::Preview:
    return printer.result(shown(arguments,
                                [&](Progress&) {
                                  return driver::preview({arguments.inputs, arguments.common});
                                }),
                          arguments);
  case Command::Lsp: return lsp::serve(STDIN_FILENO, STDOUT_FILENO, runningProgram(), err);
  case Command::List:
    if (arguments.inputs.size() > 1)
      return printer.result(driver::listFacts(arguments.inputs[0], arguments.inputs[1], arguments.common),
                            arguments);
    return printer.result(driver::list(arguments.inputs.front(), arguments.common), arguments);
  case Command::Outline:
    return printer.result(
        shown(arguments,
              [&](Progress&) {
                return driver::outline({arguments.inputs, arguments.common, arguments.json});
              }),
        arguments);
  case Command::Renumber:
    arguments.renumber.inputs = arguments.inputs;
    arguments.renumber.common = arguments.common;
    arguments.write = arguments.output.empty();
    return printer.layout(shown(arguments, [&](Progress&) { return driver::renumber(arguments.renumber); }),
                          arguments);
  case Command::Flatten:
    arguments.sim.program = arguments.inputs.empty() ? "" : arguments.inputs.front();
    arguments.sim.common = arguments.common;
    return printer.result(shown(arguments, [&](Progress&) { return driver::flatten(arguments.sim); }),
                          arguments);
  }
  return kDefect;
}

int runGuarded(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  try {
    Arguments parsed;
    if (const std::optional<int> status = parseArguments(arguments, parsed, out, err)) return *status;
    return runCommand(parsed, out, err);
  } catch (const std::bad_alloc&) {
    err << "dotek: error: there is no memory left\n";
    return kUsage;
  } catch (const std::exception& error) {
    err << "dotek: error: " << printable(error.what()) << "; this is a defect of Dotek\n";
  } catch (...) {
    err << "dotek: error: something unknown was thrown; this is a defect of Dotek\n";
  }
  return kDefect;
}

} // namespace

int run(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  int status = runGuarded(arguments, out, err);
  const int lost = finishStream(out);
  if (lost != 0 && lost != EPIPE) { // a reader that has enough needs no message
    Diagnostics writing;
    writing.report<diag::StandardOutputFailed>({}, lost == EBADF ? "it is closed" : std::strerror(lost));
    err << renderText(writing, SourceMap(), 0);
  }
  const bool silent = finishStream(err) != 0;
  if ((lost != 0 || silent) && status != kDefect) status = kUsage;
  return status;
}

} // namespace dotek::cli
