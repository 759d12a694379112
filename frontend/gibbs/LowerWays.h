// How the ways of a walk hang together where equal states were made one: what comes after a message, and
// which statement set the code that a path ends with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

namespace dotek::frontend::gibbs {

// How paths end.
struct PathEnds {
  bool passes = false;
  bool rejects = false;
};

// Stretches of paths, from one place where paths part or meet to the next.
class Ways {
public:
  using Id = std::uint32_t;

  Id first() { return add(); }
  Id after(Id from);
  // A new dialog: what was shown on `from` is past, and lets the values pass.
  Id afterDialog(Id from);
  void join(Id from, Id to) { edges_.push_back({from, to, true}); }
  void shows(Id way, std::size_t message) { messages_.emplace_back(way, message); }
  void setsCode(Id way, std::size_t step) { codes_[way] = step; }
  void ends(Id way, bool rejects) { (rejects ? ends_[way].rejects : ends_[way].passes) = true; }
  // With the code that is asked for at step `place`.
  void rejectsByCode(Id way, std::size_t place) { rejected_[place].push_back(way); }

  // Adds to the ends of each message that was shown, by step.
  void endsBehind(std::map<std::size_t, PathEnds>& behind) const;
  // Adds the steps that set the code, kNowhere where none did, to those of each place.
  void codesOf(std::map<std::size_t, std::set<std::size_t>>& codes) const;

private:
  struct Edge {
    Id from = 0, to = 0;
    bool shown = true; // messages of `from` are not past
  };

  Id add();
  // The origins of the edges that lead to each way, those of way w from starts[w] on.
  void sortBack(bool shownOnly, std::vector<std::size_t>& starts, std::vector<Id>& origins) const;

  std::vector<Edge> edges_;
  std::vector<PathEnds> ends_;     // by way
  std::vector<std::size_t> codes_; // by way: the last step that set the code
  std::vector<std::pair<Id, std::size_t>> messages_;
  std::map<std::size_t, std::vector<Id>> rejected_; // by place
};

} // namespace dotek::frontend::gibbs
