#include "driver/ConvertPrograms.h"

#include "backends/fanuc/Program.h"
#include "backends/fanuc/ProgramCalls.h"
#include "project/Lowering.h"
#include "project/Programs.h"
#include "support/messages/Commands.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace dotek::driver {

namespace fanuc = backends::fanuc;

namespace {

// Names of the given options that speak of cycles.
std::vector<std::string> cycleOptions(const ConvertOptions& options) {
  const CommonOptions& common = options.common;
  std::vector<std::string> out;
  const auto add = [&](bool given, const char* name) {
    if (given) out.emplace_back(name);
  };
  add(common.job.has_value(), "--job");
  add(!common.set.empty(), "--set");
  add(!common.field.empty(), "--field");
  add(!common.host.empty(), "--host");
  add(common.recover, "--recover");
  add(options.source.prog.has_value(), "--prog");
  add(options.source.form != SourceOptions().form, "--form");
  add(options.source.routine.has_value(), "--routine");
  add(options.source.cycle.has_value(), "--cycle");
  add(!options.letters.empty(), "--arg");
  add(!options.defaults.empty(), "--default");
  add(options.useDefaults, "--defaults");
  add(options.switchProbe, "--probe-power");
  for (const std::string& name : common.assume)
    if (name != "plain-messages") out.push_back("--assume " + name);
  return out;
}

} // namespace

void refuseOptions(const ConvertOptions& options, bool programs, bool cycles, Session& session) {
  if (programs && !cycles)
    for (const std::string& name : cycleOptions(options))
      session.diagnostics().report<diag::OptionOfCycles>({}, name);
  if (cycles && !programs) {
    if (!options.fromControl.empty())
      session.diagnostics().report<diag::OptionOfPrograms>({}, "--from-control");
    if (options.renumber) session.diagnostics().report<diag::OptionOfPrograms>({}, "--renumber");
  }
}

bool ProgramConversion::load() {
  const std::string target = options_.control.empty() ? std::string(kDefaultControl) : options_.control;
  control_ = loadControl(target, session_);
  source_ = options_.fromControl.empty() ? control_ : loadControl(options_.fromControl, session_);
  if (!control_ || !source_) return false;
  if (!options_.probeMacros) return true;
  std::string known;
  for (const stdlib::DataFile* file : session_.data().list("macros")) {
    known += (known.empty() ? "" : ", ") + file->name;
    if (auto set = stdlib::MacroSet::load(session_.data(), file->name)) sets_.push_back(std::move(*set));
  }
  for (const stdlib::MacroSet& set : sets_)
    if (set.name == *options_.probeMacros) wanted_ = &set;
  if (wanted_ == nullptr)
    session_.diagnostics().report<diag::UnknownMacroSet>({}, *options_.probeMacros, known);
  return wanted_ != nullptr;
}

bool ProgramConversion::translateCalls(ir::ProgramFile& file) {
  if (wanted_ == nullptr) return true;
  return fanuc::translateCalls(file, {*wanted_, sets_, *source_, options_.programNumber},
                               session_.diagnostics());
}

std::optional<ConvertedFile> ProgramConversion::convert(const std::string& path) {
  const std::optional<FileId> id = session_.read(path, Encoding::Cp1250);
  if (!id) return std::nullopt;
  SourceRange leader;
  std::optional<ir::ProgramFile> programs = loadPrograms(*id, *source_, session_, &leader);
  if (!programs) return std::nullopt;
  if (programs->programs.empty()) {
    session_.diagnostics().report<diag::NoProgram>({*id, 0, 0}, path);
    return std::nullopt;
  }
  if (leader.begin < leader.end) session_.diagnostics().report<diag::LeaderLeftOut>(leader);
  if (!translateCalls(*programs)) return std::nullopt;
  fanuc::ProgramOptions emit{*control_, *source_, options_.programNumber, options_.renumber, false};
  emit.plainMessages = options_.common.assume.contains("plain-messages");
  const auto lines = fanuc::emitPrograms(*programs, emit, session_.sources(), session_.diagnostics());
  if (!lines) return std::nullopt;
  ConvertedFile out;
  out.file.name = options_.programNumber ? fmt::format("O{:04}.nc", *options_.programNumber)
                                         : std::filesystem::path(path).stem().generic_string() + ".nc";
  out.map.name = out.file.name;
  for (const fanuc::EmittedLine& line : *lines) {
    out.file.text += line.text + "\n";
    out.map.lines.push_back({static_cast<std::uint32_t>(out.map.lines.size() + 1), line.ranges, line.reason});
  }
  for (const ir::Program& program : programs->programs)
    if (program.number != 0) out.numbers.push_back(program.number);
  if (options_.programNumber) out.numbers = {*options_.programNumber};
  return out;
}

} // namespace dotek::driver
