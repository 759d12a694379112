#include "support/Output.h"

#include "support/FileIdentity.h"
#include "support/Files.h"
#include "support/Stream.h"
#include "support/messages/Common.h"
#include "support/messages/Output.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <map>
#include <sys/stat.h>
#include <unistd.h>

namespace dotek {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kBuffer = 256 * 1024;
constexpr unsigned kModeBits = 07777;

// root may write anything, so its answer is in the mode.
bool isProtected(const std::string& path, unsigned mode) {
  return (mode & 0222) == 0 || ::faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) != 0;
}

std::string folderOf(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

// What is at a path that shall be written.
struct Target {
  bool exists = false, isStream = false;
  struct stat status {};
  std::string path; // where links lead
};

// 0, or the errno of what will fail.
int look(const std::string& path, Target& target) {
  target.exists = ::stat(path.c_str(), &target.status) == 0;
  if (!target.exists && errno != ENOENT) return errno;
  if (target.exists && S_ISDIR(target.status.st_mode)) return EISDIR;
  target.isStream = target.exists && !S_ISREG(target.status.st_mode);
  if (target.isStream) return 0;
  target.path = followed(path);
  if (fs::path(target.path).filename().empty()) return ENOENT;
  return ::faccessat(AT_FDCWD, folderOf(target.path).c_str(), W_OK | X_OK, AT_EACCESS) == 0 ? 0 : errno;
}

bool refuses(const std::string& path, const Target& target, bool force, Diagnostics& diagnostics) {
  if (force || !target.exists || target.isStream || !isProtected(path, target.status.st_mode)) return false;
  diagnostics.report<diag::OutputProtected>({}, path);
  return true;
}

// What results are called is known only now, so they can meet one another or what a flag names.
bool areApart(const std::vector<NamedText>& texts, Diagnostics& diagnostics) {
  std::map<FileIdentity, const std::string*> taken;
  for (const NamedText& one : texts) {
    const auto file = descriptorOf(one.path) < 0 ? identify(one.path) : std::nullopt;
    if (!file) continue;
    const auto [before, isNew] = taken.emplace(*file, &one.path);
    if (isNew) continue;
    diagnostics.report<diag::OutputGivenTwice>(
        {}, *before->second == one.path ? "another result" : "`" + *before->second + "`",
        "`" + one.path + "`");
    return false;
  }
  return true;
}

bool placeFinished(const std::vector<std::unique_ptr<Output>>& outputs, Diagnostics& diagnostics) {
  const SignalHold together;
  return std::all_of(outputs.begin(), outputs.end(),
                     [&](const auto& one) { return one->place(diagnostics); });
}

// Folders that are made for results; gone again, where they are empty, unless they are kept.
class NewFolders {
public:
  NewFolders() = default;
  ~NewFolders() {
    for (auto at = made_.rbegin(); at != made_.rend(); ++at)
      ::rmdir(at->c_str());
  }
  NewFolders(const NewFolders&) = delete;
  NewFolders& operator=(const NewFolders&) = delete;

  void create(const fs::path& path, std::error_code& error) {
    std::vector<std::string> missing; // the innermost first
    for (fs::path at = path; !at.empty() && !fs::exists(at, error) && !error; at = at.parent_path())
      missing.push_back(at.string());
    fs::create_directories(path, error);
    made_.insert(made_.end(), missing.rbegin(), missing.rend());
  }
  void keep() { made_.clear(); }

private:
  std::vector<std::string> made_; // the outermost first
};

} // namespace

bool Output::check(const std::string& path, bool force, Diagnostics& diagnostics) {
  if (descriptorOf(path) >= 0) return true;
  Target target;
  if (const int error = look(path, target); error != 0) return Output(path).failed(error, diagnostics);
  return !refuses(path, target, force, diagnostics);
}

bool Output::failed(int error, Diagnostics& diagnostics) const {
  // Who gave the stream sees for itself that it failed.
  if (stream_ == nullptr) diagnostics.report<diag::FileNotWritable>({}, path_, std::strerror(error));
  return false;
}

