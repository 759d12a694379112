// Reads a post.
#pragma once

#include "frontend/fusion/Ast.h"

namespace dotek::frontend::fusion {

// Never fails: what could not be read is in Tree::unread, and an Error node takes its place. The file stays
// as long as the tree does.
Tree parse(FileId file, const SourceMap& sources);
// The same of a text that is no file.
Tree parseText(std::string_view text, FileId file = 0);

} // namespace dotek::frontend::fusion
