// Variables that programs look at: what they compare, and what they hand to others.
#pragma once

#include "ir/Program.h"
#include "lint/Project.h"

#include <cstdint>
#include <map>
#include <set>

namespace dotek::lint {

// In conditions and calls of the program. Those that only search for the greatest or the least of several are
// not looked at.
std::set<std::uint32_t> askedIn(const ir::Program& program);

// Which programs of the files ask for each variable, and which of them run together. Computed once a project.
class Askers {
public:
  explicit Askers(const Project& project);
  // A program that `program` calls, that calls it, or that is called with it asks for the variable.
  bool othersAsk(const ir::Program& program, std::uint32_t variable) const;

private:
  // Programs, as far as it matters whether there is another than a given one.
  struct Some {
    const ir::Program* first = nullptr;
    bool more = false;

    void add(const ir::Program& program) {
      more = more || (first != nullptr && first != &program);
      if (first == nullptr) first = &program;
    }
    bool hasOther(const ir::Program& program) const {
      return more || (first != nullptr && first != &program);
    }
  };
  struct Asked {
    Some all;
    Some anywhere; // in groups that are open
    std::map<std::size_t, Some> byGroup;
  };
  std::map<const ir::Program*, std::size_t> group_; // joined by calls
  std::set<std::size_t> open_;                      // groups with a call that may lead to any program
  std::map<std::uint32_t, Asked> asked_;
};
const Askers& askersOf(const Project& project);

} // namespace dotek::lint
