// A call of one vendor's macro written as a call of another's: by intent and roles, never by program numbers.
#pragma once

#include "ir/Program.h"
#include "stdlib/Control.h"
#include "stdlib/MacroSet.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace dotek::backends::fanuc {

struct TranslateSettings {
  const stdlib::MacroSet& source;
  const stdlib::MacroSet& target;
  const stdlib::Control& control; // of the program
  std::function<ir::LabelId()>
      newLabel;             // a label without number of the program, for the checks before a call
  std::uint32_t alarm = 0;  // n of #3000 of those checks
  std::string written = {}; // name of the control that the program becomes; "": `control`
};

// One set with the same variables: a control may have it elsewhere (stdlib::packaged).
bool isSame(const stdlib::MacroSet& one, const stdlib::MacroSet& other);
// Where macros of one name leave in `target` what they leave in #`variable` in `source`; nothing: they write
// it nowhere, or are others.
std::optional<std::uint32_t> packagedVariable(const stdlib::MacroSet& source, const stdlib::MacroSet& target,
                                              std::uint32_t variable);

struct TranslatedCall {
  std::string refusal;                      // why it cannot be written; "": the rest holds
  std::vector<ir::ProgramStatement> before; // without origin; in this order before the call
  std::optional<ir::Call> call;             // nothing: `before` says it all
  std::vector<std::string> notes;           // what a reader of the program has to know, in lower case
};

// The call in the target's words. Coordinates and travels are turned into one another by the position at the
// call, after a block that waits until the axes stand. An argument that is empty at run time would change
// the meaning where the target computes with it: an alarm is written before the call. The same set: the call
// itself.
TranslatedCall translateCall(const ir::Call& call, const TranslateSettings& settings);

struct TranslatedVariable {
  std::string refusal; // "": `variable` holds
  std::uint32_t variable = 0;
};

// The variable that holds after the translated call what `variable` held after `call`. One that no macro
// writes keeps its number. Refused where the two sets do not document the same, or the target's macros
// overwrite it.
TranslatedVariable translateResult(const ir::Call& call, std::uint32_t variable,
                                   const TranslateSettings& settings);

} // namespace dotek::backends::fanuc
