#include "backends/fanuc/TargetPrograms.h"

#include "backends/common/MovedMacros.h"
#include "backends/fanuc/Program.h"
#include "backends/fanuc/ProgramCalls.h"
#include "backends/fanuc/TargetEarly.h"
#include "backends/fanuc/TranslateCall.h"
#include "project/Lowering.h"
#include "project/MillControl.h"
#include "project/Programs.h"
#include "support/messages/Commands.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace dotek::targets {

namespace fanuc = backends::fanuc;

namespace {

bool holds(const ir::ProgramFile& file, const stdlib::CodeInfo& code) {
  const auto is = [&](const ir::Word& word) {
    const double* value = word.value == nullptr ? nullptr : ir::constantValue(word.value);
    return word.address == code.letter && (value == nullptr || *value * 10 == code.tenths);
  };
  for (const ir::Program& program : file.programs)
    for (const ir::ProgramStatement& statement : program.body)
      if (const auto* block = std::get_if<ir::NcBlock>(&statement.node);
          block && std::any_of(block->words.begin(), block->words.end(), is))
        return true;
  return false;
}

} // namespace

bool ProgramConversion::load() {
  const std::string target = options_.control.empty() ? std::string(kDefaultControl) : options_.control;
  control_ = loadControl(target, session_);
  if (control_) checkProbeCodes(*control_, session_);
  source_ = options_.fromControl.empty() ? control_ : loadControl(options_.fromControl, session_);
  if (!control_ || !source_) return false;
  if (project::refuseLathe(*control_, session_) || project::refuseLathe(*source_, session_)) return false;
  if (!options_.probeMacros) return true;
  wanted_ = session_.macroSet(*options_.probeMacros, &*control_);
  if (wanted_ == nullptr) reportUnknownMacroSet(*options_.probeMacros, session_);
  return wanted_ != nullptr && backends::holdsKept(*wanted_, *control_, session_.diagnostics());
}

stdlib::Control ProgramConversion::sourceOf(const ir::ProgramFile& file) const {
  stdlib::Control out = *source_;
  if (wanted_ == nullptr) return out;
  stdlib::ProbeCodes codes;
  for (const bool on : {true, false}) {
    const stdlib::Function function = on ? stdlib::Function::ProbeOn : stdlib::Function::ProbeOff;
    const stdlib::CodeInfo* code = control_->find(function);
    // What it means in a block of the source is not known.
    if (out.find(function) == nullptr && code != nullptr && code->tenths % 10 == 0 && !holds(file, *code))
      (on ? codes.on : codes.off) = code->letter + std::to_string(code->tenths / 10);
  }
  stdlib::addProbeCodes(out, codes);
  return out;
}

bool ProgramConversion::translateCalls(ir::ProgramFile& file, const stdlib::Control& source) {
  if (wanted_ == nullptr) return true;
  return fanuc::translateCalls(
      file, {*wanted_, session_.macroSets(&source), source, options_.programNumber, control_->name},
      session_.diagnostics());
}

void ProgramConversion::convert(const std::string& path, ConversionResult& result) {
  const std::optional<FileId> id = session_.read(path, Encoding::Cp1250);
  if (!id) return;
  SourceRange leader;
  std::optional<ir::ProgramFile> programs = loadForTranslation(*id, *source_, session_, leader);
  if (!programs) return;
  if (programs->programs.empty()) {
    session_.diagnostics().report<diag::NoProgram>({*id, 0, 0}, path, "written");
    return;
  }
  if (leader.begin < leader.end) session_.diagnostics().report<diag::LeaderLeftOut>(leader);
  // The maker of the target may deliver the set of the source with other variables.
  if (!options_.probeMacros) {
    wanted_ = nullptr; // of the file before
    if (const stdlib::MacroSet* called = fanuc::calledSet(*programs, session_.macroSets(&*source_)))
      if (const stdlib::MacroSet* there = session_.macroSet(called->name, &*control_);
          there != nullptr && !backends::fanuc::isSame(*called, *there))
        wanted_ = there;
  }
  const stdlib::Control source = sourceOf(*programs);
  if (!translateCalls(*programs, source)) return;
  fanuc::ProgramOptions emit{*control_, source, options_.programNumber, options_.renumber, false};
  emit.plainMessages = options_.common.assume.contains("plain-messages");
  for (const stdlib::MacroSet& set : session_.macroSets(wanted_ != nullptr ? &*control_ : &source)) {
    const bool own = std::any_of(programs->programs.begin(), programs->programs.end(), [&](const auto& one) {
      return one.number <= UINT32_MAX && set.calls(static_cast<std::uint32_t>(one.number));
    });
    if (!own) emit.macros.push_back(&set);
  }
  const auto lines = fanuc::emitPrograms(*programs, emit, session_.sources(), session_.diagnostics());
  if (!lines) return;
  warnOfEarlyReads(*lines, *control_, session_);
  result.add(options_.programNumber ? fmt::format("O{:04}.nc", *options_.programNumber)
                                    : std::filesystem::path(path).stem().generic_string() + ".nc",
             *lines);
  if (options_.programNumber) {
    result.numbers.emplace_back(*options_.programNumber, path);
    return;
  }
  for (const ir::Program& program : programs->programs)
    if (program.number != 0) result.numbers.emplace_back(program.number, path);
}

} // namespace dotek::targets
