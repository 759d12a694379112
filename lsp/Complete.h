// Words that may come next, one language each.
#pragma once

#include "lsp/Workspace.h"
#include "project/Session.h"

#include <string>
#include <string_view>
#include <vector>

namespace dotek::lsp {

// Kinds of the protocol.
inline constexpr int kFunction = 3, kField = 5, kVariable = 6, kValue = 12, kKeyword = 14;

// A word that may be written at a place.
struct Proposal {
  std::string label, detail, documentation;
  int kind = kKeyword;
};

// The place where the cursor is.
struct Typing {
  Workspace& workspace;
  const Document& document;
  const Index& index;
  std::uint32_t offset = 0;
  std::string before; // text of the line up to the cursor
  project::Session& session;
};

std::vector<Proposal> completeMacroB(const Typing& typing);
std::vector<Proposal> completeCycle(const Typing& typing);
std::vector<Proposal> completeComPost(const Typing& typing);
std::vector<Proposal> completeGibbs(const Typing& typing);
std::vector<Proposal> completePost(const Typing& typing);
std::vector<Proposal> completeMikroprog(const Typing& typing);

// Names of the index with this beginning of their keys, each once.
std::vector<Proposal> named(const Index& index, const std::string& kind, int icon);
// The word that ends at the cursor.
std::string_view lastWord(std::string_view before);

} // namespace dotek::lsp
