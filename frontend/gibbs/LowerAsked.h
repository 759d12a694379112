// What the conditions of flat code can still ask. States that no later condition tells apart go on in the
// same way, so that a walk keeps one of them.
#pragma once

#include "frontend/gibbs/LowerFlat.h"
#include "frontend/gibbs/Value.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace dotek::frontend::gibbs {

// The numbers that steps compare one quantity with.
class AskedBounds {
public:
  void add(double bound, std::size_t step) { asked_.emplace_back(bound, step); }
  void finish();

  // The part of all numbers that holds `value`: steps from `from` on treat the numbers of one part alike.
  // Numbers of parts ascend with the numbers in them.
  std::uint32_t partOf(double value, std::size_t from) const { return part(below(value, true), value, from); }
  std::uint32_t lowestOf(const Range& range, std::size_t from) const;
  std::uint32_t highestOf(const Range& range, std::size_t from) const;
  std::uint32_t last(std::size_t from) const { return part(asked_.size(), std::nullopt, from); }
  // A step from `from` on compares with just this number.
  bool isAsked(double bound, std::size_t from) const;

private:
  // How many bounds are below `value`, or at most `value`.
  std::size_t below(double value, bool itself) const;
  // Of what is above the first `count` bounds; `value` may be the greatest of them.
  std::uint32_t part(std::size_t count, std::optional<double> value, std::size_t from) const;

  std::vector<std::pair<double, std::size_t>> asked_; // ascending, with the last step
  std::vector<std::size_t> latest_;                   // a tree over `asked_`: the greatest last step below
  std::size_t leaves_ = 1;
};

class Asked {
public:
  // The question that a comparison asks whatever path leads to it; nothing: none, or not always the same.
  using QuestionOf = std::function<std::optional<Question>(const ir::Comparison&)>;

  // `constant`: variables that no step changes, each with a value.
  Asked(const Flat& flat, const std::vector<bool>& constant, const QuestionOf& questionOf);

  // No path from `at` comes to a step before this one.
  std::size_t from(std::size_t at) const { return from_[at]; }
  // The bounds of a variable that steps from `from` on do no more with than compare it with numbers;
  // nullptr: they do more.
  const AskedBounds* ofVariable(ir::VariableId variable, std::size_t from) const;
  // The steps from `from` on read the variable in other ways than the questions of `ofQuantity` tell.
  bool isReadFrom(ir::VariableId variable, std::size_t from) const { return otherwise_[variable] > from; }
  // By the key of questions. Without bounds: nothing asks for it.
  const AskedBounds& ofQuantity(const std::string& key) const;

private:
  void condition(const ir::ConditionPtr& condition, std::size_t step, const QuestionOf& questionOf);
  void comparison(const ir::Comparison& comparison, std::size_t step, const QuestionOf& questionOf);
  template <class Node> void others(const Node& node, std::size_t step);
  void findFrom(const Flat& flat);

  const std::vector<bool>& constant_;
  std::vector<std::size_t> from_;      // by step
  std::vector<std::size_t> otherwise_; // by variable: one above the last step that reads it otherwise
  std::vector<AskedBounds> variables_;
  std::unordered_map<std::string, AskedBounds> quantities_;
};

} // namespace dotek::frontend::gibbs
