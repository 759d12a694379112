// Private to Target*.cpp: whether a dialog asks for what its source asks for.
#pragma once

#include "backends/gibbs/Emit.h"
#include "project/CycleFolder.h"
#include "support/Source.h"
#include "targets/DialogChoices.h"

#include <map>
#include <string>
#include <vector>

namespace dotek::targets {

// Where the dialog of the folder, which may have been edited, is not that of its source: a field without an
// input, a list that offers other values or calls them otherwise, an input that shows another field's value,
// a text that belongs to another field. `fields` are those that convert asks for, by the source's name,
// `lists` what the source offers. In other words a text may say the same.
std::vector<std::string> dialogDifferences(const project::CycleFolder& folder, const SourceMap& sources,
                                           const std::map<std::string, backends::gibbs::Field>& fields,
                                           const ChoiceLists& lists);

} // namespace dotek::targets
