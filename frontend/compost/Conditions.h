// Private to Post*.cpp, Lower*.cpp: which conditions of a Prog hold while an operation is posted.
#pragma once

#include "frontend/compost/Ast.h"
#include "stdlib/Form.h"
#include "support/Diagnostics.h"

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

namespace dotek::frontend::compost {

inline constexpr std::string_view kFieldKeyword = "OpFieldData";
inline constexpr std::string_view kCycleKeyword = "CycleType";
inline constexpr std::string_view kFlagKeyword = "Flag";
inline constexpr std::string_view kSetFlagKeyword = "SetFlag";
inline constexpr std::string_view kClearFlagKeyword = "SetFlagF";

// Truth of a condition; nothing: a keyword whose truth is not known decides it.
using Truth = std::optional<bool>;

// Flags, the cycle that runs, what the form and `--assume` say. Keeps references to its arguments.
class Conditions {
public:
  Conditions(const Program& program, const stdlib::Form& form, const std::set<std::string>& assumptions);

  std::string cycle; // what CycleType?('..') compares with; "" where no operation runs

  // SetFlag and SetFlagF; a word without one name is reported.
  void setFlag(const Word& word, Diagnostics& diagnostics);
  // Nothing: reported, of one cause once.
  Truth truth(const Condition& condition, Diagnostics& diagnostics);

private:
  Truth truth(const ConditionTerm& term, Diagnostics& diagnostics);
  Truth truth(const Word& boolean, Diagnostics& diagnostics);

  const stdlib::Form* form_; // pointers: a run copies its conditions
  const std::set<std::string>* assumptions_;
  std::map<std::string, bool, std::less<>> flags_;
  // First routine that sets the flag.
  std::shared_ptr<const std::map<std::string, const Routine*, std::less<>>> setters_;
  std::set<std::string, std::less<>> told_; // booleans that were reported as unknown
};

} // namespace dotek::frontend::compost
