#include "targets/Verification.h"

namespace dotek::targets {

// The part of a cycle file is its rehearsal's.
void SourceQuestions::elsewhere(const verify::PartError&, const Growth&,
                                const std::function<void(const verify::Record&, sim::World&)>&) {}

const verify::Record& usualRun(const TargetCase& now, const verify::Entry& other,
                               std::optional<verify::Record>& kept) {
  if (!other.otherOffset || now.questions == nullptr) return *now.source;
  if (!kept) {
    verify::Entry own = now.entry;
    own.otherOffset = own.toolOffset;
    SourceQuestions::Ran ran = now.questions->from(own);
    kept = ran.answer == SourceQuestions::Answer::Runs ? std::move(ran.record) : *now.source;
  }
  return *kept;
}

void TargetRun::differs(verify::Aspect aspect, std::string text, std::string line) {
  differsAt(aspect, std::move(text), 0);
  differences.back().text = std::move(line);
}

void TargetRun::differsAt(verify::Aspect aspect, std::string text, std::uint32_t line) {
  TargetDifference& one = differences.emplace_back();
  one.difference.aspect = aspect;
  one.difference.text = std::move(text);
  one.line = line;
}

} // namespace dotek::targets
