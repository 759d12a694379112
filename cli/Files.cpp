#include "cli/Files.h"

#include "support/Files.h"
#include "support/messages/Common.h"
#include "support/messages/Output.h"

#include <filesystem>

namespace dotek::cli {

namespace fs = std::filesystem;

std::string orStandardOutput(const std::string& path) {
  return path.empty() ? "-" : path;
}

std::string pictureBeside(const std::string& report) {
  if (report.empty() || report == "-") return "";
  return fs::path(report).replace_extension(".svg").string();
}

std::string reportPath(const Arguments& arguments, const std::string& input) {
  if (arguments.inputs.size() == 1) return arguments.reportFile;
  std::error_code fault;
  fs::path named(input);
  if (!named.has_filename()) named = named.parent_path(); // a folder with a slash at its end
  if (!fs::is_directory(named, fault)) named.replace_extension();
  const fs::path report(arguments.reportFile);
  return (report.parent_path() /
          (report.stem().string() + "-" + named.filename().string() + report.extension().string()))
      .string();
}

std::vector<OutputName> outputsOf(const Arguments& arguments) {
  std::vector<OutputName> out;
  const auto add = [&](const std::string& flag, const std::string& path) {
    if (!path.empty()) out.push_back({"`" + flag + " " + path + "`", path});
  };
  const bool sim = arguments.command == Command::Sim;
  const bool traces = sim && arguments.traceFile.empty() && !arguments.quiet;
  const bool prints =
      sim ? traces || arguments.json : arguments.output.empty() && arguments.outputFolder.empty();
  if (prints) out.push_back({"standard output", "-"});
  add("-o", arguments.output);
  add("--write-baseline", arguments.baselineFile);
  add("--map", arguments.mapFile);
  add("--helpers", arguments.helpersFile);
  if (!arguments.reportFile.empty())
    for (const std::string& input : arguments.inputs)
      add("--report", reportPath(arguments, input));
  if (sim && !arguments.reportFile.empty()) add("--report", pictureBeside(arguments.reportFile));
  add("--trace", arguments.traceFile);
  add("--svg", arguments.svgFile);
  add("--stock-map", arguments.stockMapFile);
  add("--html", arguments.htmlFile);
  return out;
}

bool canChangeInputs(const Arguments& arguments, Diagnostics& diagnostics) {
  const bool renumbers = arguments.command == Command::Renumber && arguments.output.empty();
  if (!renumbers && !(arguments.command == Command::Fmt && arguments.write)) return true;
  bool good = true;
  for (const std::string& input : arguments.inputs) {
    if (input == "-" || !isStream(input)) continue;
    diagnostics.report<diag::FileNotWritable>(
        {}, input, "it is no regular file, whose text could be replaced; `-o OUT` writes to another file");
    good = false;
  }
  return good;
}

std::vector<std::string> inputsOf(const Arguments& arguments) {
  std::vector<std::string> out;
  // The name of a new form and what `explain` and `list` take are no files.
  if (arguments.command != Command::New && arguments.command != Command::NewCycle &&
      arguments.command != Command::NewMacros && arguments.command != Command::Init &&
      arguments.command != Command::Explain && arguments.command != Command::List)
    out = arguments.inputs;
  for (const auto& one :
       {arguments.lint.baseline, arguments.source.prog, arguments.common.job, arguments.sim.part,
        arguments.sim.machine, arguments.sim.stock, arguments.device.device, arguments.verify.part,
        arguments.verify.machine, arguments.verify.translation, arguments.runPost.diff,
        arguments.runPost.expect, arguments.runPost.part, arguments.runPost.machine})
    if (one) out.push_back(*one);
  std::error_code error;
  for (const std::string& data : arguments.common.data)
    for (fs::directory_iterator kind(data, error), end; !error && kind != end; kind.increment(error)) {
      std::error_code noFolder;
      for (fs::directory_iterator file(kind->path(), noFolder); !noFolder && file != end;
           file.increment(noFolder))
        out.push_back(file->path().string());
    }
  return out;
}

} // namespace dotek::cli
