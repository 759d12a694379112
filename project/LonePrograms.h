// The programs of a file one by one: what is wrong with one is no matter of the others.
#pragma once

#include "frontend/macrob/Ast.h"
#include "ir/Program.h"
#include "project/Session.h"
#include "stdlib/Control.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace dotek::project {

struct LoneProgram {
  std::uint64_t number = 0;    // 0: it has none
  frontend::macrob::File file; // with this program alone
  Diagnostics found;           // errors of reading it
};

// In the order of the file. A number that the first program lacks is that of the file's name, as in O1234.nc.
std::vector<LoneProgram> lonePrograms(FileId file, const stdlib::Control& control, Session& session);

// nullopt where the program cannot run on the control: reported.
std::optional<ir::Program> lowerAlone(LoneProgram& program, const stdlib::Control& control, Session& session);

// What may be the numbers of the programs in a text, found without reading it as a program: at the beginnings
// of its lines.
std::vector<std::uint64_t> programNumbers(std::string_view text);

// Of a file O1234, whatever its extension; 0: it has another name.
std::uint64_t numberOfName(std::string_view fileName);

} // namespace dotek::project
