// Files that take the place of others when they are complete, and folders of files that are gone at the end.
#pragma once

#include <deque>
#include <string>

namespace dotek {

// A new file in a folder: created exclusively, under a name that nobody can plant. Gone with this object
// unless rename() succeeded, and on the signals of removeTemporariesOnSignals().
class Temporary {
public:
  Temporary() = default;
  ~Temporary();
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  // 0, or the errno of the failure. `mode` as of open(2): the umask takes bits away.
  int create(const std::string& folder, unsigned mode);
  int descriptor() const { return descriptor_; } // for writing; -1 after close()
  int sync();                                    // onto the disk, where the file system can
  int close();
  // Takes the place of `path` in its folder; the folder is synced too.
  int rename(const std::string& path);

private:
  int descriptor_ = -1;
  std::string folder_, path_; // path_ "": there is none any more
};

// A new folder below that of the system's temporary files, for its owner alone. Gone with this object with
// all that write() has put into it, and on the same signals.
class TemporaryFolder {
public:
  TemporaryFolder() = default;
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  // false: it cannot be made.
  bool create();
  const std::string& path() const { return path_; } // "": there is none
  // A file in it, "NAME" or "FOLDER/NAME". false: it cannot be written.
  bool write(const std::string& name, const std::string& text);

private:
  const std::string& keep(std::string path); // before it is there
  std::string path_;
  std::deque<std::string> made_; // folders before what is in them
};

// From now on SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGPIPE and SIGXCPU remove the temporary files of this
// process before they end it; one that is ignored stays so. For programs: a library leaves signals to who
// uses it.
void removeTemporariesOnSignals();

// While one lives those signals wait: files that belong together take their places together.
class SignalHold {
public:
  SignalHold();
  ~SignalHold();
  SignalHold(const SignalHold&) = delete;
  SignalHold& operator=(const SignalHold&) = delete;
};

} // namespace dotek
