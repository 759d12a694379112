// Draws values for a case: parameters, host inputs, the place of the part. The rule stands in docs/verify.md.
#pragma once

#include "ir/Kind.h"
#include "verify/DrawnPath.h"

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dotek::verify {

// A parameter of the cycle.
struct DrawField {
  std::string name; // as the source spells it
  ir::Kind kind = ir::Kind::Number;
  std::optional<double> initial;  // of DefineData.txt
  int decimals = 3;               // that the field's picture prints
  std::vector<double> thresholds; // constants that the checks compare it with
  std::optional<double> fixed;    // by --set or the job: always this
};

struct Case {
  std::map<std::string, double> values; // by name of the field; multiples of the picture's last place
  std::map<std::string, double> hosts;  // tool_radius, clearance, retract, start_x, start_y, start_z, ...
  std::uint32_t system = 54;            // active at entry: 54 to 59
  PartError error;
  bool edge = false; // edge and illegal values
};

class Draws {
public:
  // `hosts`: names that are drawn; `fixedHosts`: given ones. `mayBeIllegal`: what the case `index` of edge
  // cases is about.
  Draws(std::vector<DrawField> fields, std::vector<std::string> hosts,
        std::map<std::string, double> fixedHosts, std::uint64_t seed);

  // The `attempt`-th proposal for case `index`: the same arguments give the same case, whatever ran before.
  // It may be illegal or out of reach; the caller asks for further attempts.
  Case propose(std::uint64_t index, std::uint32_t attempt) const;
  // Hosts that hang on the path, once it is known without them: clearance, start_z, retract stay as proposed
  // where they are fixed.
  void settleHosts(Case& drawn, const DrawnPath& path) const;
  // An edge case: values at the thresholds, one step beside them, 0, illegal systems, the largest value that
  // the picture prints, the active system as the one that is set.
  Case edge(std::uint64_t index) const;

  const std::vector<DrawField>& fields() const { return fields_; }

private:
  std::vector<DrawField> fields_;
  std::vector<std::string> hosts_;
  std::map<std::string, double> fixedHosts_;
  std::uint64_t seed_;
};

} // namespace dotek::verify
