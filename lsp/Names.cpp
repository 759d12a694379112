// Requests about names and symbols: hover, definition, references, rename, symbols, hints.
#include "lsp/Server.h"

#include <algorithm>
#include <set>

namespace dotek::lsp {

using Role = Occurrence::Role;

namespace {

struct Place {
  const Document* document = nullptr;
  const Index* index = nullptr;
  std::uint32_t offset = 0;
};

// nullopt: the text is in no language that Dotek reads, as it may be while somebody types.
std::optional<Place> placeIn(Workspace& workspace, const Json& params) {
  Place out;
  out.document = &documentOf(workspace, params);
  out.index = &workspace.index(*out.document);
  if (out.index->file == kNoFile) return std::nullopt;
  out.offset = placeOf(workspace, *out.index, params);
  return out;
}

Place renamePlace(Workspace& workspace, const Json& params) {
  const std::optional<Place> place = placeIn(workspace, params);
  if (!place) throw Refusal{kRequestFailed, "the text is in no language that Dotek reads"};
  return *place;
}

// Where a name is, over the files in which it means the same.
struct Use {
  std::string uri;
  const Index* index = nullptr;
  const Occurrence* occurrence = nullptr;
};

// Names that are known in all files of a cycle's folder; others are of their file, as the labels of a macro.
bool isShared(const std::string& key) {
  return key.starts_with("field ");
}

std::vector<Use> usesOf(Workspace& workspace, const Document& document, const std::string& key) {
  std::vector<Use> out;
  const auto add = [&](const std::string& uri, const Index& index) {
    for (const Occurrence& one : index.occurrences)
      if (one.key == key) out.push_back({uri, &index, &one});
  };
  add(document.uri, workspace.index(document));
  const auto openAs = [&](const std::string& path) {
    for (const auto& [uri, other] : workspace.documents())
      if (other.path == path) return uri;
    return uriOf(path);
  };
  std::set<std::string> seen{document.path};
  if (isShared(key))
    for (const std::string& path : workspace.companions(document))
      if (seen.insert(path).second) add(openAs(path), workspace.indexOf(path));
  // Programs, fields of a post, cycles and common variables: in what is open, too.
  const bool wide = key.starts_with("O ") || key.starts_with("field ") || key.starts_with("cycle ") ||
                    (key.starts_with("# ") && key.find(' ', 2) == std::string::npos);
  if (wide)
    for (const auto& [uri, other] : workspace.documents())
      if (seen.insert(other.path).second) add(uri, workspace.index(other));
  return out;
}

Json locationOf(const Use& use, Units units) {
  return {{"uri", use.uri}, {"range", rangeOf(use.index->text(), use.occurrence->range, units)}};
}

Json symbolJson(const Symbol& symbol, const SourceFile& file, Units units) {
  Json children = Json::array();
  for (const Symbol& child : symbol.children)
    children.push_back(symbolJson(child, file, units));
  Json out = {{"name", symbol.name.empty() ? "?" : symbol.name},
              {"kind", static_cast<int>(symbol.kind)},
              {"range", rangeOf(file, symbol.range, units)},
              {"selectionRange", rangeOf(file, symbol.nameRange, units)}};
  if (!symbol.detail.empty()) out["detail"] = symbol.detail;
  if (!children.empty()) out["children"] = children;
  return out;
}

// What a name's occurrence holds beside the name itself: the N of a block, the # of a variable.
std::string prefixOf(const Index& index, const Occurrence& one) {
  const std::string text = index.sources.textUtf8(one.range);
  if (one.key.starts_with("N ") && !text.empty() && (text.front() == 'N' || text.front() == 'n'))
    return text.substr(0, 1);
  return "";
}

const Occurrence& renamed(const Place& place) {
  const Occurrence* const one = place.index->at(place.offset);
  if (one == nullptr) throw Refusal{kRequestFailed, "no name is here"};
  const auto& may = place.index->renamable;
  if (std::find(may.begin(), may.end(), one->key) == may.end())
    throw Refusal{
        kRequestFailed,
        "this name is known outside of what is open: the control, the CAM or another program may use it"};
  if (one->key.starts_with("N ") && place.index->computedJumps)
    throw Refusal{kRequestFailed, "a GOTO of this file computes its block number, so no number is renamed"};
  return *one;
}

void checkName(const Occurrence& one, const std::string& name, const Index& index) {
  const bool number = one.key.starts_with("N ");
  const bool good = !name.empty() && name.size() <= 60 && std::all_of(name.begin(), name.end(), [&](char c) {
    if (c >= '0' && c <= '9') return true;
    return !number && ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_');
  }) && (number ? name.size() <= 8 : !(name.front() >= '0' && name.front() <= '9'));
  if (!good)
    throw Refusal{kRequestFailed, number ? "a block number has digits only"
                                         : "a name has letters, digits and `_`, and begins with no digit"};
  const std::string key = one.key.substr(0, one.key.rfind(' ') + 1) + name;
  for (const Occurrence& other : index.occurrences)
    if (other.key == key) throw Refusal{kRequestFailed, "`" + name + "` is in use"};
}

} // namespace

const Document& documentOf(const Workspace& workspace, const Json& params) {
  const auto at = params.find("textDocument");
  if (at == params.end() || !at->is_object() || !at->contains("uri") || !(*at)["uri"].is_string())
    throw Refusal{kInvalidParams, "the request names no document"};
  const Document* const document = workspace.find((*at)["uri"].get<std::string>());
  if (document == nullptr) throw Refusal{kRequestFailed, "the document is not open"};
  return *document;
}

std::uint32_t placeOf(const Workspace& workspace, const Index& index, const Json& params) {
  const auto at = params.find("position");
  const auto offset = at == params.end() ? std::nullopt : offsetOf(index.text(), *at, workspace.units);
  if (!offset) throw Refusal{kInvalidParams, "the request has no position"};
  return *offset;
}

Json hover(Workspace& workspace, const Json& params) {
  const std::optional<Place> found = placeIn(workspace, params);
  if (!found) return nullptr;
  const Place& place = *found;
  std::string text;
  SourceRange range;
  for (const Found& one : workspace.found(place.document->path)) {
    if (place.offset < one.range.begin || place.offset > one.range.end) continue;
    const driver::Outcome page = driver::explain(one.code);
    text += (text.empty() ? "" : "\n\n---\n\n") + page.output;
    if (!range.hasPlace()) range = {place.index->file, one.range.begin, one.range.end};
    break; // one page is what a window takes
  }
  const Fact* best = nullptr;
  for (const Fact& fact : place.index->facts)
    if (place.offset >= fact.range.begin && place.offset <= fact.range.end &&
        (best == nullptr || fact.range.begin >= best->range.begin))
      best = &fact;
  if (best != nullptr) {
    text = best->text + (text.empty() ? "" : "\n\n---\n\n" + text);
    range = best->range;
  }
  if (text.empty()) return nullptr;
  return {{"contents", {{"kind", "markdown"}, {"value", text}}},
          {"range", rangeOf(place.index->text(), range, workspace.units)}};
}

Json definition(Workspace& workspace, const Json& params) {
  const std::optional<Place> found = placeIn(workspace, params);
  if (!found) return nullptr;
  const Place& place = *found;
  const Occurrence* const one = place.index->at(place.offset);
  if (one == nullptr) return nullptr;
  const std::vector<Use> uses = usesOf(workspace, *place.document, one->key);
  Json out = Json::array();
  for (const Use& use : uses)
    if (use.occurrence->role == Role::Definition) out.push_back(locationOf(use, workspace.units));
  // What nothing declares begins where it is first written.
  for (const Use& use : uses)
    if (out.empty() && use.occurrence->role == Role::Write) out.push_back(locationOf(use, workspace.units));
  return out;
}

Json references(Workspace& workspace, const Json& params) {
  const std::optional<Place> found = placeIn(workspace, params);
  if (!found) return nullptr;
  const Place& place = *found;
  const Occurrence* const one = place.index->at(place.offset);
  Json out = Json::array();
  if (one == nullptr) return out;
  const bool declarations =
      !params.contains("context") || params["context"].value("includeDeclaration", true);
  for (const Use& use : usesOf(workspace, *place.document, one->key))
    if (declarations || use.occurrence->role != Role::Definition)
      out.push_back(locationOf(use, workspace.units));
  return out;
}

Json highlights(Workspace& workspace, const Json& params) {
  const std::optional<Place> found = placeIn(workspace, params);
  if (!found) return nullptr;
  const Place& place = *found;
  const Occurrence* const one = place.index->at(place.offset);
  Json out = Json::array();
  if (one == nullptr) return out;
  for (const Occurrence& other : place.index->occurrences)
    if (other.key == one->key)
      out.push_back({{"range", rangeOf(place.index->text(), other.range, workspace.units)},
                     {"kind", other.role == Role::Read ? 2 : 3}});
  return out;
}

Json prepareRename(Workspace& workspace, const Json& params) {
  const Place place = renamePlace(workspace, params);
  const Occurrence& one = renamed(place);
  SourceRange range = one.range;
  range.begin += static_cast<std::uint32_t>(prefixOf(*place.index, one).size());
  return {{"range", rangeOf(place.index->text(), range, workspace.units)},
          {"placeholder", place.index->sources.textUtf8(range)}};
}

Json rename(Workspace& workspace, const Json& params) {
  const Place place = renamePlace(workspace, params);
  const Occurrence& one = renamed(place);
  const std::string name = params.value("newName", "");
  checkName(one, name, *place.index);
  Json changes = Json::object();
  for (const Use& use : usesOf(workspace, *place.document, one.key))
    changes[use.uri].push_back({{"range", rangeOf(use.index->text(), use.occurrence->range, workspace.units)},
                                {"newText", prefixOf(*use.index, *use.occurrence) + name}});
  return {{"changes", changes}};
}

Json documentSymbols(Workspace& workspace, const Json& params) {
  const Index& index = workspace.index(documentOf(workspace, params));
  Json out = Json::array();
  if (index.file == kNoFile) return out;
  for (const Symbol& symbol : index.symbols)
    out.push_back(symbolJson(symbol, index.text(), workspace.units));
  return out;
}

Json inlayHints(Workspace& workspace, const Json& params) {
  const Index& index = workspace.index(documentOf(workspace, params));
  Json out = Json::array();
  if (index.file == kNoFile) return out;
  std::uint32_t begin = 0, end = UINT32_MAX;
  if (const auto range = params.find("range"); range != params.end() && range->is_object()) {
    begin = offsetOf(index.text(), range->value("start", Json()), workspace.units).value_or(0);
    end = offsetOf(index.text(), range->value("end", Json()), workspace.units).value_or(UINT32_MAX);
  }
  for (const Hint& hint : index.hints)
    if (hint.offset >= begin && hint.offset <= end)
      out.push_back({{"position", positionOf(index.text(), hint.offset, workspace.units)},
                     {"label", hint.label},
                     {"kind", 2},
                     {"paddingRight", false}});
  return out;
}

} // namespace dotek::lsp
