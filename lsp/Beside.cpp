// Files around a document that are not open: of its cycle, of its folder, the post that prints its cycle.
#include "lsp/Workspace.h"
#include "project/CycleFolder.h"
#include "project/Settings.h"

#include <algorithm>

namespace dotek::lsp {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostFiles = 300; // of a folder that are looked into
constexpr std::uintmax_t kMostBytesBeside = 4u << 20;

// Regular files of a folder by name, hidden ones left out.
std::vector<std::string> filesOf(const std::string& folder) {
  std::vector<std::string> out;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.is_regular_file(error) && entry.file_size(error) <= kMostBytesBeside &&
        !entry.path().filename().string().starts_with('.'))
      out.push_back(entry.path().generic_string());
  std::sort(out.begin(), out.end());
  if (out.size() > kMostFiles) out.resize(kMostFiles);
  return out;
}

std::string folderOf(const std::string& path) {
  return fs::path(path).parent_path().generic_string();
}

} // namespace

const Index& Workspace::indexOf(const std::string& path) {
  if (buffers_->contains(path)) {
    std::unique_ptr<Index>& index = indices_[path];
    if (index == nullptr) index = std::make_unique<Index>(makeIndex(path, options({unitOf(path)})));
    return *index;
  }
  std::error_code error;
  const auto time = fs::last_write_time(path, error);
  const std::uintmax_t size = fs::file_size(path, error);
  OnDisk& known = onDisk_[path];
  if (known.index == nullptr || known.time != time || known.size != size)
    known = {time, size, std::make_unique<Index>(makeIndex(path, options({unitOf(path)})))};
  return *known.index;
}

std::vector<std::string> Workspace::companions(const Document& document) const {
  const std::string unit = unitOf(document.path);
  if (unit == document.path) return {};
  std::vector<std::string> out = filesOf(unit);
  std::erase(out, document.path);
  return out;
}

std::vector<std::string> Workspace::beside(const Document& document, project::InputKind kind) {
  std::vector<std::string> out = filesOf(folderOf(document.path));
  std::erase_if(out, [&](const std::string& path) {
    return path == document.path || indexOf(path).kind != std::optional(kind);
  });
  return out;
}

std::vector<std::string> Workspace::cycleFolders(const std::string& path) {
  std::vector<std::string> out;
  const fs::path folder = fs::path(path).parent_path();
  for (const fs::path& where : {folder, folder.parent_path()}) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(where, error))
      if (out.size() < kMostFiles && entry.is_directory(error) && project::isCycleFolder(entry.path()))
        out.push_back(entry.path().generic_string());
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::string Workspace::postOf(const std::string& path) {
  const std::optional<std::string> prog = project::flagDefaultsOf({unitOf(path)}).prog;
  if (!prog) return "";
  std::error_code error;
  return fs::absolute(*prog, error).lexically_normal().generic_string();
}

std::vector<std::string> Workspace::inputsOf(const std::string& unit) {
  std::vector<std::string> out{unit};
  const std::string post = postOf(unit);
  std::error_code error;
  if (post.empty() || !fs::is_regular_file(post, error)) return out;
  if (fs::is_directory(unit, error)) {
    out.push_back(post);
  } else if (unit == post) {
    for (std::string& folder : cycleFolders(unit))
      if (postOf(folder) == post) out.push_back(std::move(folder));
  }
  return out;
}

} // namespace dotek::lsp
