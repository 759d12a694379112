#include "lint/SufPrograms.h"

#include <set>

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kFirstField = 20, kLastField = 23; // conditions of the fields of the operator
constexpr std::uint32_t kFieldLabel = 200;                 // M42 H220 sets up field 20

void checkProgram(const mikroprog::Reading& reading, Report& report) {
  std::set<std::uint32_t> fields;
  for (const mikroprog::Block& block : reading.blocks) {
    if (block.line->unread) continue;
    const mikroprog::Word* condition = block.line->find('O');
    const std::uint32_t asked = mikroprog::wholeOf(condition).value_or(0);
    for (const mikroprog::Code& code : block.codes) {
      if (code.function == nullptr) continue;
      if (code.function->function == "set-condition") {
        const std::uint32_t field = mikroprog::wholeOf(block.line->find('H')).value_or(0);
        fields.insert(field > kFieldLabel ? field - kFieldLabel : field);
      }
      if (code.function->find('O') != nullptr && asked >= kFirstField && asked <= kLastField &&
          !fields.contains(asked))
        report.at(condition->range, "`O{}` asks for a field of the operator that no M42 before has set up",
                  asked);
    }
  }
}

} // namespace

DOTEK_LINT_RULE(suf_field_not_set){
    .severity = Severity::Warning,
    .check = checkSufPrograms<checkProgram>,
};

} // namespace dotek::lint::rule
