#include "lint/SufPrograms.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace dotek::lint::rule {
namespace {

namespace fs = std::filesystem;

// Beside the program, or in the folder of the macros beside it. Names of DOS: capitals and small letters are
// one.
bool isAtHand(const fs::path& program, const std::string& name) {
  const fs::path folder = program.parent_path().empty() ? fs::path(".") : program.parent_path();
  std::string small = name;
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::error_code error;
  for (const fs::path& place : {folder, folder / "ZAKLADNI", folder / "zakladni"})
    if (fs::exists(place / name, error) || fs::exists(place / small, error)) return true;
  return false;
}

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  const fs::path own = reading.sources.file(reading.program.file).name();
  for (const mikroprog::Block& block : reading.blocks) {
    if (block.line->unread) continue;
    for (const mikroprog::Code& code : block.codes) {
      if (code.function == nullptr || code.function->letter != 'M') continue;
      const std::string name = code.function->code() + ".MAC";
      if (code.function->number == 60)
        report.at(code.word->range,
                  "`M60` runs a routine of HW.DAT, which the supplier of the machine has written; what "
                  "it does nobody sees here");
      else if (code.function->function == "run-macro" && !isAtHand(own, name))
        report.at(code.word->range,
                  "`{}` runs {}, which is not beside the program and not in a folder ZAKLADNI there; "
                  "what it does is not checked",
                  code.function->code(), name);
    }
  }
}

} // namespace

DOTEK_LINT_RULE(suf_outside_file){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
