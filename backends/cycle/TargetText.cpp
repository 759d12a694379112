#include "backends/cycle/TargetText.h"

#include "frontend/cycle/Check.h"
#include "frontend/cycle/Link.h"
#include "frontend/cycle/Parse.h"
#include "frontend/cycle/Words.h"
#include "ir/Fold.h"
#include "ir/Verify.h"
#include "targets/DialogChoices.h"

namespace dotek::targets {

namespace cycle = frontend::cycle;

std::optional<backends::cycle::Emitted> writtenCycle(const project::CycleFolder& folder,
                                                     project::LoweredCycle& lowered,
                                                     const stdlib::Control* control,
                                                     project::Session& session) {
  ir::fold(lowered.cycle, lowered.fixed);
  backends::cycle::EmitOptions options;
  options.isReserved = cycle::isReserved;
  options.proposeName = cycle::proposeName;
  options.control = control;
  for (auto& [id, choices] : dialogChoices(folder, lowered.cycle, session.sources()))
    for (DialogChoice& choice : choices)
      options.choices[id].push_back({choice.value, std::move(choice.title)});
  for (const auto& [id, value] : lowered.fixed)
    options.fixed.insert(id);
  return backends::cycle::emit(lowered.cycle, options, session.diagnostics());
}

bool ReadCycle::read(const std::string& name, const std::string& text, Diagnostics& found) {
  const FileId id = session_.sources().add(SourceFile(name, text, Encoding::Utf8));
  file_ = cycle::parse(id, session_.sources(), session_.limits(), found);
  return !file_.hasErrorNodes && !found.hasErrors();
}

std::string ReadCycle::laidOut() const {
  return cycle::layOut(file_);
}

std::optional<cycle::Lowered> ReadCycle::lowered(Diagnostics& found) {
  cycle::link(file_, [&](const std::string& name) { return files_.library(name); });
  cycle::check(file_, session_.sources(), found);
  if (found.hasErrors()) return std::nullopt;
  std::optional<cycle::Lowered> out = cycle::lower(file_, session_.sources(), found);
  if (!out || found.hasErrors()) return std::nullopt;
  return out;
}

} // namespace dotek::targets
