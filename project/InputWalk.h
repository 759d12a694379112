// The inputs of a command that takes files and folders: a walk that ends whatever is linked to what.
#pragma once

#include "support/Diagnostics.h"

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace dotek::project {

// An input that was passed over, and why: "a link that leads out of the folder".
struct PassedOver {
  std::string path;
  std::string reason;
};

class InputWalk {
public:
  // Called for a folder before what is in it, for a file once, whatever its names. `named`: on the command
  // line.
  using Visit = std::function<void(const std::string& path, bool named)>;

  // `followLinks`: also those that lead out of the folder that was named. `most`: files that are visited.
  InputWalk(bool followLinks, std::size_t most, Visit folder, Visit file)
      : followLinks_(followLinks), most_(most), folder_(std::move(folder)), file_(std::move(file)) {}

  // A file is visited whatever it is. In a folder regular files are, in the order of their names; what begins
  // with a dot is left alone. With more than `most` files the walk ends and says so.
  void visit(const std::string& path, Diagnostics& diagnostics);

  bool ended() const { return found_ > most_; } // before it had visited all

  const std::vector<PassedOver>& passedOver() const { return passedOver_; }
  void passOver(const std::string& path, std::string reason) {
    passedOver_.push_back({path, std::move(reason)});
  }

private:
  void folder(const std::string& path, bool named, Diagnostics& diagnostics);
  void entry(const std::string& path, Diagnostics& diagnostics);
  void found(const std::string& path, bool named, Diagnostics& diagnostics);
  bool isNew(const std::string& path);
  // Without links. Of what is in a folder of the walk from the folder's: the whole path is long where folders
  // are deep.
  std::string real(const std::string& path);

  bool followLinks_;
  std::size_t most_, found_ = 0;
  std::size_t deep_ = 0; // folders that the walk is in
  Visit folder_, file_;
  std::string root_;                           // of the walk, without links
  std::set<std::string> visited_;              // without links
  std::map<std::string, std::string> folders_; // of the walk, without links
  std::vector<std::string> links_; // to what is in the folder: taken where the walk has not met it
  std::vector<PassedOver> passedOver_;
};

// "30 files checked, 4 excluded, 2 skipped (README.md: no language that Dotek reads; a, b, c and 4 more: an
// image; `--list-skipped` names each)". Names are printed without `folder`, where that is not empty. `all`:
// each is named, on a line of its own.
std::string walkSummary(std::size_t checked, std::size_t excluded, const std::vector<PassedOver>& passedOver,
                        const std::string& folder, bool all);

} // namespace dotek::project
