#include "driver/ConvertVerify.h"

#include "driver/Command.h"
#include "project/CycleLowering.h"
#include "project/FormChoice.h"
#include "project/Programs.h"
#include "support/messages/Verify.h"
#include "targets/Target.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <set>

namespace dotek::driver {

namespace {

constexpr std::uint64_t kCases = 200; // of each input

// What comes of it that one input is not verified.
std::string notWritten(const ConvertOptions& options, std::size_t inputs) {
  if (options.keepGoing) return "it is not written";
  return inputs > 1 ? "nothing is written, and `--keep-going` writes the others" : "nothing is written";
}

// The sources of `from` become sources of `into`; the diagnostics follow.
void take(Outcome& into, Outcome from) {
  const FileId first = into.sources.size();
  for (FileId id = 0; id < from.sources.size(); ++id)
    into.sources.add(from.sources.file(id));
  const auto move = [&](SourceRange& range) {
    if (range.hasPlace()) range.file += first;
  };
  for (Diagnostic& one : from.diagnostics.all()) {
    if (isAboutForm(one.code)) continue; // convert has said it
    move(one.range);
    for (DiagnosticNote& note : one.notes)
      move(note.range);
    if (one.fix)
      for (Edit& edit : one.fix->edits)
        move(edit.range);
    into.diagnostics.add(std::move(one));
  }
}

std::string lastLine(std::string text) {
  while (!text.empty() && text.back() == '\n')
    text.pop_back();
  const std::size_t at = text.rfind('\n');
  return at == std::string::npos ? text : text.substr(at + 1);
}

// The result of one input by itself; `cycle`: its place among the cycles.
std::string keyOf(const Diagnostic& one) {
  return fmt::format("{} {} {} {} {}", one.code, one.range.file, one.range.begin, one.range.end, one.message);
}

std::shared_ptr<const ConvertedInput> resultOf(const Outcome& all, std::size_t file, std::size_t cycle,
                                               const Diagnostics& said) {
  auto out = std::make_shared<ConvertedInput>();
  std::set<std::string> own, ofOthers;
  for (std::size_t i = 0; i < all.foundIn.size(); ++i)
    for (const Diagnostic& one : all.foundIn[i])
      (i == file ? own : ofOthers).insert(keyOf(one));
  for (const Diagnostic& one : said.all())
    if (const std::string key = keyOf(one); own.contains(key) || !ofOthers.contains(key)) out->said.add(one);
  out->file = all.files[file];
  out->map = all.maps[file];
  if (cycle < all.arguments.size()) {
    out->arguments = all.arguments[cycle];
    out->macros = all.macrosByCycle[cycle];
  }
  if (cycle < all.handedBack.size()) out->handedBack = all.handedBack[cycle];
  out->sources = all.sources;
  return out;
}

// What `convert` of several inputs takes for the others among them.
void dropOthers(VerifyOptions& options, bool program) {
  if (!program) {
    options.fromControl.clear();
    return;
  }
  options.source = {};
  CommonOptions& common = options.common;
  common.job.reset();
  common.set.clear();
  common.field.clear();
  common.host.clear();
  common.recover = false;
  std::erase_if(common.assume,
                [](const std::string& name) { return name != "plain-messages" && name != "probe-on"; });
}

VerifyOptions optionsOf(const ConvertOptions& options, const std::string& input) {
  VerifyOptions out;
  static_cast<TranslationOptions&>(out) = options;
  out.inputs = {input};
  out.defaults = options.defaults;
  out.useDefaults = options.useDefaults;
  out.letters = options.letters;
  // The program switches the probe by itself, so the source is where it is on.
  if (options.switchProbe) out.common.assume.insert("probe-on");
  out.switchProbe = options.switchProbe;
  out.byConvert = true;
  out.oneOfSeveral = options.inputs.size() > 1;
  out.cases = kCases;
  out.format = options.report.value_or(ReportFormat::Text);
  out.date = options.date;
  out.remark = options.remark;
  out.programNumber = options.programNumber;
  return out;
}

// The number of a program among several, which the command for one input has to name. nullopt: it is that of
// one by itself, or no number.
std::optional<std::uint32_t> numberAmong(const Target* target, const OutputFile& file, std::size_t cycle) {
  const bool numbered = target != nullptr && std::find(target->flags.begin(), target->flags.end(),
                                                       TargetFlag::ProgramNumber) != target->flags.end();
  if (!numbered || cycle == 0 || !file.name.starts_with('O')) return std::nullopt;
  const char* const end = file.name.data() + file.name.size();
  std::uint32_t number = 0;
  const auto [rest, error] = std::from_chars(file.name.data() + 1, end, number);
  if (error != std::errc() || std::string_view(rest, end) != ".nc") return std::nullopt;
  return number;
}

// What does not agree is not given.
void leaveOut(const std::vector<std::size_t>& inputs, Outcome& outcome) {
  if (inputs.empty()) return;
  for (auto at = inputs.rbegin(); at != inputs.rend(); ++at) {
    const auto place = static_cast<std::ptrdiff_t>(*at);
    outcome.files.erase(outcome.files.begin() + place);
    outcome.maps.erase(outcome.maps.begin() + place);
    outcome.inputs.erase(outcome.inputs.begin() + place);
  }
  outcome.output.clear();
  for (const OutputFile& file : outcome.files)
    outcome.output += file.text;
}

} // namespace

Outcome verified(const ConvertOptions& options, Outcome outcome) {
  Session session(options.common);
  const std::vector<std::string> inputs = outcome.inputs;
  const auto isProgram = [&](const std::string& input) {
    return !isCycleFile(input, session) && isProgramFile(input, session);
  };
  const auto programs = std::count_if(inputs.begin(), inputs.end(), isProgram);
  // Each cycle has its own result; else verify converts it by itself. A target whose programs hold values is
  // run for each case, and the result is what the report is about.
  const Target* const target = findTarget(options.to);
  const bool eachCase = target != nullptr && target->fixesValues && outcome.files.size() == inputs.size();
  const bool own =
      eachCase || outcome.macrosByCycle.size() + static_cast<std::size_t>(programs) == inputs.size();
  const Diagnostics said = outcome.diagnostics; // by convert alone
  std::size_t cycles = 0;
  int status = outcome.status;
  std::vector<std::size_t> differing;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const std::string& input = inputs[i];
    VerifyOptions one = optionsOf(options, input);
    if (options.progress && inputs.size() > 1)
      one.progress = [&, i](const std::string& text) {
        options.progress(fmt::format("input {} of {}, {}", i + 1, inputs.size(), text));
      };
    const bool program = isProgram(input);
    dropOthers(one, program);
    if (own) one.converted = resultOf(outcome, i, program ? outcome.arguments.size() : cycles, said);
    if (!program && outcome.files.size() == inputs.size())
      if (const auto number = numberAmong(target, outcome.files[i], cycles)) one.programNumber = number;
    if (!program) ++cycles;
    Outcome found = driver::verify(one);
    status = std::max(status, found.status);
    const std::string counts = lastLine(found.output);
    const bool good = found.status == 0;
    if (!good) differing.push_back(i);
    if (options.report && !found.files.empty())
      outcome.reports.push_back({input, std::move(found.files.front().text)});
    else if (options.report == ReportFormat::Text && !found.output.empty())
      outcome.reports.push_back({input, found.output});
    take(outcome, std::move(found));
    if (good)
      outcome.diagnostics.report<diag::Verified>({}, input, counts);
    else
      outcome.diagnostics.report<diag::NotVerified>({}, notWritten(options, inputs.size()), input,
                                                    counts.empty() ? "it cannot be looked at" : counts);
  }
  outcome.diagnostics.sort();
  const bool each = options.keepGoing && outcome.files.size() == inputs.size();
  if (differing.empty() || each) {
    leaveOut(differing, outcome);
    outcome.status = each ? std::min(status, 1) : status;
    return outcome;
  }
  Outcome out;
  out.status = status;
  out.reports = std::move(outcome.reports);
  out.sources = std::move(outcome.sources);
  out.diagnostics = std::move(outcome.diagnostics);
  return out;
}

} // namespace dotek::driver
