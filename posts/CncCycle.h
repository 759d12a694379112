// A cycle of a `.cnc` job, between its two records.
#pragma once

#include "posts/CncJson.h"

#include <set>
#include <string>
#include <vector>

namespace dotek::posts::cnc {

// Cycles of holes, to which the engine adds what a job leaves out (docs/fusion-kernel.md): `holes` of
// stdlib/fusion/cycles.toml.
using HoleCycles = std::set<std::string, std::less<>>;

class CycleOfJob {
public:
  CycleOfJob(std::string type, const HoleCycles& holes) : type_(std::move(type)), holes_(&holes) {}

  bool hasPoints() const { return !points_.empty(); }
  const std::vector<Move>& points() const { return points_; }
  void add(const Named& value) { given_.push_back(value); }
  void add(const Move& point) { points_.push_back(point); }
  // What the post is given before onCycle, as records. Throws a text that says what is not known.
  std::vector<std::string> parameters();
  // The record, after parameters().
  std::string record();

private:
  void complete();

  std::string type_;
  const HoleCycles* holes_;
  std::vector<Named> given_;
  std::vector<Move> points_;
  Values values_;
};

} // namespace dotek::posts::cnc
