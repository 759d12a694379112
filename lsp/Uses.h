// Where names are: the place that a request asks about, and all places at which its name means the same.
#pragma once

#include "lsp/Server.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dotek::lsp {

struct Place {
  const Document* document = nullptr;
  const Index* index = nullptr;
  std::uint32_t offset = 0;
};

// nullopt: the text is in no language that Dotek reads, as it may be while somebody types.
std::optional<Place> placeIn(Workspace& workspace, const Json& params);

// Where a name is, over the files in which it means the same.
struct Use {
  std::string uri;
  const Index* index = nullptr;
  const Occurrence* occurrence = nullptr;
};

std::vector<Use> usesOf(Workspace& workspace, const Document& document, const Occurrence& one);

// What the comments below the number of the called program say of the argument, as `(D #7 DIAMETER, MM)` has
// it; which local it is where they say nothing. As Markdown.
std::string ownArgumentText(Workspace& workspace, const Document& document, const OwnArgument& argument);
// Its name from there, `diameter:`; "": none.
std::string ownArgumentHint(Workspace& workspace, const Document& document, const OwnArgument& argument);

} // namespace dotek::lsp
