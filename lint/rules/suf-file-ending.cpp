#include "lint/SufPrograms.h"

#include <algorithm>
#include <cctype>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  forEachSufBlock(project, [&](const mikroprog::Reading& reading, const mikroprog::Block& block) {
    const mikroprog::Word* file = block.line->find('@');
    if (file == nullptr) return;
    std::string name = file->file;
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    if (name.ends_with("." + reading.control.dataEnding)) return;
    for (const mikroprog::Code& code : block.codes)
      if (code.function != nullptr && code.function->function != "run-program" &&
          code.function->find('@') != nullptr)
        report.at(file->range, "`{}` does not end in .{}", reading.text(file->range).substr(1),
                  reading.control.dataEnding);
  });
}

} // namespace

DOTEK_LINT_RULE(suf_file_ending){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
