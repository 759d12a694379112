#include "project/InputWalk.h"

#include "support/Files.h"
#include "support/Printable.h"
#include "support/messages/Commands.h"
#include "support/messages/Common.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <system_error>
#include <utility>

namespace dotek::project {

namespace fs = std::filesystem;

namespace {

// Folders one in another: the system goes through all above it to reach an entry, so that n of them take n *
// n steps.
constexpr std::size_t kDeepest = 200;

// The one name of a file; the path as it is where the system does not say.
std::string canonical(const std::string& path) {
  std::error_code error;
  const fs::path real = fs::canonical(path, error);
  return error ? path : real.generic_string();
}

} // namespace

bool InputWalk::isNew(const std::string& path) {
  return visited_.insert(real(path)).second;
}

std::string InputWalk::real(const std::string& path) {
  const fs::path whole(path);
  std::error_code error;
  const auto folder = folders_.find(whole.parent_path().generic_string());
  if (folder == folders_.end() || !whole.has_filename() || fs::is_symlink(fs::symlink_status(path, error)))
    return canonical(path);
  return (fs::path(folder->second) / whole.filename()).generic_string();
}

void InputWalk::visit(const std::string& path, Diagnostics& diagnostics) {
  std::error_code error;
  if (path == "-" || !fs::is_directory(path, error)) {
    if (isStream(path) || isNew(path)) found(path, true, diagnostics);
    return;
  }
  root_ = canonical(path);
  folder(path, true, diagnostics);
  for (std::size_t i = 0; i < links_.size(); ++i) { // the list may grow
    const std::string link = links_[i];
    if (fs::is_directory(link, error))
      folder(link, false, diagnostics);
    else if (isNew(link))
      found(link, false, diagnostics);
  }
  links_.clear();
}

void InputWalk::found(const std::string& path, bool named, Diagnostics& diagnostics) {
  if (found_++ < most_)
    file_(path, named);
  else if (found_ == most_ + 1)
    diagnostics.report<diag::TooManyFiles>({}, most_);
}

void InputWalk::folder(const std::string& path, bool named, Diagnostics& diagnostics) {
  if (found_ > most_ || !isNew(path)) return;
  folders_.emplace(path, real(path));
  folder_(path, named);
  std::error_code error;
  std::vector<fs::path> entries;
  for (fs::directory_iterator at(path, error), end; !error && at != end; at.increment(error))
    entries.push_back(at->path());
  if (error) diagnostics.report<diag::FileNotReadable>({}, path, error.message());
  std::sort(entries.begin(), entries.end());
  ++deep_;
  for (const fs::path& one : entries)
    if (found_ <= most_ && !one.filename().string().starts_with('.'))
      entry(one.generic_string(), diagnostics);
  --deep_;
}

void InputWalk::entry(const std::string& path, Diagnostics& diagnostics) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  const bool link = fs::is_symlink(fs::symlink_status(path, error));
  if (link && !fs::exists(status)) {
    passOver(path, "a link to nothing");
  } else if (link && !followLinks_ && !isBelow(canonical(path), root_)) {
    passOver(path, "a link that leads out of the folder; `--follow-links` follows it");
  } else if (link && (fs::is_directory(status) || fs::is_regular_file(status))) {
    links_.push_back(path);
  } else if (fs::is_directory(status) && deep_ > kDeepest) {
    passOver(path, fmt::format("more than {} folders deep", kDeepest));
  } else if (fs::is_directory(status)) {
    folder(path, false, diagnostics);
  } else if (fs::is_regular_file(status)) {
    if (isNew(path)) found(path, false, diagnostics);
  } else {
    passOver(path, error ? "the system does not reach it: " + error.message() : "no regular file");
  }
}

std::string walkSummary(std::size_t checked, std::size_t excluded, const std::vector<PassedOver>& passedOver,
                        const std::string& folder, bool all) {
  constexpr std::size_t kNames = 3; // of one reason
  std::string out = fmt::format("{} file{} checked", checked, checked == 1 ? "" : "s");
  if (excluded > 0) out += fmt::format(", {} excluded by dotek.toml", excluded);
  if (passedOver.empty()) return out;
  std::vector<std::pair<std::string, std::vector<std::string>>> reasons; // in the order of their first file
  for (const PassedOver& one : passedOver) {
    auto at =
        std::find_if(reasons.begin(), reasons.end(), [&](const auto& r) { return r.first == one.reason; });
    if (at == reasons.end()) at = reasons.insert(at, {one.reason, {}});
    const bool inside = !folder.empty() && one.path.starts_with(folder + "/");
    at->second.push_back(printable(inside ? one.path.substr(folder.size() + 1) : one.path));
  }
  std::string list;
  bool cut = false;
  for (const auto& [reason, names] : reasons) {
    if (all) {
      for (const std::string& name : names)
        list += "\n  " + name + ": " + reason;
      continue;
    }
    cut = cut || names.size() > kNames;
    list += list.empty() ? "" : "; ";
    for (std::size_t i = 0; i < std::min(names.size(), kNames); ++i)
      list += (i == 0 ? "" : ", ") + names[i];
    if (names.size() > kNames) list += fmt::format(" and {} more", names.size() - kNames);
    list += ": " + reason;
  }
  if (all) return out + fmt::format(", {} skipped:{}", passedOver.size(), list);
  if (cut) list += "; `--list-skipped` names each";
  return out + fmt::format(", {} skipped ({})", passedOver.size(), list);
}

} // namespace dotek::project
