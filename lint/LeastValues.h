// How small the values of a cycle's fields can get that its checks let pass.
#pragma once

#include "lint/Project.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace dotek::lint {

// Reads the checks of CycleData.mac and of the macros that it calls (`if D < 2*r then goto again`), and what
// it computes from other fields (`T = 2*D`). What is written in another way bounds nothing.
class LeastValues {
public:
  // Both outlive it.
  LeastValues(const gibbs::Cycle& cycle, const Project& project);
  // Of a variable by its folded name; minus infinity: as small as one likes.
  double of(const std::string& variable) const;

private:
  // A sum of variables, each with a factor, and a number.
  struct Sum {
    std::map<std::string, double> factors;
    double number = 0;
    bool known = true; // it is such a sum
  };
  // What the call gives to the names after ARGS that the macro leaves as they come.
  std::map<std::string, Sum> argumentsOf(const gibbs::CallMacro& call, const gibbs::Macro& macro) const;
  // `decide`: variables that decide whether the value is rejected; `given`: what the macro's names stand for.
  void readChecks(const gibbs::Macro& macro, const std::set<std::string>& decide,
                  const std::map<std::string, Sum>& given);
  static Sum without(Sum sum, const Sum& other, double times);
  Sum sumOf(const gibbs::Expression& expression, int depth) const;
  double least(const Sum& sum, int depth) const;
  double leastOf(const std::string& variable, int depth) const;

  std::set<std::string> radii_;                              // of the tool: never below 0
  std::map<std::string, const gibbs::Expression*> computed_; // once, in any case
  std::vector<Sum> kept_;                                    // never below 0, by a check
};

} // namespace dotek::lint
