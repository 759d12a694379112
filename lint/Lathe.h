// Programs of lathes, which the profiles do not describe: the same codes mean something else there.
#pragma once

#include "lint/Project.h"

#include <optional>
#include <set>
#include <string_view>

namespace dotek::lint {

struct LatheMark {
  SourceRange range;
  std::string_view what; // that the block does, to follow "this block"
};
// What shows that the programs of the file are a lathe's; nothing: they are a mill's, or nothing shows.
std::optional<LatheMark> latheMark(const macrob::File& file);
// The files of NC programs that have such a mark: it takes a walk over all of a file.
std::set<const macrob::File*> latheFiles(const Project& project);

// The rule judges one program by what a mill makes of codes, modes, cycles and offsets.
bool isOfMills(std::string_view rule);

} // namespace dotek::lint
