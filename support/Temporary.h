// A file that takes the place of another when it is complete.
#pragma once

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

// From now on SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGPIPE and SIGXCPU remove the temporary files of this
// process before they end it; one that is ignored stays so. For programs: a library leaves signals to who
// uses it.
void removeTemporariesOnSignals();

} // namespace dotek
