// Values at which the checks of a cycle turn: both sides of a comparison are the same there.
#pragma once

#include "ir/Cycle.h"
#include "verify/Draw.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace dotek::verify {

// One comparison, met by changing one field.
struct Bound {
  std::size_t comparison = 0; // in the order of the checks
  std::size_t field = 0;      // index of the fields
};

class Bounds {
public:
  // The cycle with its checks; what they compare is shared, the rest is not kept.
  explicit Bounds(const ir::Cycle& cycle);

  // Those that some of the samples meet, the first `most` of them: each costs as much as the checks are long.
  // `roundsRadius`: as for meet().
  std::vector<Bound> find(const std::vector<DrawField>& fields, const std::vector<Case>& samples,
                          bool roundsRadius, std::uint64_t most) const;
  // The case with the field changed so that both sides are equal, for a control with eight digits, too: what
  // else they depend on is a multiple of a half then; of the ball's radius only where it may be changed.
  // nullopt: no such value was found.
  std::optional<Case> meet(const Bound& bound, const std::vector<DrawField>& fields, Case drawn,
                           bool roundsRadius) const;

  // Values of the field below and above that of a case that meets a bound: a step away. Where the checks
  // reject both, as one for whole numbers does, the nearest in wider steps of which they let one pass: the
  // other one is rejected by the comparison itself.
  std::array<double, 2> beside(const Case& met, const DrawField& field) const;

  // The checks, as they are translated, raise an alarm. What is not known of them rejects nothing.
  bool rejects(const Case& drawn) const;

private:
  struct Walk {
    bool alarm = false;
    std::optional<double> margin; // of the comparison that is wanted, where the checks come to it
  };
  static constexpr std::size_t kNone = SIZE_MAX;
  // What 1 more of one input does, of all that the checks read.
  struct Influence {
    std::vector<bool> open; // by VariableId: the checks may go another way, only a walk tells
    std::vector<std::pair<ir::VariableId, std::size_t>> changed; // the margin of the comparison, the way kept
  };
  // `wanted`: kNone: no comparison. `seen`: of every comparison, where the checks first come to it.
  Walk walk(std::size_t wanted, const Case& drawn, std::vector<std::optional<double>>* seen = nullptr,
            Influence* influence = nullptr) const;
  // Left less right where the checks come to the comparison; nothing: they do not, or it is not known.
  std::optional<double> margin(std::size_t comparison, const Case& drawn) const;
  // The other fields that the margin depends on, to a multiple of a half.
  void roundOthers(const Bound& bound, const std::vector<DrawField>& fields, double before,
                   Case& drawn) const;

  // The field that a variable of the checks is, by VariableId; kNone: none.
  std::vector<std::size_t> fieldsOf(const std::vector<DrawField>& fields) const;

  ir::Cycle cycle_;
  std::vector<ir::VariableId> inputs_;             // fields and host inputs that the checks read
  std::vector<std::vector<ir::VariableId>> reads_; // fields that a check reads, by the place of the check
  struct Compared {
    const ir::Comparison* comparison = nullptr;
    std::size_t statement = 0; // of the branch that holds it
  };
  std::vector<Compared> comparisons_;
  std::vector<std::size_t> places_; // of labels among the checks, by LabelId; kNone: it is not there
};

} // namespace dotek::verify
