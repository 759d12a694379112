// Private to Target*.cpp: the written text, read back by the front end of the language.
#pragma once

#include "backends/cycle/Emit.h"
#include "frontend/cycle/Lower.h"
#include "project/CycleFiles.h"
#include "project/CycleFolder.h"
#include "project/Lowering.h"
#include "project/Session.h"

#include <optional>
#include <string>

namespace dotek::targets {

// The cycle of a folder, whose post writes for `control` (nullptr: not known); `lowered` is folded on the
// way. nullopt: it has no form, reported.
std::optional<backends::cycle::Emitted> writtenCycle(const project::CycleFolder& folder,
                                                     project::LoweredCycle& lowered,
                                                     const stdlib::Control* control,
                                                     project::Session& session);

// A text of the language as the library sees it.
class ReadCycle {
public:
  explicit ReadCycle(project::Session& session) : session_(session), files_(session) {}
  // false: `found` says why; places are those of `text`, which becomes a file of the session.
  bool read(const std::string& name, const std::string& text, Diagnostics& found);
  // In the one layout. Only of a text without errors of syntax.
  std::string laidOut() const;
  // With the cycles that it calls; nullopt: `found` says why.
  std::optional<frontend::cycle::Lowered> lowered(Diagnostics& found);

private:
  project::Session& session_;
  project::CycleFiles files_;
  frontend::cycle::File file_;
};

} // namespace dotek::targets
