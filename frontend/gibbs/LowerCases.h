// Comparisons of one variable for equality after one another, as `if wrong = 1 .. if wrong = 2 ..`: where a
// path knows the value, it goes to the one that holds at once.
#pragma once

#include "frontend/gibbs/LowerFlat.h"

#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace dotek::frontend::gibbs {

class Cases {
public:
  Cases() = default;
  // Rows end before `heads`, the steps at which circles are noticed.
  Cases(const Flat& flat, const std::vector<bool>& heads);

  // The variable that `step` compares; nothing: the step is in no row.
  std::optional<ir::VariableId> variableAt(std::size_t step) const;
  // Where the path from `step` comes to a comparison that holds, or out of the row.
  std::size_t next(std::size_t step, double value);
  // Calls visit(step, jumps) for each step that paths have passed.
  void forPassed(const Flat& flat, const std::function<void(std::size_t, bool)>& visit) const;

private:
  struct Case {
    ir::VariableId variable = 0;
    double value = 0;
    bool jumps = false;       // where the values differ
    std::size_t follower = 0; // then, jumps aside
    std::size_t row = 0;
    std::size_t place = 0; // in its row
  };
  struct Row {
    std::vector<std::size_t> steps;
    std::vector<int> passed; // at each place: paths that begin less paths that end to pass there
  };

  static std::optional<Case> read(const Flat& flat, std::size_t step);

  std::map<std::size_t, Case> cases_; // by step
  std::vector<Row> rows_;
  std::map<std::pair<std::size_t, double>, std::vector<std::size_t>> places_; // by row and value, ascending
};

} // namespace dotek::frontend::gibbs
