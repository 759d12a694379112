// Programs of macro B: from a file that was read to the IR.
#pragma once

#include "frontend/macrob/Parse.h"
#include "ir/Program.h"
#include "project/Session.h"
#include "stdlib/Control.h"

#include <optional>
#include <string>

namespace dotek::project {

// What --from says of NC files, else the dotek.toml of this one.
frontend::macrob::Text textOf(FileId file, Session& session);
// Who names a listing says that its text is not the one that ran: what checks of its programs are certain of
// is for `lint --fix`, too.
void repairListings(Session& session);

// What the control takes that the dotek.toml of this file names.
frontend::macrob::Forms formsOf(FileId file, Session& session);

// false for a folder and for what is not there. Of a file that is no program it is reported what it is.
bool isProgramFile(const std::string& path, Session& session);

// nullopt where the file cannot run on the control: reported. What matters to the writing of the programs
// alone is left to lint.
std::optional<ir::ProgramFile> loadPrograms(FileId file, const stdlib::Control& control, Session& session);
// For a translation: a jump that no run gets past refuses it, too. `leader`: gets the place of the text
// before the first `%`, if there is any.
std::optional<ir::ProgramFile> loadForTranslation(FileId file, const stdlib::Control& control,
                                                  Session& session, SourceRange& leader);

} // namespace dotek::project
