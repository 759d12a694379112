// What the dialog of a cycle offers for its fields.
#pragma once

#include "ir/Cycle.h"
#include "project/CycleFolder.h"
#include "project/Options.h"
#include "support/Source.h"

#include "verify/Draw.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::targets {

// A value that a field may have, and what the dialog says of it.
struct DialogChoice {
  double value = 0;
  std::string title; // UTF-8
};

// By name of the field or parameter, in one case.
using ChoiceLists = std::map<std::string, std::vector<DialogChoice>>;

// Of each field that the dialog of `folder` offers as a list, or as a check box (0 and 1).
ChoiceLists dialogChoices(const project::CycleFolder& folder, const SourceMap& sources);
// Of the parameters of a cycle file; what it says has been said.
ChoiceLists listsOfCycle(const std::string& file, const project::CommonOptions& options);
// Of each parameter of `cycle` that the dialog of `folder` offers as a list, or as a check box (0 and 1), in
// its order. Other parameters are absent.
std::map<ir::VariableId, std::vector<DialogChoice>>
dialogChoices(const project::CycleFolder& folder, const ir::Cycle& cycle, const SourceMap& sources);

// Of a parameter of the cycle language, by its type as a page of the cycle names it ("flag", "choice of a,
// b"); none of other types.
std::vector<DialogChoice> choicesOfType(std::string_view type);

// A parameter of this kind takes no other value than these, which its dialog offers: those of a list, unless
// it offers all six work systems, each of which is asked of the program anyway. A check box offers 0 and 1.
bool takesNoOther(ir::Kind kind, const std::vector<double>& offered);
// Values that the list of the field does not offer: above it, below it, and between two that it offers. None:
// it takes others.
std::vector<double> besideList(const verify::DrawField& field);
// The first value of the case that the list of its field does not offer, as the alarm says it; "": there is
// none.
std::string whyNotOffered(const std::vector<verify::DrawField>& fields, const verify::Case& drawn);
// The checks of the cycle reject what a list does not offer, as its dialog does; that of a work offset which
// offers all six systems is left to what is asked of each. The body has to read the parameter. A default that
// is none of them is reported and is none any more.
void confineToLists(ir::Cycle& cycle, const std::map<ir::VariableId, std::vector<DialogChoice>>& choices,
                    Diagnostics& diagnostics);

} // namespace dotek::targets
