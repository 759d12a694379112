#include "cli/Options.h"
#include "project/Assumptions.h"
#include "project/InputKind.h"
#include "stdlib/CodeSpan.h"
#include "stdlib/ControlFiles.h"
#include "support/Decimal.h"
#include "support/Worker.h"
#include "targets/Target.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fmt/format.h>
#include <sstream>

namespace dotek::cli {

std::pair<std::string, std::string> splitPair(const std::string& flag, const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0) throw UsageError(flag + " takes NAME=VALUE, not `" + text + "`");
  return {text.substr(0, at), text.substr(at + 1)};
}

std::optional<std::uint64_t> wholeNumber(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::pair<std::uint64_t, std::uint64_t> startAndStep(const std::string& flag, const std::string& text) {
  const std::size_t colon = text.find(':');
  const auto start = wholeNumber(std::string_view(text).substr(0, colon));
  const auto step =
      colon == std::string::npos ? std::nullopt : wholeNumber(std::string_view(text).substr(colon + 1));
  if (!start || !step || *step == 0 || *start > 99999999 || *step > 99999)
    throw UsageError(flag + " takes START:STEP, two whole numbers such as 90:10, not `" + text + "`");
  return {*start, *step};
}

std::uint64_t countOf(const std::string& flag, const std::string& text, std::uint64_t otherwise,
                      std::uint64_t least, std::uint64_t most) {
  if (text.empty()) return otherwise;
  const auto number = wholeNumber(text);
  if (!number || *number < least || *number > most)
    throw UsageError(fmt::format("{} takes a whole number from {} to {}, not `{}`", flag, least, most, text));
  return *number;
}

double numberOf(const std::string& flag, const std::string& text, double otherwise, double least,
                double most) {
  if (text.empty()) return otherwise;
  const auto number = parseNumber(text);
  if (!number || !(*number >= least && *number <= most))
    throw UsageError(fmt::format("{} takes a number from {} to {}, not `{}`", flag, numberText(least),
                                 numberText(most), text));
  return *number;
}

void addSeveral(CLI::App& app, const char* flag, std::vector<std::string>& into, const std::string& what,
                const std::string& type) {
  app.add_option(flag, into, what + "; several: repeat it, or A,B")
      ->option_text(type)
      ->allow_extra_args(false);
}

void addFolders(CLI::App& app, const char* flag, std::vector<std::string>& into, const std::string& what) {
  app.add_option(flag, into, what + "; repeat it for several")->option_text("DIR")->allow_extra_args(false);
}

std::vector<std::string> listOf(const std::vector<std::string>& given) {
  std::vector<std::string> out;
  for (const std::string& text : given) {
    std::istringstream in(text);
    for (std::string one; std::getline(in, one, ',');)
      if (!one.empty()) out.push_back(one);
  }
  return out;
}

driver::NamedTexts pairsOf(const std::string& flag, const std::vector<std::string>& given) {
  driver::NamedTexts out;
  for (const std::string& text : given) {
    // A comma divides pairs only where each part is one: in `A=1,5` it is a misprint of the point.
    const std::vector<std::string> parts = listOf({text});
    const bool pairs = !parts.empty() && std::all_of(parts.begin(), parts.end(), [](const std::string& part) {
      return part.find('=') != std::string::npos;
    });
    for (const std::string& one : pairs ? parts : std::vector{text})
      out.push_back(splitPair(flag, one));
  }
  return out;
}

namespace {

void applyLimit(const std::string& name, const std::string& value, Limits& limits) {
  const std::optional<std::uint64_t> number = wholeNumber(value);
  const auto table = limitTable();
  const auto found = std::find_if(table.begin(), table.end(),
                                  [&, &key = name](const LimitInfo& l) { return l.name == key; });
  if (found == table.end()) throw UsageError("no limit `" + name + "`; `dotek list limits` prints them");
  if (!number || *number == 0 || *number > 1u << 30)
    throw UsageError("--limit " + name + " takes a whole number from 1 to 1073741824, not `" + value + "`");
  limits.*found->member = static_cast<std::uint32_t>(*number);
}

} // namespace

namespace {

// A misspelt folder would only show as files that are not there.
std::string folderOf(const std::string& flag, const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_directory(path, error)) throw UsageError(flag + ": no folder `" + path + "`");
  return path;
}

} // namespace

