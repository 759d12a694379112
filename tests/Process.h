// The built program as a process of its own: for signals, full disks and closed streams, which no test in
// this process can show.
#pragma once

#include <filesystem>
#include <string>

namespace dotek::tests {

struct ShellResult {
  int status = 0; // as bash gives it: 128 + N where signal N ended the last command
  std::string out, err;
};

// A folder of its own, gone at the end, in which scripts of bash run; `dotek` in them is the built program.
class ProcessFolder {
public:
  ProcessFolder();
  ~ProcessFolder();
  ProcessFolder(const ProcessFolder&) = delete;
  ProcessFolder& operator=(const ProcessFolder&) = delete;

  ShellResult run(const std::string& script) const;
  void write(const std::string& name, const std::string& bytes) const;
  std::string read(const std::string& name) const;
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  // Names in the folder, hidden ones too, sorted, each followed by a blank.
  std::string names() const;

private:
  std::filesystem::path folder_, streams_;
};

// Permissions do not bind root.
bool isRoot();

} // namespace dotek::tests
