#include "backends/fanuc/TargetPrograms.h"

#include "backends/fanuc/Program.h"
#include "backends/fanuc/ProgramCalls.h"
#include "project/Lowering.h"
#include "project/Programs.h"
#include "support/messages/Commands.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace dotek::targets {

namespace fanuc = backends::fanuc;

bool ProgramConversion::load() {
  const std::string target = options_.control.empty() ? std::string(kDefaultControl) : options_.control;
  control_ = loadControl(target, session_);
  if (control_) checkProbeCodes(*control_, session_);
  source_ = options_.fromControl.empty() ? control_ : loadControl(options_.fromControl, session_);
  if (!control_ || !source_) return false;
  if (!options_.probeMacros) return true;
  wanted_ = session_.macroSet(*options_.probeMacros);
  if (wanted_ == nullptr) reportUnknownMacroSet(*options_.probeMacros, session_);
  return wanted_ != nullptr;
}

bool ProgramConversion::translateCalls(ir::ProgramFile& file) {
  if (wanted_ == nullptr) return true;
  return fanuc::translateCalls(file, {*wanted_, session_.macroSets(), *source_, options_.programNumber},
                               session_.diagnostics());
}

void ProgramConversion::convert(const std::string& path, ConversionResult& result) {
  const std::optional<FileId> id = session_.read(path, Encoding::Cp1250);
  if (!id) return;
  SourceRange leader;
  std::optional<ir::ProgramFile> programs = loadForTranslation(*id, *source_, session_, leader);
  if (!programs) return;
  if (programs->programs.empty()) {
    session_.diagnostics().report<diag::NoProgram>({*id, 0, 0}, path);
    return;
  }
  if (leader.begin < leader.end) session_.diagnostics().report<diag::LeaderLeftOut>(leader);
  if (!translateCalls(*programs)) return;
  fanuc::ProgramOptions emit{*control_, *source_, options_.programNumber, options_.renumber, false};
  emit.plainMessages = options_.common.assume.contains("plain-messages");
  const auto lines = fanuc::emitPrograms(*programs, emit, session_.sources(), session_.diagnostics());
  if (!lines) return;
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
