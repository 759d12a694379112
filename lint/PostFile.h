// A post of Fusion as rules see it.
#pragma once

#include "frontend/fusion/Scopes.h"
#include "stdlib/FusionNames.h"

namespace dotek::lint {

namespace fusion = frontend::fusion;

// One post, or a fragment of one.
struct PostFile {
  FileId file = kNoFile;
  fusion::Tree tree;
  fusion::Scopes scopes;
  const stdlib::FusionNames* names = nullptr;
  // A whole post: it has an entry function. Of a fragment other files define what it uses.
  bool whole = false;
};

} // namespace dotek::lint
