// Requests about names and symbols: hover, definition, references, symbols, hints.
#include "lsp/Uses.h"
#include "project/CycleFolder.h"
#include "support/Ascii.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <set>
#include <utility>

namespace dotek::lsp {

using Role = Occurrence::Role;

namespace {

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

namespace {

// Where a variable that nothing declares gets its first value, and the line that gives it.
std::string firstValue(const Occurrence& one, const std::vector<Use>& uses) {
  for (const Use& use : uses) {
    if (use.occurrence->role != Role::Write) continue;
    const SourceFile& file = use.index->text();
    const std::uint32_t line = file.lineOf(use.occurrence->range.begin);
    return fmt::format("**{}** first set in line {} of {}:\n\n    {}", one.key.substr(6), line,
                       std::filesystem::path(file.name()).filename().string(),
                       use.index->utf8(file.line(line)));
  }
  return "";
}

// What is known of a name elsewhere: at its declaration in another file, or the comment of a program.
// `alone`: nothing else is known of it.
Fact factElsewhere(Workspace& workspace, const Place& place, bool alone) {
  const Occurrence* const one = place.index->at(place.offset);
  if (one == nullptr) return {};
  Fact out{one->range, ""};
  const std::vector<Use> uses = usesOf(workspace, *place.document, *one);
  for (const Use& use : uses) {
    if (use.occurrence->role == Role::Read) continue;
    const std::string file = std::filesystem::path(use.index->text().name()).filename().string();
    if (one->key.starts_with("O ")) {
      for (const Symbol& symbol : use.index->symbols)
        if (symbol.nameRange == use.occurrence->range)
          out.text = fmt::format("**{}** {}\n\n{}", symbol.name, symbol.detail, file);
      break;
    }
    const bool declares = use.index->kind == std::optional(project::InputKind::DefineData) ||
                          use.index->kind == std::optional(project::InputKind::Dialog);
    if (!one->key.starts_with("field ") || !declares) continue;
    for (const Fact& fact : use.index->facts)
      if (fact.range == use.occurrence->range && out.text.find(fact.text) == std::string::npos) {
        out.text += (out.text.empty() ? "" : "\n\n") + fact.text + fmt::format(" ({})", file);
        break;
      }
  }
  if (out.text.empty() && alone && one->key.starts_with("field ")) out.text = firstValue(*one, uses);
  return out;
}

} // namespace

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
  // A field is its first value and its row in the dialog.
  const Occurrence* const named = place.index->at(place.offset);
  Fact elsewhere;
  if (best == nullptr || (named != nullptr && named->key.starts_with("field ")))
    elsewhere = factElsewhere(workspace, place, best == nullptr);
  if (best == nullptr && elsewhere.text.empty())
    for (const OwnArgument& one : place.index->ownArguments)
      if (place.offset >= one.range.begin && place.offset <= one.range.end)
        elsewhere = {one.range, ownArgumentText(workspace, *place.document, one)};
  if (!elsewhere.text.empty()) best = &elsewhere;
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
  const std::vector<Use> uses = usesOf(workspace, *place.document, *one);
  Json out = Json::array();
  for (const Use& use : uses)
    if (use.occurrence->role == Role::Definition) out.push_back(locationOf(use, workspace.units));
  // What nothing declares begins where it is first written.
  for (const Use& use : uses)
    if (out.empty() && use.occurrence->role == Role::Write) out.push_back(locationOf(use, workspace.units));
  if (!out.empty()) return out;
  // The beginning of the file that the name stands for.
  std::string path;
  if (const auto file = place.index->files.find(one->key); file != place.index->files.end())
    path = file->second;
  if (one->key.starts_with("cycle "))
    for (const std::string& folder : Workspace::cycleFolders(place.document->path))
      if (path.empty() && std::filesystem::path(folder).filename() == one->key.substr(6))
        for (const char* name : {"ToolPath.mac", "CycleData.mac", "CycleData.dlg", "DefineData.txt"})
          if (const auto file = project::cycleFile(folder, name); file && path.empty())
            path = file->generic_string();
  const Json start = {{"line", 0}, {"character", 0}};
  if (!path.empty()) out.push_back({{"uri", uriOf(path)}, {"range", {{"start", start}, {"end", start}}}});
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
  for (const Use& use : usesOf(workspace, *place.document, *one))
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

Json documentSymbols(Workspace& workspace, const Json& params) {
  const Index& index = workspace.index(documentOf(workspace, params));
  Json out = Json::array();
  if (index.file == kNoFile) return out;
  for (const Symbol& symbol : index.symbols)
    out.push_back(symbolJson(symbol, index.text(), workspace.units));
  return out;
}

Json inlayHints(Workspace& workspace, const Json& params) {
  const Document& document = documentOf(workspace, params);
  const Index& index = workspace.index(document);
  Json out = Json::array();
  if (index.file == kNoFile) return out;
  std::uint32_t begin = 0, end = UINT32_MAX;
  if (const auto range = params.find("range"); range != params.end() && range->is_object()) {
    begin = offsetOf(index.text(), range->value("start", Json()), workspace.units).value_or(0);
    end = offsetOf(index.text(), range->value("end", Json()), workspace.units).value_or(UINT32_MAX);
  }
  const auto add = [&](std::uint32_t offset, const std::string& label) {
    if (offset < begin || offset > end || label.empty()) return;
    out.push_back({{"position", positionOf(index.text(), offset, workspace.units)},
                   {"label", label},
                   {"kind", 2},
                   {"paddingRight", false}});
  };
  for (const Hint& hint : index.hints)
    add(hint.offset, hint.label);
  std::map<std::pair<std::uint32_t, char>, std::string> own; // a program is looked up once for each letter
  for (const OwnArgument& one : index.ownArguments)
    if (one.range.begin >= begin && one.range.begin <= end) {
      const auto [known, isNew] = own.try_emplace({one.program, one.letter});
      if (isNew) known->second = ownArgumentHint(workspace, document, one);
      add(one.range.begin, known->second);
    }
  return out;
}

} // namespace dotek::lsp