namespace {

std::string probeCode(const std::string& flag, const std::string& text) {
  if (!text.empty() && !stdlib::codeOf(text))
    throw UsageError(
        flag + " takes one M or G code without further words, such as M31, not `" + text +
        "`; where the machine needs a word beside it (P2), name the code that calls a program with "
        "that block, or take macros that switch the probe by a call (`--probe-macros "
        "inspection-plus`)");
  return text;
}

} // namespace

driver::CommonOptions commonOf(const Raw& raw) {
  driver::CommonOptions out;
  if (!raw.job.empty()) out.job = raw.job;
  out.set = pairsOf("--set", raw.set);
  out.field = pairsOf("--field", raw.field);
  out.host = pairsOf("--host", raw.host);
  if (!raw.clearance.empty()) out.host.emplace_back("clearance", raw.clearance);
  for (const std::string& text : raw.assume) {
    // `touch=FILE:LINE` may hold a comma.
    const std::vector<std::string> names = project::isAssumption(text) ? std::vector{text} : listOf({text});
    out.assume.insert(names.begin(), names.end());
  }
  out.recover = raw.recover;
  if (!raw.encoding.empty()) {
    out.encoding = encodingByName(raw.encoding);
    if (!out.encoding)
      throw UsageError("--encoding takes utf-8, cp1250 or cp852, not `" + raw.encoding + "`");
  }
  for (const auto& [name, value] : pairsOf("--limit", raw.limit))
    applyLimit(name, value, out.limits);
  out.probeCodes = {probeCode("--probe-on", raw.probeOn), probeCode("--probe-off", raw.probeOff)};
  for (const std::string& code : listOf(raw.auxiliary))
    if (!stdlib::codeSpan(code))
      throw UsageError("--auxiliary takes codes such as M41, G103 or M100-M199, not `" + code + "`");
    else
      out.assume.insert("auxiliary=" + code);
  out.data = raw.data;
  for (const std::string& control : {raw.control, raw.fromControl})
    if (stdlib::isDataPath(control) && std::find(out.data.begin(), out.data.end(), control) == out.data.end())
      out.data.push_back(control);
  for (const std::string& folder : raw.include)
    out.include.push_back(folderOf("--include", folder));
  if (!raw.includeRoot.empty()) out.includeRoot = folderOf("--include-root", raw.includeRoot);
  out.scriptProgram = runningProgram();
  if (!raw.from.empty()) {
    if (!project::kindByName(raw.from))
      throw UsageError("--from takes prog, mac, dlg, define, nc, listing, suf or cycle, not `" + raw.from +
                       "`");
    out.from = raw.from;
  }
  return out;
}

void addProbeCodes(CLI::App& app, Raw& raw) {
  app.add_option("--probe-on", raw.probeOn, "code that switches the probe on, where the profile has none")
      ->type_name("CODE");
  app.add_option("--probe-off", raw.probeOff, "code that switches it off")->type_name("CODE");
  addSeveral(app, "--auxiliary", raw.auxiliary,
             "code that runs, changes nothing and is printed: M41, G103, M100-M199", "CODE");
}

void addCommon(CLI::App& app, Raw& raw) {
  app.add_option("--encoding", raw.encoding, "utf-8, cp1250 or cp852 instead of the recognised encoding");
  app.add_option("--from", raw.from, "kind of the inputs: prog, mac, dlg, define, nc, listing, suf or cycle");
  app.add_option("--max-errors", raw.maxErrors, "print at most N errors; 0 prints all")->type_name("N");
  app.add_option("--color", raw.color, "auto (on a terminal, unless NO_COLOR is set), always or never")
      ->type_name("WHEN")
      ->check(CLI::IsMember({"auto", "always", "never"}));
  addSeveral(app, "--limit", raw.limit, "set a limit (see `dotek list limits`)", "NAME=N");
  addProbeCodes(app, raw);
  addFolders(app, "--data", raw.data, "folder whose data files are added or replace built-in ones");
}