std::unique_ptr<Output> Output::open(const std::string& path, const WriteOptions& options,
                                     Diagnostics& diagnostics) {
  std::unique_ptr<Output> out(new Output(path));
  const int descriptor = descriptorOf(path);
  if (descriptor == STDOUT_FILENO && options.standardOutput != nullptr) {
    out->stream_ = options.standardOutput;
    return out;
  }
  Target target;
  int error = 0;
  if (descriptor >= 0) {
    out->descriptor_ = ::fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
    error = out->descriptor_ < 0 ? errno : 0;
  } else if (error = look(path, target); error == 0 && target.isStream) {
    out->descriptor_ = ::open(path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
    error = out->descriptor_ < 0 ? errno : 0;
  } else if (error == 0) {
    if (refuses(path, target, options.force, diagnostics)) return nullptr;
    const struct stat& old = target.status;
    if (target.exists)
      out->before_ = std::make_unique<Before>(Before{old.st_mode & kModeBits, old.st_uid, old.st_gid});
    out->target_ = target.path;
    // Of a file that is replaced nobody else reads the new one before it has its mode.
    error = out->temporary_.create(folderOf(target.path), target.exists ? 0600 : 0666);
  }
  if (error == 0) return out;
  out->failed(error, diagnostics);
  return nullptr;
}

Output::~Output() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void Output::write(std::string_view bytes) {
  if (stream_ != nullptr) {
    *stream_ << bytes;
    return;
  }
  buffer_ += bytes;
  if (buffer_.size() >= kBuffer) flush();
}

void Output::flush() {
  if (error_ == 0) error_ = writeFully(!target_.empty() ? temporary_.descriptor() : descriptor_, buffer_);
  buffer_.clear();
}

void Output::keepOwner() {
  unsigned mode = before_->mode;
  const int descriptor = temporary_.descriptor();
  struct stat now {};
  const bool known = ::fstat(descriptor, &now) == 0;
  const bool same = known && now.st_uid == before_->owner && now.st_gid == before_->group;
  if (!same && ::fchown(descriptor, before_->owner, before_->group) != 0) {
    // The group alone can often be kept. Who runs as the owner runs as another one now.
    const bool group = ::fchown(descriptor, static_cast<uid_t>(-1), before_->group) == 0;
    mode &= ~static_cast<unsigned>(S_ISUID | (group ? 0 : S_ISGID));
    otherOwner_ = true;
  }
  if (::fchmod(descriptor, mode) != 0 && error_ == 0) error_ = errno;
}

bool Output::finish(Diagnostics& diagnostics) {
  if (stream_ != nullptr) {
    const int error = finishStream(*stream_);
    return error == 0 || failed(error, diagnostics);
  }
  flush();
  if (!target_.empty() && error_ == 0) {
    if (before_) keepOwner();
    if (error_ == 0) error_ = temporary_.sync();
    const int closed = temporary_.close();
    if (error_ == 0) error_ = closed;
  } else if (descriptor_ >= 0) {
    if (::close(std::exchange(descriptor_, -1)) != 0 && error_ == 0) error_ = errno;
  }
  return error_ == 0 || failed(error_, diagnostics);
}

bool Output::place(Diagnostics& diagnostics) {
  if (target_.empty()) return true;
  if (const int error = temporary_.rename(target_); error != 0) return failed(error, diagnostics);
  if (otherOwner_) diagnostics.report<diag::OutputOwner>({}, path_);
  return true;
}

bool placeAll(const std::vector<std::unique_ptr<Output>>& outputs, Diagnostics& diagnostics) {
  return std::all_of(outputs.begin(), outputs.end(),
                     [&](const auto& one) { return one->finish(diagnostics); }) &&
         placeFinished(outputs, diagnostics);
}

bool writeAll(const std::vector<NamedText>& texts, const std::string& folder, const WriteOptions& options,
              Diagnostics& diagnostics) {
  std::error_code error;
  NewFolders made; // outlives the files in them
  if (!folder.empty()) made.create(folder, error);
  if (error) {
    diagnostics.report<diag::FileNotWritable>({}, folder, error.message());
    return false;
  }
  if (!areApart(texts, diagnostics)) return false;
  for (const NamedText& one : texts) { // a name may have a folder of its own
    const fs::path parent = fs::path(one.path).parent_path();
    if (folder.empty() || !isBelow(parent.string(), folder) || descriptorOf(one.path) >= 0) continue;
    made.create(parent, error);
    if (!error) continue;
    diagnostics.report<diag::FileNotWritable>({}, parent.string(), error.message());
    return false;
  }
  std::vector<const NamedText*> order;
  for (const NamedText& one : texts)
    order.push_back(&one);
  std::stable_partition(order.begin(), order.end(), [](const NamedText* one) {
    std::error_code ignored;
    return descriptorOf(one->path) < 0 && !fs::is_other(fs::status(one->path, ignored));
  });
  std::vector<std::unique_ptr<Output>> outputs;
  for (const NamedText* one : order) {
    outputs.push_back(Output::open(one->path, options, diagnostics));
    if (!outputs.back()) return false;
    outputs.back()->write(*one->text);
    if (!outputs.back()->finish(diagnostics)) return false;
  }
  if (!placeFinished(outputs, diagnostics)) return false;
  made.keep();
  return true;
}

} // namespace dotek
