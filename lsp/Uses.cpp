#include "lsp/Uses.h"

#include "project/CycleFolder.h"

#include <filesystem>
#include <set>

namespace dotek::lsp {

namespace {

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
    const bool common = key_.starts_with("# ") && key_.find(' ', 2) == std::string::npos;
    const auto folderOf = [](const std::string& path) { return std::filesystem::path(path).parent_path(); };
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
    } else if (key_.starts_with("O ") || common) {
      for (const std::string& path : workspace_.beside(document_, project::InputKind::Nc))
        add(path);
    } else if (key_.starts_with("cycle ") && !prog) {
      for (const std::string& path : workspace_.beside(document_, project::InputKind::Cycle))
        add(path);
    }
    // What is open, too.
    for (const auto& [uri, other] : workspace_.documents()) {
      const bool isProg = workspace_.index(other).kind == std::optional(project::InputKind::Prog);
      const std::string folder = Workspace::unitOf(other.path);
      const bool sameCycle = prog && folder != other.path && (scope_.empty() || folderName(folder) == scope_);
      // Programs of another folder run on another machine, with variables of their own.
      const bool sameMachine = common && folderOf(other.path) == folderOf(document_.path);
      if (sameMachine || key_.starts_with("O ") || key_.starts_with("cycle ") ||
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

} // namespace

std::optional<Place> placeIn(Workspace& workspace, const Json& params) {
  Place out;
  out.document = &documentOf(workspace, params);
  out.index = &workspace.index(*out.document);
  if (out.index->file == kNoFile) return std::nullopt;
  out.offset = placeOf(workspace, *out.index, params);
  return out;
}

std::vector<Use> usesOf(Workspace& workspace, const Document& document, const Occurrence& one) {
  return Finder(workspace, document, one).uses();
}

} // namespace dotek::lsp
