// Draws values for a case: parameters, host inputs, the place of the part. The rule is in docs/verify.md.
#pragma once

#include "ir/Kind.h"
#include "verify/DrawnPath.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dotek::verify {

class Bounds;
class Random;

// A parameter of the cycle.
struct DrawField {
  std::string name; // as the source spells it
  ir::Kind kind = ir::Kind::Number;
  std::optional<double> initial;  // of DefineData.txt
  int decimals = 3;               // that the field's picture prints; 0 to 9
  std::vector<double> thresholds; // constants that the checks compare it with
  std::vector<double> choices;    // that the dialog offers; empty: any number
  double firstSystem = 54;        // of a work offset: the number that is G54
  std::vector<double> extended;   // of a work offset: numbers beside those that stand for G54.1 Pn
  bool extendedAlone = false;     // the six are not offered
  double most = std::numeric_limits<double>::infinity(); // of a tool offset: the last that the controls have
  std::optional<double> fixed;                           // by --set or the job: always this
  std::optional<double> usual;                           // what it says of the surfaces of the path
  bool decides = false;                                  // questions of the cycle's body depend on it

  // Of a work offset the G code that the value is: 54 to 59; 0: none of them.
  std::uint32_t systemOf(double value) const {
    const double code = value - firstSystem + 54;
    return code >= 54 && code <= 59 ? static_cast<std::uint32_t>(code) : 0;
  }
};

struct Case {
  std::map<std::string, double> values; // by name of the field; multiples of the picture's last place
  std::map<std::string, double> hosts;  // tool_radius, clearance, retract, start_x, start_y, start_z, ...
  std::uint32_t system = 54;            // active at entry: 54 to 59
  std::uint32_t toolOffset = 1;         // that of the probe, in force at entry
  std::map<std::uint32_t, double> variables; // common ones that a posted program reads and nobody writes
  PartError error;
  bool edge = false;        // edge and illegal values
  bool callers = false;     // it is also called by those who break what the translation demands
  std::uint64_t stream = 0; // seed of what settleHosts() draws
};

class Draws {
public:
  // `hosts`: names that are drawn; `fixedHosts`: given ones, which every case has. edge() is asked for fewer
  // than `edges`.
  Draws(std::vector<DrawField> fields, std::vector<std::string> hosts,
        std::map<std::string, double> fixedHosts, std::uint64_t seed,
        std::shared_ptr<const Bounds> bounds = nullptr, std::uint64_t edges = UINT64_MAX);

  // The `attempt`-th proposal for case `index`: the same arguments give the same case, whatever ran before.
  // It may be illegal or out of reach; the caller asks for further attempts. What is drawn for a name does
  // not depend on the other names.
  Case propose(std::uint64_t index, std::uint32_t attempt) const;
  // Hosts that depend on the path, once it is known without them: `clearance` between its two highest levels,
  // `start_z` above all; they stay where they are fixed or not drawn. Also keeps the part's error so small
  // that the ball finds the surface. The path begins at `start_z`: compute it again afterwards.
  void settleHosts(Case& drawn, const DrawnPath& path) const;
  // An edge case: values at which comparisons of the checks turn, one step beside them, at the thresholds, 0,
  // illegal systems, the largest value that the picture prints, values at the ball's radius and diameter, the
  // active system as the one that is set. Each of these comes once for each field, then again beside another
  // one. Its hosts are settled like others.
  Case edge(std::uint64_t index) const;

  const std::vector<DrawField>& fields() const { return fields_; }

private:
  // What an edge case does to a field.
  struct Edge {
    enum class Means : std::uint8_t {
      Value,  // the field gets `value`
      Radius, // the ball's radius times `value`, plus `steps` of the field
      System, // `value`, which is the active system, too
      Bound,  // where a comparison turns, or beside it: below, or above, by `steps`
    };
    std::size_t field = 0;
    Means means = Means::Value;
    double value = 0;
    int steps = 0;
    std::size_t comparison = 0; // of a Bound
  };
  std::vector<Edge> edgesOf(std::size_t field, std::uint64_t most) const; // the first ones
  std::vector<Edge> boundEdges(std::uint64_t most) const;
  void apply(const Edge& edge, Case& drawn) const;
  double value(std::size_t index, bool near, std::uint32_t attempt, Random& random) const; // of a field
  void drawSystem(Case& drawn, Random& random) const;
  bool isDrawn(const char* host) const;

  struct Name {
    std::size_t index = 0;
    std::uint64_t hash = 0;
  };
  std::vector<DrawField> fields_;
  std::vector<std::string> hosts_;
  std::map<std::string, double> fixedHosts_;
  std::uint64_t seed_;
  std::shared_ptr<const Bounds> bounds_;        // nullptr: not known
  std::vector<Name> fieldNames_, hostNames_;    // in the order of their names
  std::vector<std::vector<double>> thresholds_; // of each field, those of use for a length, ascending
  std::vector<Edge> edges_;
};

} // namespace dotek::verify
