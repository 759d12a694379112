// What the parts of CycleFileRunner share.
#pragma once

#include "targets/CycleFileCases.h"

namespace dotek::targets {

// An alarm before anything moves: the checks of the cycle refuse the values.
inline bool isRejection(const verify::Record& record) {
  return record.ending == verify::Ending::Alarm && record.pieces.empty() && record.measures.empty();
}

// A touch finds its surface where it begins.
bool touchesAtOnce(const verify::Record& record, double ballRadius, SourceRange& at);

// `rejected`: an alarm before anything moves.
struct CycleFileRunner::Played {
  verify::Case drawn;
  std::optional<sim::Part> part;
  std::vector<verify::Touch> surfaces; // that the part is made of
  verify::Record record;
  sim::CycleWay way;
  bool rejected = false;
  bool partMade = false;
  bool atOnce = false; // a touch finds its surface where it begins
  std::string why;     // it says nothing of a translation; "": it does
  SourceRange whyAt;
};

// What the cycle does with other values of one case, in the same part. The callers of a cycle leave out what
// its parameters allow in the cases themselves; without any other argument there is nothing that it could do.
class CycleFileRunner::Questions final : public SourceQuestions {
public:
  // Both outlive it.
  Questions(CycleFileRunner& runner, const Played& played) : runner_(runner), played_(played) {}
  Ran with(const std::string& name, double value) override;
  Ran from(const verify::Entry& entry) override;
  Ran disturbed(const verify::Interference& interference) override;
  bool moves(const std::string& field) override;
  bool rejectsSome(const std::string& name) override;
  bool maySkip(const std::string& name) override;

private:
  CycleFileRunner& runner_;
  const Played& played_;
};

} // namespace dotek::targets
