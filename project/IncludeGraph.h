// Which macros #INCLUDE which.
#pragma once

#include "frontend/gibbs/Ast.h"
#include "support/Diagnostics.h"
#include "support/Limits.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace dotek::project {

// Each file is looked at once, however many others include it, so the cost grows with the #INCLUDE lines and
// not with the paths through them.
class IncludeGraph {
public:
  // The macro that an #INCLUDE at `where` names; nullptr: there is none, reported.
  using Load = std::function<const frontend::gibbs::Macro*(const std::string& file, SourceRange where)>;

  IncludeGraph(Load load, const Limits& limits, Diagnostics& diagnostics)
      : load_(std::move(load)), limits_(limits), diagnostics_(diagnostics) {}

  // The files that `macro` includes, directly and through others, each once and without itself, in the order
  // in which they are met. Files that include themselves and nesting beyond `--limit include-depth` are
  // reported, a file and a line once.
  std::vector<const frontend::gibbs::Macro*> includedBy(const frontend::gibbs::Macro& macro);

private:
  struct Edge {
    SourceRange where;
    const frontend::gibbs::Macro* to = nullptr;
  };
  struct Node {
    std::vector<Edge> edges;  // without those that close a loop
    std::uint32_t height = 0; // the longest chain of includes from here
    bool open = false;        // on the path that is explored
    bool inLoop = false;
  };
  struct Step { // of the exploration: a file, and its #INCLUDE lines that are left
    FileId file = kNoFile;
    std::vector<const frontend::gibbs::Include*> lines;
    std::size_t next = 0;
  };

  void explore(const frontend::gibbs::Macro& macro);
  void enter(const frontend::gibbs::Macro& macro);
  void follow(const frontend::gibbs::Include& include);
  void closeLoop(const frontend::gibbs::Include& include, FileId to);
  void checkDepth(FileId file);

  Load load_;
  const Limits& limits_;
  Diagnostics& diagnostics_;
  std::map<FileId, Node> nodes_;
  std::vector<Step> path_;
  std::set<std::pair<FileId, std::uint32_t>> tooDeep_; // places that were reported
};

} // namespace dotek::project