void addStandardInput(CLI::App& app, Raw& raw) {
  app.add_option(
         "--stdin-filename", raw.standardInputName,
         "what comes by `-` is the text of FILE, as an editor has it: its kind and its settings are used")
      ->type_name("FILE");
}

void addIncludes(CLI::App& app, Raw& raw) {
  addFolders(app, "--include", raw.include, "folder of macros and meshes that inputs name, beside their own");
  app.add_option("--include-root", raw.includeRoot,
                 "inputs may name files below DIR, not only those of their own folder")
      ->type_name("DIR");
}

void addValues(CLI::App& app, Raw& raw) {
  addSeveral(app, "--set", raw.set, "value of a field", "NAME=VALUE");
  addSeveral(app, "--host", raw.host, "value that the CAM knows of the operation (see `dotek list hosts`)",
             "NAME=VALUE");
  app.add_option("--clearance", raw.clearance, "short for --host clearance=Z")->type_name("Z");
  addSeveral(app, "--assume", raw.assume, "name the reading of a construct that is not documented", "NAME");
}

void addTranslation(CLI::App& app, Raw& raw, const std::string& to) {
  app.add_option("--to", raw.to, to)->type_name("TARGET");
  addTarget(app, raw);
  app.add_option(
         "--from-control", raw.fromControl,
         "profile of the control that programs are written for (that of dotek.toml, else of --control)")
      ->type_name("NAME");
  app.add_option("--probe-macros", raw.probeMacros,
                 "probing macros that the translation calls (see `dotek list macros`)")
      ->type_name("SET");
  addSource(app, raw);
  addValues(app, raw);
  app.add_option("--datum", raw.datum,
                 "of mikroprog: g92 sets the active system, operator stops for an entry by hand")
      ->type_name("g92|operator");
  addSeveral(app, "--result", raw.results,
             "of a file of the cycle language: common variable that gets a result of the cycle",
             "NAME=#NUMBER");
  app.add_option(
         "--calls", raw.calls,
         "of a file of the cycle language: a cycle that it calls is in the place of the call, a program "
         "of the same file, or a call of the macro set where that has it")
      ->check(CLI::IsMember({"inline", "subprogram", "vendor"}));
}

void fillTranslation(const Raw& raw, targets::TranslationOptions& options) {
  options.to = raw.to;
  options.control = raw.control;
  options.fromControl = raw.fromControl;
  if (!raw.probeMacros.empty()) options.probeMacros = raw.probeMacros;
  options.datum = raw.datum;
  options.results = pairsOf("--result", raw.results);
  for (const targets::Calls calls : {targets::Calls::Subprogram, targets::Calls::Vendor})
    if (raw.calls == targets::callsText(calls)) options.calls = calls;
}

void addSource(CLI::App& app, Raw& raw) {
  app.add_option("--prog", raw.prog, "the Prog (text of the ComPost post)")->type_name("PROG.txt");
  app.add_option("--form", raw.form, "what the post's Form decides, as data")->type_name("NAME");
  app.add_option("--routine", raw.routine, "routine to run for an operation");
  app.add_option("--cycle", raw.cycle, "name of the cycle, if it is not the folder's");
  app.add_option("--job", raw.job, "a whole program as a list of operations")->type_name("JOB.toml");
  addSeveral(app, "--field", raw.field, "the post's field FIELD is the macro's variable VARIABLE",
             "FIELD=VARIABLE");
  app.add_flag("--recover", raw.recover, "accept the repairs that diagnostics offer");
}

void addForce(CLI::App& app, Raw& raw, const char* also) {
  app.add_flag("--force", raw.force, std::string("replace files that are write-protected") + also);
}

void addTarget(CLI::App& app, Raw& raw) {
  app.add_option("--control", raw.control,
                 "profile of the control (see `dotek list controls`; without it that of dotek.toml)")
      ->type_name("NAME");
}

} // namespace dotek::cli
