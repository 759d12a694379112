// Called cycles that become programs of their own. A cycle is lowered with all that it calls in its place, so
// that what is refused or asked for before anything moves does not depend on how a call is written. Then what
// such a call came to is taken out again; the called cycle is lowered by itself.
#include "frontend/cycle/Link.h"
#include "frontend/cycle/Lowering.h"
#include "frontend/cycle/Walk.h"
#include "ir/Walk.h"

#include <algorithm>
#include <utility>

namespace dotek::frontend::cycle {
namespace {

// `seen`: files that were looked at.
bool moves(const File& file, std::set<const File*>& seen) {
  if (!seen.insert(&file).second) return false;
  bool out = false;
  eachStatement(file.body, [&](const Statement& one) {
    out = out || std::holds_alternative<Move>(one.node) || std::holds_alternative<Touch>(one.node);
    const auto* call = std::get_if<Call>(&one.node);
    if (!out && call != nullptr && call->called != nullptr) out = moves(*call->called, seen);
  });
  return out;
}

bool moves(const File& file) {
  std::set<const File*> seen;
  return moves(file, seen);
}

// Levels of programs that the calls of the file are.
std::uint32_t levelsOf(const File& file, std::uint32_t most) {
  std::uint32_t out = 0;
  if (most == 0) return 0;
  for (const Call* const call : callsOf(file.body))
    if (call->called != nullptr && moves(*call->called))
      out = std::max(out, 1 + levelsOf(*call->called, most - 1));
  return out;
}

bool same(const ir::AxisPosition& a, const ir::AxisPosition& b) {
  return a.state != ir::AxisPosition::State::Unknown && a.state == b.state && a.point == b.point &&
         ir::equal(a.value, b.value);
}

} // namespace

// Of Lowering::outlines_: which statements of the body it is, with both labels.
struct Lowering::Region {
  const Outline* call = nullptr;
  std::size_t begin = 0, end = 0;
  std::optional<std::size_t> program; // nothing: it stays
  std::string why;
};

void Lowering::beCalled(bool probeOn) {
  called_ = true;
  scope_.keepsProbe = probeOn;
  if (probeOn) probe_ = Probe::On;
}

bool Lowering::isProgram(const Call& call) const {
  return levels_ > 0 && depth_ == 0 && out_ == &cycle_.body && moves(*call.called);
}

std::vector<Lowering::Region> Lowering::regions() const {
  std::map<ir::LabelId, std::size_t> at;
  for (std::size_t i = 0; i < cycle_.body.size(); ++i)
    if (const auto* label = std::get_if<ir::Label>(&cycle_.body[i].node)) at[label->label] = i;
  std::vector<Region> out;
  for (const Outline& one : outlines_)
    out.push_back({&one, at.at(one.begin), at.at(one.end), std::nullopt, ""});
  return out;
}

std::optional<std::size_t> Lowering::programOf(const Outline& call, std::string& why) {
  const Programs::Key key{call.called, call.probeOn, levelsOf(*call.called, levels_ - 1)};
  const auto cannot = [&] { why = "by itself it cannot be converted"; };
  if (const auto found = programs_->byKey.find(key); found != programs_->byKey.end()) {
    if (!found->second) cannot();
    return found->second;
  }
  const std::size_t index = programs_->list.size();
  programs_->list.emplace_back(); // before those that it calls
  Diagnostics said;               // the same as of the call, or of options that it leaves out
  Lowering apart(*call.called, sources_, said);
  apart.callPrograms(*programs_, key.levels);
  apart.beCalled(call.probeOn);
  std::optional<Lowered> lowered = apart.run();
  if (!lowered) {
    programs_->byKey[key] = std::nullopt;
    cannot();
    return std::nullopt;
  }
  CalledProgram& program = programs_->list[index];
  program.cycle = std::move(lowered->cycle);
  program.letters = std::move(lowered->letters);
  for (const auto& [name, id] : call.results)
    program.results.push_back(name);
  programs_->byKey[key] = index;
  return index;
}

void Lowering::keepEntangled(std::vector<Region>& regions) const {
  std::vector<std::size_t> regionAt(cycle_.body.size(), regions.size());
  for (bool changed = true; changed;) {
    changed = false;
    std::fill(regionAt.begin(), regionAt.end(), regions.size());
    for (std::size_t r = 0; r < regions.size(); ++r)
      if (regions[r].program)
        std::fill(regionAt.begin() + static_cast<std::ptrdiff_t>(regions[r].begin),
                  regionAt.begin() + static_cast<std::ptrdiff_t>(regions[r].end) + 1, r);
    std::set<ir::VariableId> read;
    const auto take = [&](const ir::Expression& node) {
      if (const auto* use = std::get_if<ir::VariableUse>(&node.node)) read.insert(use->variable);
    };
    for (const ir::CycleStatement& statement : cycle_.checks)
      ir::eachNode(statement, take);
    for (std::size_t i = 0; i < cycle_.body.size(); ++i)
      if (regionAt[i] == regions.size()) ir::eachNode(cycle_.body[i], take);
    for (const Region& region : regions)
      if (region.program)
        for (const auto& [name, value] : region.call->arguments)
          ir::eachNode(value, take);
    for (std::size_t i = 0; i < cycle_.body.size(); ++i) {
      const auto* assign = std::get_if<ir::Assign>(&cycle_.body[i].node);
      if (assign == nullptr || regionAt[i] == regions.size() || !read.contains(assign->variable)) continue;
      Region& region = regions[regionAt[i]];
      const auto& results = region.call->results;
      const bool handed = std::any_of(results.begin(), results.end(),
                                      [&](const auto& one) { return one.second == assign->variable; });
      if (handed || !region.program) continue;
      region.program.reset();
      region.why = "the cycle goes on from where it ends";
      changed = true;
    }
  }
}

ir::CallCycle Lowering::callOf(const Region& region, const std::vector<ir::Position>& known) {
  const Outline& call = *region.call;
  ir::CallCycle out;
  out.cycle = std::string(ir::kProgram);
  const auto give = [&](std::string name, ir::ExpressionPtr value, ir::Kind kind) {
    out.arguments.push_back({std::move(name), std::move(value), std::nullopt, kind, true});
  };
  give(std::string(ir::kCalledProgram), ir::constant(static_cast<double>(*region.program)), ir::Kind::Count);
  const ir::Cycle& called = programs_->list[*region.program].cycle;
  for (const auto& [name, value] : call.arguments)
    for (const ir::Variable& variable : called.variables)
      if (variable.role == ir::Role::Parameter && variable.name == name) give(name, value, variable.kind);
  for (const ir::Variable& variable : called.variables)
    if (variable.role == ir::Role::Host && !variable.name.starts_with("start_"))
      give(variable.name, host(variable.name, variable.kind), variable.kind);
  std::array<bool, 3> sets{};
  for (std::size_t i = region.begin; i <= region.end; ++i)
    if (const auto* inner = std::get_if<ir::CallCycle>(&cycle_.body[i].node)) {
      out.setsTool = out.setsTool || inner->setsTool;
      for (std::size_t a = 0; inner->setting && a < sets.size(); ++a)
        sets[a] = sets[a] || inner->setting->axes[a];
    }
  if (sets != std::array<bool, 3>{}) {
    out.setting.emplace(); // of no certain system
    out.setting->system = ir::constant(0);
    out.setting->axes = sets;
  }
  const auto isBack = [&](const ir::AxisPosition& before, const ir::AxisPosition& after) {
    if (before.state == ir::AxisPosition::State::Unknown || same(before, after)) return true;
    const auto* use = after.state == ir::AxisPosition::State::Work
                          ? std::get_if<ir::VariableUse>(&after.value->node)
                          : nullptr;
    const auto began = use == nullptr ? began_.end() : began_.find(use->variable);
    return began != began_.end() && same(before, began->second); // by `move to start`
  };
  for (std::size_t a = 0; a < sets.size(); ++a)
    out.returns = out.returns && (sets[a] || (out.setsTool && a == ir::indexOf(ir::Axis::Z)) ||
                                  isBack(known[region.begin][a], known[region.end][a]));
  return out;
}

void Lowering::outline() {
  if (outlines_.empty()) return;
  std::vector<Region> list = regions();
  const std::vector<ir::Position> known = ir::positions(cycle_);
  for (Region& region : list)
    region.program = programOf(*region.call, region.why);
  keepEntangled(list);
  std::vector<ir::CallCycle> calls;
  for (const Region& region : list)
    if (region.program) calls.push_back(callOf(region, known));
  std::set<ir::VariableId> read;
  const auto take = [&](const ir::Expression& node) {
    if (const auto* use = std::get_if<ir::VariableUse>(&node.node)) read.insert(use->variable);
  };
  std::vector<ir::CycleStatement> body = std::exchange(cycle_.body, {});
  out_ = &cycle_.body;
  std::size_t at = 0, next = 0;
  std::vector<std::pair<std::size_t, const Region*>> placed; // calls of programs, by their place in the body
  for (const Region& region : list) {
    for (; at < region.begin; ++at)
      cycle_.body.push_back(std::move(body[at]));
    ++at;
    if (region.program) {
      placed.emplace_back(cycle_.body.size(), &region);
      emit(std::move(calls[next++]), region.call->range);
      at = region.end;
    } else if (!region.why.empty()) {
      programs_->inPlace.push_back(
          {region.call->range, region.call->called->header()->name.text, region.why});
    }
    for (; at < region.end; ++at)
      cycle_.body.push_back(std::move(body[at]));
    ++at;
  }
  for (; at < body.size(); ++at)
    cycle_.body.push_back(std::move(body[at]));
  for (const auto* statements : {&cycle_.checks, &cycle_.body})
    for (const ir::CycleStatement& statement : *statements)
      ir::eachNode(statement, take);
  body = std::exchange(cycle_.body, {});
  next = 0;
  for (std::size_t i = 0; i < body.size(); ++i) {
    cycle_.body.push_back(std::move(body[i]));
    if (next >= placed.size() || placed[next].first != i) continue;
    const Region& region = *placed[next++].second;
    CalledProgram& program = programs_->list[*region.program];
    for (std::size_t r = 0; r < region.call->results.size(); ++r) {
      const auto& [name, id] = region.call->results[r];
      if (!read.contains(id)) continue;
      program.readResults.insert(name);
      emit(ir::Assign{id, ir::handedBack(r, region.call->range)}, region.call->range, "result of the call");
    }
  }
}

} // namespace dotek::frontend::cycle
