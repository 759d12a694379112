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
  // `program`, one that it calls, or one that is called with it asks for the variable.
  bool ask(const ir::Program& program, std::uint32_t variable) const;

private:
  std::map<const ir::Program*, std::size_t> group_; // joined by calls
  std::map<std::uint32_t, std::set<std::size_t>> asked_;
  std::set<std::size_t> open_;       // groups with a call that may lead to any program
  std::set<std::uint32_t> anywhere_; // asked for in those
};
const Askers& askersOf(const Project& project);

} // namespace dotek::lint
