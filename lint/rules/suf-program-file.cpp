#include "lint/SufPrograms.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace dotek::lint::rule {
namespace {

namespace fs = std::filesystem;

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

// Names of DOS: capitals and small letters are one. Where the folder cannot be read nothing is missing.
bool isBeside(const fs::path& program, const std::string& name) {
  std::error_code error;
  const fs::path folder = program.parent_path();
  const fs::directory_iterator files(folder.empty() ? fs::path(".") : folder, error);
  if (error) return true;
  return std::any_of(begin(files), end(files), [&](const fs::directory_entry& one) {
    return upper(one.path().filename().string()) == upper(name);
  });
}

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  const fs::path own = reading.sources.file(reading.program.file).name();
  std::error_code error;
  const bool onDisk = fs::is_regular_file(own, error);
  const std::string ending = upper(own.extension().string());
  for (const mikroprog::Block& block : reading.blocks) {
    const mikroprog::Word* file = block.line->unread ? nullptr : block.line->find('@');
    if (file == nullptr) continue;
    const std::string shown = reading.text(file->range).substr(1);
    if (file->file.find_first_of("/\\:") != std::string::npos) {
      report.at(file->range,
                "`{}` is not in the folder of the program; the control looks for files there alone, so "
                "write the name without a path",
                shown);
    } else if (!block.does("run-program")) {
      continue;
    } else if (!ending.empty() && upper(fs::path(file->file).extension().string()) != ending) {
      report.at(file->range, "`{}` does not end in {} as the program that runs it does", shown, ending);
    } else if (onDisk && !isBeside(own, file->file)) {
      report.at(file->range, "`{}` is not beside the program; the control looks for it there", shown);
    }
  }
}

} // namespace

DOTEK_LINT_RULE(suf_program_file){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
