// Requests about names and symbols: hover, definition, references, rename, symbols, hints.
#include "frontend/fusion/Tokens.h"
#include "lsp/Server.h"
#include "project/CycleFolder.h"
#include "support/Ascii.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
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

std::string folderName(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

// Fields of two cycles with one name are two fields; a Prog says which cycle it prints.
class Finder {
public:
  Finder(Workspace& workspace, const Document& document, const Occurrence& one)
      : workspace_(workspace), document_(document), key_(one.key), scope_(one.scope) {}

  std::vector<Use> uses() {
    const bool field = key_.starts_with("field ");
    add(document_.path);
    const std::string unit = Workspace::unitOf(document_.path);
    const bool ofCycle = unit != document_.path;
    const bool prog = workspace_.index(document_).kind == std::optional(project::InputKind::Prog);
    if (field && ofCycle) {
      scope_ = folderName(unit);
      for (const std::string& path : workspace_.companions(document_))
        add(path);
      if (const std::string post = Workspace::postOf(document_.path); !post.empty()) add(post);
    } else if (field && prog) {
      for (const std::string& folder : Workspace::cycleFolders(document_.path))
        if (scope_.empty() || folderName(folder) == scope_) addFolder(folder);
    } else if (key_.starts_with("O ")) {
      for (const std::string& path : workspace_.beside(document_, project::InputKind::Nc))
        add(path);
    } else if (key_.starts_with("cycle ") && !prog) {
      for (const std::string& path : workspace_.beside(document_, project::InputKind::Cycle))
        add(path);
    }
    // What is open, too.
    const bool common = key_.starts_with("# ") && key_.find(' ', 2) == std::string::npos;
    for (const auto& [uri, other] : workspace_.documents()) {
      const bool isProg = workspace_.index(other).kind == std::optional(project::InputKind::Prog);
      const std::string folder = Workspace::unitOf(other.path);
      const bool sameCycle = prog && folder != other.path && (scope_.empty() || folderName(folder) == scope_);
      if (common || key_.starts_with("O ") || key_.starts_with("cycle ") ||
          (field && (isProg ? prog || ofCycle : sameCycle)))
        add(other.path);
    }
    return std::move(out_);
  }

private:
  void addFolder(const std::string& folder) {
    for (const char* name : {"DefineData.txt", "CycleData.dlg", "CycleData.mac", "ToolPath.mac"})
      if (const auto path = project::cycleFile(folder, name)) add(path->generic_string());
  }

  void add(const std::string& path) {
    if (!seen_.insert(path).second) return;
    std::string uri = uriOf(path);
    for (const auto& [open, other] : workspace_.documents())
      if (other.path == path) uri = open;
    const Index& index = workspace_.indexOf(path);
    for (const Occurrence& one : index.occurrences)
      if (one.key == key_ && (one.scope.empty() || scope_.empty() || one.scope == scope_))
        out_.push_back({uri, &index, &one});
  }

  Workspace& workspace_;
  const Document& document_;
  std::string key_, scope_;
  std::set<std::string> seen_;
  std::vector<Use> out_;
};

std::vector<Use> usesOf(Workspace& workspace, const Document& document, const Occurrence& one) {
  return Finder(workspace, document, one).uses();
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
  // Of Mikroprog the L of a jump.
  if (one.key.starts_with("N ") && !text.empty() && isLetter(text.front())) return text.substr(0, 1);
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
    throw Refusal{kRequestFailed, "a jump of this file computes its block number, so no number is renamed"};
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
  if (index.post && frontend::fusion::isReserved(name))
    throw Refusal{kRequestFailed, "`" + name + "` is a word of the language"};
  if (index.taken.contains(name)) throw Refusal{kRequestFailed, "`" + name + "` is in use"};
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

namespace {

// Where a variable that nothing declares gets its first value, and the line that gives it.
std::string firstValue(const Occurrence& one, const std::vector<Use>& uses) {
  for (const Use& use : uses) {
    if (use.occurrence->role != Role::Write) continue;
    const SourceFile& file = use.index->text();
    const std::uint32_t line = file.lineOf(use.occurrence->range.begin);
    return fmt::format("**{}** first set in line {} of {}:\n\n    {}", one.key.substr(6), line,
                       folderName(file.name()), use.index->utf8(file.line(line)));
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
    const std::string file = folderName(use.index->text().name());
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
      if (path.empty() && folderName(folder) == one->key.substr(6))
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
  for (const Use& use : usesOf(workspace, *place.document, one))
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
