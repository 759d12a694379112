// Any bytes as a post of Fusion: words, tree, names, ES5. What was read whole and can be said in ES5 is read
// whole again, and is then itself.
#include "frontend/fusion/Lower.h"
#include "frontend/fusion/Parse.h"

#include <cstdint>
#include <cstdlib>
#include <string>

using namespace dotek;
using namespace dotek::frontend;

namespace {

bool within(const SourceRange& range, std::size_t size) {
  return range.begin <= range.end && range.end <= size;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(data, data + size);
  SourceMap sources;
  const FileId file =
      sources.add(SourceFile("post.cps", bytes, isUtf8(bytes) ? Encoding::Utf8 : Encoding::Cp1250));
  const fusion::Tree tree = fusion::parse(file, sources);
  std::uint32_t last = 0;
  for (const fusion::Token& token : tree.tokens.tokens) {
    if (token.begin < last || token.end < token.begin || token.end > tree.text.size()) std::abort();
    last = token.begin;
  }
  for (const fusion::Node& node : tree.nodes)
    if (!within(tree.range(node), tree.text.size())) std::abort();
  for (const fusion::Unread& unread : tree.unread)
    if (!within(unread.range, tree.text.size()) || unread.message.empty()) std::abort();
  const fusion::Scopes scopes = fusion::resolve(tree);
  if (!tree.unread.empty()) return 0;
  const fusion::Lowered lowered = fusion::lower(tree, scopes);
  if (!lowered.refused.empty()) return 0;
  const fusion::Tree again = fusion::parseText(lowered.text);
  if (!again.unread.empty()) std::abort();
  const fusion::Lowered second = fusion::lower(again, fusion::resolve(again));
  if (!second.refused.empty() || second.text != lowered.text) std::abort();
  return 0;
}
