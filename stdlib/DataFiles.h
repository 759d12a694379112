// Where data files come from: embedded in the program, added or replaced by name from `--data DIR`.
#pragma once

#include "support/Diagnostics.h"
#include "support/Limits.h"
#include "support/Source.h"

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::stdlib {

// A data file does not load: place and reason are in the message ("forms/x.toml:3:1: unknown key `y`").
class DataError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

struct DataFile {
  std::string folder; // "forms"
  std::string name;   // the stem
  std::string origin; // "built in", or the path of the file
  std::string_view text;

  bool builtIn() const { return origin == "built in"; }
};

class DataFiles {
public:
  DataFiles(); // the embedded files
  // Adds every DIR/<folder>/<name>.toml, DIR/macrob/<name>.nc and DIR/cycles/<name>.cycle; one of an embedded
  // name replaces it. false with diagnostics where the folder cannot be read. Files that would be passed over
  // in silence are warnings.
  bool addFolder(const std::string& path, const Limits& limits, Diagnostics& diagnostics);

  const DataFile* find(std::string_view folder, std::string_view name) const; // nullptr: none
  std::vector<const DataFile*> list(std::string_view folder) const;           // sorted by name

private:
  std::vector<DataFile> files_;
  std::vector<std::unique_ptr<std::string>> loaded_;
};

} // namespace dotek::stdlib
