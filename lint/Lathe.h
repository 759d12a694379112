// Programs of lathes: the same codes mean something else there than on a mill, whose rules are silent then.
#pragma once

#include "lint/Project.h"

#include <map>
#include <string_view>

namespace dotek::lint {

struct LatheMark {
  SourceRange range;
  std::string_view what; // that the block does, to follow "this block"
};
// The files of NC programs of which something shows that they are a lathe's, or all where the control that is
// named is one (with a mark that may be blank). Others are a mill's, or nothing shows.
using Lathes = std::map<const macrob::File*, LatheMark>;
Lathes findLathes(const Project& project);
// Computed once a project.
const Lathes& lathesOf(const Project& project);

// The rule judges one program by what a mill makes of codes, modes, cycles and offsets.
bool isOfMills(std::string_view rule);

} // namespace dotek::lint
