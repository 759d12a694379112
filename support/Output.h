// What a command writes. Nothing here throws.
#pragma once

#include "support/Diagnostics.h"
#include "support/Temporary.h"

#include <memory>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace dotek {

struct WriteOptions {
  bool force = false; // replaces files that are write-protected
  // What `-` is; nullptr: the stream of the process. Its failure is its own state and no diagnostic.
  std::ostream* standardOutput = nullptr;
};

// One result. A file is complete or absent: it is written beside its place, and keeps the mode and, where the
// system allows, owner and group of the file that it replaces; links are followed. A pipe, a device and a
// stream of the process (`-`, /dev/fd/N) are written directly.
class Output {
public:
  // nullptr with a diagnostic where it cannot be made. A pipe waits for its reader.
  static std::unique_ptr<Output> open(const std::string& path, const WriteOptions& options,
                                      Diagnostics& diagnostics);
  // false with a diagnostic: open() would refuse the path as things are now. Waits for no reader.
  static bool check(const std::string& path, bool force, Diagnostics& diagnostics);
  ~Output(); // what was not placed is gone
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  void write(std::string_view bytes);
  // All that was written is on the disk, or with the reader; false with a diagnostic.
  bool finish(Diagnostics& diagnostics);
  // After finish(): the file takes its place; false with a diagnostic.
  bool place(Diagnostics& diagnostics);

private:
  explicit Output(std::string path) : path_(std::move(path)) {}
  void flush();
  void keepOwner();
  bool failed(int error, Diagnostics& diagnostics) const;

  std::string path_;   // as named
  std::string target_; // where links lead; "": a stream
  Temporary temporary_;
  int descriptor_ = -1;            // of a pipe or a device
  std::ostream* stream_ = nullptr; // of standard output
  std::string buffer_;
  int error_ = 0; // errno of the first failure
  struct Before {
    unsigned mode = 0, owner = 0, group = 0;
  };
  std::unique_ptr<Before> before_; // the file that is replaced
  bool otherOwner_ = false;        // than that file's
};

// Finishes all, then places all: none is placed where one cannot be finished.
bool placeAll(const std::vector<std::unique_ptr<Output>>& outputs, Diagnostics& diagnostics);

struct NamedText {
  std::string path;
  const std::string* text = nullptr;
};

// Writes texts, all or none where the system allows: files before pipes and streams, and no file is placed
// before those have taken theirs. `folder` is made where it is missing ("": none).
bool writeAll(const std::vector<NamedText>& texts, const std::string& folder, const WriteOptions& options,
              Diagnostics& diagnostics);

} // namespace dotek
