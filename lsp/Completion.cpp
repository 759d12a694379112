// Words that may come next.
#include "lsp/Complete.h"
#include "lsp/Server.h"
#include "support/Ascii.h"

#include <algorithm>
#include <set>

namespace dotek::lsp {

std::string_view lastWord(std::string_view before) {
  std::size_t begin = before.size();
  while (begin > 0 && (isLetter(before[begin - 1]) || isDigit(before[begin - 1]) || before[begin - 1] == '_'))
    --begin;
  return before.substr(begin);
}

std::vector<Proposal> named(const Index& index, const std::string& kind, int icon) {
  std::vector<Proposal> out;
  std::set<std::string> seen;
  for (const Occurrence& one : index.occurrences) {
    if (!one.key.starts_with(kind)) continue;
    const std::string text = index.sources.textUtf8(one.range);
    if (seen.insert(text).second) out.push_back({text, "", "", icon});
  }
  return out;
}

namespace {

std::vector<Proposal> proposals(const Typing& typing) {
  if (typing.index.post) return completePost(typing);
  switch (*typing.index.kind) {
  case project::InputKind::Nc: return completeMacroB(typing);
  case project::InputKind::Prog: return completeComPost(typing);
  case project::InputKind::Macro:
  case project::InputKind::Dialog:
  case project::InputKind::DefineData: return completeGibbs(typing);
  case project::InputKind::Cycle: return completeCycle(typing);
  case project::InputKind::Suf: return completeMikroprog(typing);
  }
  return {};
}

} // namespace

Json completion(Workspace& workspace, const Json& params) {
  const Document& document = documentOf(workspace, params);
  const Index& index = workspace.index(document);
  Json items = Json::array();
  if (index.isRead()) {
    const std::uint32_t offset = placeOf(workspace, index, params);
    const SourceFile& file = index.text();
    const std::uint32_t start = file.lineStart(file.lineOf(offset));
    const driver::CommonOptions options = workspace.options({document.path});
    project::Session session(options);
    const Typing typing{workspace,
                        document,
                        index,
                        offset,
                        index.utf8(std::string_view(file.bytes()).substr(start, offset - start)),
                        session};
    // What is being typed is a name of the text itself; it is offered where the text has it elsewhere, too.
    const std::string typed(lastWord(typing.before));
    const auto uses =
        std::count_if(index.occurrences.begin(), index.occurrences.end(), [&](const Occurrence& one) {
          return one.range.end - one.range.begin == typed.size() &&
                 index.sources.textUtf8(one.range) == typed;
        });
    for (const Proposal& one : proposals(typing)) {
      if (one.label.empty() || (one.label == typed && uses < 2)) continue;
      Json item = {{"label", one.label}, {"kind", one.kind}};
      if (!one.detail.empty()) item["detail"] = one.detail;
      if (!one.documentation.empty())
        item["documentation"] = {{"kind", "markdown"}, {"value", one.documentation}};
      items.push_back(std::move(item));
    }
  }
  return {{"isIncomplete", false}, {"items", items}};
}

} // namespace dotek::lsp
