// ToolPath.mac: the moves of a cycle whose touches find what they expect. X and Y count from the point of the
// operation, Z from the retract plane, where the cycle begins.
#include "backends/gibbs/Macro.h"
#include "backends/gibbs/PathCycles.h"
#include "ir/CycleNames.h"
#include "ir/Fold.h"
#include "ir/Rewrite.h"
#include "ir/Walk.h"
#include "support/Decimal.h"
#include "support/messages/CamFolder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace dotek::backends::gibbs {

namespace {

using ir::ExpressionPtr;

constexpr double kFirstOfSystem = 1000; // number of a variable that the control defines

ExpressionPtr plus(const ExpressionPtr& a, const ExpressionPtr& b) {
  return ir::binary(ir::BinaryOp::Add, a, b);
}
ExpressionPtr minus(const ExpressionPtr& a, const ExpressionPtr& b) {
  return ir::binary(ir::BinaryOp::Subtract, a, b);
}

void collect(const ExpressionPtr& value, int sign, double& constant,
             std::vector<std::pair<int, ExpressionPtr>>& terms) {
  if (const double* number = ir::constantValue(value)) {
    constant += sign * *number;
    return;
  }
  const auto* unary = std::get_if<ir::Unary>(&value->node);
  if (unary != nullptr && unary->op == ir::UnaryOp::Negate)
    return collect(unary->operand, -sign, constant, terms);
  const auto* binary = std::get_if<ir::Binary>(&value->node);
  const bool sum =
      binary != nullptr && (binary->op == ir::BinaryOp::Add || binary->op == ir::BinaryOp::Subtract);
  if (sum) {
    collect(binary->left, sign, constant, terms);
    collect(binary->right, binary->op == ir::BinaryOp::Add ? sign : -sign, constant, terms);
    return;
  }
  const auto same = std::find_if(terms.begin(), terms.end(), [&](const auto& term) {
    return term.first == -sign && ir::equal(term.second, value);
  });
  if (same != terms.end())
    terms.erase(same);
  else
    terms.emplace_back(sign, value);
}

// A sum without terms that cancel, positive ones first: the picture of a path does not mind the last digit.
ExpressionPtr tidy(const ExpressionPtr& given) {
  double constant = 0;
  std::vector<std::pair<int, ExpressionPtr>> terms;
  collect(ir::simplify(given), 1, constant, terms);
  std::stable_partition(terms.begin(), terms.end(), [](const auto& term) { return term.first > 0; });
  ExpressionPtr out;
  for (const auto& [sign, term] : terms) {
    if (out == nullptr)
      out = sign > 0 ? term : ir::unary(ir::UnaryOp::Negate, term);
    else
      out = sign > 0 ? plus(out, term) : minus(out, term);
  }
  constant = std::round(constant * 1e9) / 1e9;
  if (out == nullptr) return ir::constant(constant);
  if (constant == 0) return out;
  return constant > 0 ? plus(out, ir::constant(constant)) : minus(out, ir::constant(-constant));
}

bool reads(const ExpressionPtr& value, ir::VariableId id) {
  bool found = false;
  ir::eachNode(value, [&](const ir::Expression& node) {
    const auto* use = std::get_if<ir::VariableUse>(&node.node);
    found = found || (use != nullptr && use->variable == id);
  });
  return found;
}

// Values that no move, touch or decision needs.
void dropUnread(ir::Cycle& cycle) {
  std::set<ir::VariableId> needed;
  std::map<ir::VariableId, std::vector<const ir::CycleStatement*>> assigned;
  std::vector<const ir::CycleStatement*> open;
  for (const ir::CycleStatement& statement : cycle.body) {
    const auto* assign = std::get_if<ir::Assign>(&statement.node);
    (assign == nullptr ? open : assigned[assign->variable]).push_back(&statement);
  }
  while (!open.empty()) {
    const ir::CycleStatement& statement = *open.back();
    open.pop_back();
    ir::eachNode(statement, [&](const ir::Expression& node) {
      const auto* use = std::get_if<ir::VariableUse>(&node.node);
      if (use == nullptr || !needed.insert(use->variable).second) return;
      const auto found = assigned.find(use->variable);
      if (found != assigned.end()) open.insert(open.end(), found->second.begin(), found->second.end());
    });
  }
  std::erase_if(cycle.body, [&](const ir::CycleStatement& one) {
    const auto* assign = std::get_if<ir::Assign>(&one.node);
    return assign != nullptr && !needed.contains(assign->variable);
  });
}

// "#4006 is 21, else an alarm": the path is that of a machine that is as the blocks want it.
bool guards(const std::vector<ir::CycleStatement>& body, std::size_t i) {
  if (i + 2 >= body.size()) return false;
  const auto* branch = std::get_if<ir::Branch>(&body[i].node);
  const auto* label = std::get_if<ir::Label>(&body[i + 2].node);
  if (branch == nullptr || label == nullptr || label->label != branch->target ||
      !std::holds_alternative<ir::Alarm>(body[i + 1].node))
    return false;
  bool ofMachine = false;
  ir::eachNode(branch->condition, [&](const ir::Expression& node) {
    ofMachine = ofMachine || std::holds_alternative<ir::MachineVariable>(node.node);
  });
  return ofMachine;
}

// A bare G53, which lets the control come to rest.
bool waits(const ir::OpaqueBlock& block) {
  constexpr double kWait = 53;
  const double* code =
      block.words.size() == 1 && block.words.front().address == 'G' && block.words.front().value
          ? ir::constantValue(block.words.front().value)
          : nullptr;
  return code != nullptr && *code == kWait;
}

// Common variables that the cycle sets are variables of the macro.
void nameStores(ir::Cycle& cycle, Names& names) {
  std::map<double, ir::VariableId> own;
  for (const ir::CycleStatement& statement : cycle.body) {
    const auto* store = std::get_if<ir::Store>(&statement.node);
    const double* number = store == nullptr ? nullptr : ir::constantValue(store->number);
    if (number == nullptr || *number >= kFirstOfSystem || own.contains(*number)) continue;
    ir::Variable variable;
    variable.name = "kept_" + numberText(*number);
    own.emplace(*number, cycle.add(variable));
    names.add(variable.name);
  }
  const auto named = [&](const ExpressionPtr& node) -> ExpressionPtr {
    const auto* machine = std::get_if<ir::MachineVariable>(&node->node);
    const double* number = machine == nullptr ? nullptr : ir::constantValue(machine->number);
    const auto found = number == nullptr ? own.end() : own.find(*number);
    if (found != own.end()) return ir::variable(found->second, node->range);
    const auto* unary = std::get_if<ir::Unary>(&node->node);
    const bool zero = unary != nullptr && unary->op == ir::UnaryOp::NullAsZero;
    return zero ? unary->operand : node;
  };
  for (ir::CycleStatement& statement : cycle.body) {
    if (const auto* store = std::get_if<ir::Store>(&statement.node)) {
      const double* number = ir::constantValue(store->number);
      const auto found = number == nullptr ? own.end() : own.find(*number);
      if (found == own.end()) continue; // an offset: nothing is drawn
      const ExpressionPtr value = store->value;
      statement.node = ir::Assign{found->second, value};
    }
    ir::rewrite(statement, named);
  }
  std::erase_if(cycle.body,
                [](const ir::CycleStatement& one) { return std::holds_alternative<ir::Store>(one.node); });
}

// What draws nothing is gone, and with it what only that needed. An alarm ends the path.
ir::Cycle drawn(const ir::Cycle& given, Names& names) {
  ir::Cycle out = given;
  out.checks.clear();
  std::vector<ir::CycleStatement> body;
  for (std::size_t i = 0; i < out.body.size(); ++i) {
    if (guards(given.body, i)) {
      ++i;
      continue;
    }
    ir::CycleStatement& statement = out.body[i];
    const bool silent = ir::match(
        statement,
        [](const ir::OneOf<ir::Comment, ir::ProbePower, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell,
                           ir::Stop> auto&) { return true; },
        [](const ir::CallCycle& node) { return !node.moves; },
        [](const ir::OneOf<ir::Assign, ir::Store, ir::Label, ir::Jump, ir::Branch, ir::Return, ir::Move,
                           ir::Measure, ir::Alarm, ir::Port, ir::Print> auto&) { return false; },
        [](const ir::OpaqueBlock& node) { return waits(node); });
    if (silent) continue;
    if (std::holds_alternative<ir::Alarm>(statement.node)) statement.node = ir::Return{};
    body.push_back(std::move(statement));
  }
  out.body = std::move(body);
  nameStores(out, names);
  ir::fold(out, {});
  for (int round = 0; round < 2; ++round) { // a decision whose ways do the same is gone after the first
    dropUnread(out);
    ir::fold(out, {});
  }
  return out;
}

// What a way along an axis leads to, without factors that do not change its sign.
ExpressionPtr signOf(const ExpressionPtr& way) {
  const auto* binary = std::get_if<ir::Binary>(&way->node);
  const double* factor = binary == nullptr ? nullptr : ir::constantValue(binary->right);
  const bool scaled =
      binary != nullptr && (binary->op == ir::BinaryOp::Divide || binary->op == ir::BinaryOp::Multiply);
  return scaled && factor != nullptr && *factor > 0 ? signOf(binary->left) : way;
}

class Path {
public:
  Path(const ir::Cycle& cycle, const Folder& folder, MacroText& text)
      : cycle_(drawn(cycle, text.names())), folder_(folder), text_(text) {
    here_.fill(ir::constant(0));
  }

  std::vector<EmittedLine> write() {
    const bool jumps = std::any_of(cycle_.body.begin(), cycle_.body.end(), [](const ir::CycleStatement& one) {
      return std::holds_alternative<ir::Label>(one.node);
    });
    if (jumps) {
      for (std::size_t i = 0; i < 3; ++i) {
        text_.assign(text_.names().of(place(i)), here_[i], {});
        here_[i] = ir::variable(place(i));
      }
    }
    for (const ir::CycleStatement& statement : cycle_.body)
      one(statement);
    if (ends_) text_.add(":" + end());
    std::vector<EmittedLine> body = text_.take();
    for (std::size_t i = 0; i < 3; ++i)
      usesOrigin_[i] = origins_[i] && readAnywhere(body, text_.names().of(*origins_[i]));
    dropUnreadLines(body);
    explainHeights(body);
    readHosts();
    std::vector<EmittedLine> lines = text_.take();
    lines.insert(lines.end(), std::make_move_iterator(body.begin()), std::make_move_iterator(body.end()));
    if (text_.turns()) lines.insert(lines.begin(), EmittedLine{"degrees", {}, "unit of the angles"});
    return lines;
  }

private:
  template <class... Args> void refuse(SourceRange range, const Args&... args) {
    if (std::exchange(refused_, true)) return;
    text_.fail();
    text_.diagnostics().report<diag::CamPath>(range, args...);
  }

  std::string end() {
    if (end_.empty()) end_ = text_.freshLabel("path_ends");
    return end_;
  }

  // A place that many moves add up to is a variable: written out in each of them they were long lines.
  void keepShort(std::size_t i, const ir::Origin& from) {
    constexpr std::size_t kMostReads = 12;
    constexpr const char* kNames[] = {"so_far_x", "so_far_y", "so_far_z"};
    std::size_t reads = 0;
    ir::eachNode(here_[i], [&](const ir::Expression& node) {
      reads += std::holds_alternative<ir::VariableUse>(node.node) ? 1 : 0;
    });
    if (reads <= kMostReads) return;
    const ir::VariableId own = made(kNames[i], ir::Kind::Length);
    text_.assign(text_.names().of(own), here_[i], from);
    here_[i] = ir::variable(own);
  }

  // The variable that holds the place along an axis where ways meet.
  ir::VariableId place(std::size_t i) {
    constexpr const char* kNames[] = {"at_x", "at_y", "at_z"};
    if (!places_[i]) places_[i] = made(kNames[i], ir::Kind::Length);
    return *places_[i];
  }

  // A variable of ours. Its name is new in the CAM's files, too.
  ir::VariableId made(const char* name, ir::Kind kind) {
    ir::Variable variable;
    variable.name = name;
    variable.kind = kind;
    cycle_.add(variable);
    return text_.names().add(name);
  }

  // What counts from the point of the operation and from the retract plane.
  ExpressionPtr origin(std::size_t i) {
    constexpr const char* kNames[] = {"point_x", "point_y", "plane"};
    if (!origins_[i]) origins_[i] = made(kNames[i], ir::Kind::Length);
    usesOrigin_[i] = true;
    return ir::variable(*origins_[i]);
  }

  void readHosts() {
    text_.add("callback_returncode = 0 ! dotek: ignore return-code-constant -- a path can always be drawn");
    constexpr const char* kParameters[] = {"x", "y", "retract_plane"};
    for (std::size_t i = 0; i < 3; ++i)
      if (usesOrigin_[i])
        text_.add(std::string("get_custom_drill_cycle_data ") + kParameters[i] + ", " +
                  text_.names().of(*origins_[i]));
    if (radius_) {
      const std::string number = text_.names().fresh("drawn");
      text_.add(number + " = callback_op");
      readRadius(text_, "op", number, text_.names().of(*radius_));
    }
  }

  ExpressionPtr radius() {
    if (!radius_) {
      radius_ = findHost(cycle_, "tool_radius");
      if (!radius_) radius_ = made("tool_radius", ir::Kind::Length);
    }
    return ir::variable(*radius_);
  }

  // The axis whose place the variable of the control holds.
  std::optional<std::size_t> placeAlong(double number) const {
    for (const std::uint32_t first : folder_.places)
      for (std::size_t i = 0; i < 3; ++i)
        if (number == first + static_cast<double>(i)) return i;
    return std::nullopt;
  }

  // With what the last touch found, what was stored, and the start in place of their names.
  ExpressionPtr known(const ExpressionPtr& given, const ir::Origin& from) {
    return ir::rewrite(given, [&](const ExpressionPtr& node) -> ExpressionPtr {
      if (const auto* use = std::get_if<ir::VariableUse>(&node->node)) {
        if (use->variable >= cycle_.variables.size() || cycle_.variable(use->variable).role != ir::Role::Host)
          return node;
        const std::string& name = cycle_.variable(use->variable).name;
        if (name == "start_x") return origin(0);
        if (name == "start_y") return origin(1);
        if (name == "start_z" || name == "retract") return origin(2);
        if (name == "tool_radius") return radius();
        refuse(from.range(), "what depends on `" + name + "`", "fix it by `--host " + name + "=VALUE`");
        return node;
      }
      if (const auto* result = std::get_if<ir::MeasuredResult>(&node->node)) {
        const auto found = results_.find(result->name);
        if (found != results_.end())
          return found->second.axis ? tidy(plus(found->second.value, origin(*found->second.axis)))
                                    : found->second.value;
        refuse(from.range(), "what depends on a result whose touch is not known here",
               "touch where it is used");
      }

      const auto* machine = std::get_if<ir::MachineVariable>(&node->node);
      if (machine == nullptr) return node;
      const double* number = ir::constantValue(machine->number);
      if (const std::optional<std::size_t> axis = number == nullptr ? std::nullopt : placeAlong(*number))
        return tidy(plus(here_[*axis], origin(*axis)));

      if (ir::readTool(*node))
        refuse(from.range(), "what depends on a tool offset of the control", "hand it in as a parameter");
      else
        refuse(from.range(), "what depends on a variable of the machine", "use a field instead");
      return node;
    });
  }

  ir::ConditionPtr known(const ir::ConditionPtr& given, const ir::Origin& from) {
    return ir::rewrite(given, [&](const ExpressionPtr& node) { return known(node, from); });
  }

  // Along axis i, counted as the path counts it.
  ExpressionPtr local(const ir::Coordinate& coordinate, std::size_t i, const ir::Origin& from) {
    const ExpressionPtr value = known(coordinate.value, from);
    switch (coordinate.frame) {
    case ir::Frame::Work:
      if (coordinate.system != nullptr)
        refuse(from.range(), "coordinates of another work offset", "give them in the active one");
      return tidy(minus(value, origin(i)));
    case ir::Frame::Start: return tidy(value);
    case ir::Frame::Retract: return tidy(i == 2 ? value : minus(value, origin(i)));
    case ir::Frame::Here: return tidy(plus(here_[i], value));
    case ir::Frame::Machine:
      refuse(from.range(), "a move to a place of the machine",
             "let the post do it before or after the cycle");
      return value;
    }
    return value;
  }

  void feed(std::size_t i, const ExpressionPtr& to, const ir::Origin& from) {
    constexpr const char* kWords[] = {"feed_x", "feed_y", "feed_z"};
    text_.add(std::string("add_custom_drill_cycle_path ") + kWords[i] + ", " + text_.expression(to, from),
              from);
  }

  void move(const ir::Move& node, const ir::Origin& from) {
    if (node.point == ir::ProbePoint::Contact)
      refuse(from.range(), "a move of the contact point", "give the place of the ball");
    std::vector<std::size_t> moved;
    std::array<ExpressionPtr, 3> to = here_;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!node.axes[i]) continue;
      to[i] = local(*node.axes[i], i, from);
      if (!ir::equal(to[i], here_[i])) moved.push_back(i);
    }
    here_ = to;
    for (const std::size_t i : moved)
      keepShort(i, from);
    to = here_;
    if (moved.size() == 1) feed(moved.front(), to[moved.front()], from);
    if (moved.size() < 2) return;
    std::string line = "add_custom_drill_cycle_path feed";
    for (const ExpressionPtr& value : to)
      line += ", " + text_.expression(value, from);
    text_.add(line, from);
  }

  // From here to the contact at `to` along the axis and back.
  void touch(std::size_t i, const ExpressionPtr& to, const ir::Origin& from) {
    const ExpressionPtr way = tidy(minus(to, here_[i]));
    const double* known = ir::constantValue(way);
    if (i == 2) {
      feed(i, to, from);
    } else if (known != nullptr) {
      feed(i, tidy(*known < 0 ? plus(to, radius()) : minus(to, radius())), from);
    } else {
      for (const bool forward : {true, false}) {
        const ExpressionPtr end = tidy(forward ? minus(to, radius()) : plus(to, radius()));
        const ExpressionPtr side = signOf(way);
        const auto* negated = std::get_if<ir::Unary>(&side->node);
        const bool turned = negated != nullptr && negated->op == ir::UnaryOp::Negate;
        const std::string_view condition =
            turned ? (forward ? " <= 0" : " > 0") : (forward ? " >= 0" : " < 0");
        text_.add("if " + text_.expression(turned ? negated->operand : side, from) + std::string(condition) +
                      " then add_custom_drill_cycle_path " + (i == 0 ? "feed_x, " : "feed_y, ") +
                      text_.expression(end, from),
                  from);
      }
    }
    feed(i, here_[i], from);
  }

  void measure(const ir::Measure& node, const ir::Origin& from) {
    constexpr ir::ResultName kPositions[] = {ir::ResultName::PositionX, ir::ResultName::PositionY,
                                             ir::ResultName::PositionZ};
    constexpr ir::ResultName kErrors[] = {ir::ResultName::ErrorX, ir::ResultName::ErrorY,
                                          ir::ResultName::ErrorZ};
    results_.clear();
    if (node.feature == ir::Feature::Bore) {
      const ExpressionPtr half =
          tidy(ir::binary(ir::BinaryOp::Divide, known(node.diameter, from), ir::constant(2)));
      for (std::size_t i = 0; i < 2; ++i) {
        feed(i, tidy(minus(plus(here_[i], half), radius())), from);
        feed(i, tidy(plus(minus(here_[i], half), radius())), from);
        feed(i, here_[i], from);
        results_[kPositions[i]] = {here_[i], i};
        results_[kErrors[i]] = {ir::constant(0), {}};
      }
      results_[ir::ResultName::Size] = {known(node.diameter, from), {}};
      results_[ir::ResultName::SizeError] = {ir::constant(0), {}};
      return;
    }
    const std::size_t i = ir::indexOf(node.axis);
    const ExpressionPtr to = local(*node.target, i, from);
    touch(i, to, from);
    results_[kPositions[i]] = {to, i};
    results_[ir::ResultName::Main] = {to, i};
    results_[kErrors[i]] = {ir::constant(0), {}};
  }

  void call(const ir::CallCycle& node, const ir::Origin& from) {
    const std::optional<DrawnCycle> cycle =
        drawnCycle(node, {[this] { return radius(); }, here_[2], folder_.clearance}, from);
    if (!cycle) {
      if (node.cycle == ir::kSurfaceAlong)
        refuse(from.range(), "a touch along a direction", "touch along an axis, `touch x by 10 mm`");
      else
        refuse(from.range(), "the cycle `" + node.cycle + "`",
               "write its touches, which a path can follow, in its place");
      return;
    }
    for (const ir::CycleStatement& step : cycle->steps)
      one(step);
    std::map<ir::ResultName, Found> results;
    for (const auto& [name, value] : cycle->values)
      results[name] = {known(value, from), {}};
    for (const auto& [name, place] : cycle->places) {
      const auto i = static_cast<std::size_t>(name) - static_cast<std::size_t>(ir::ResultName::PositionX);
      results[name] = {local(place, i, from), i};
      if (cycle->places.size() == 1) results[ir::ResultName::Main] = results[name];
    }
    results_ = std::move(results);
  }

  // Where ways meet, the place is in variables.
  void settle(const ir::Origin& from) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!places_[i]) continue;
      const ExpressionPtr own = ir::variable(*places_[i]);
      if (!ir::equal(here_[i], own)) text_.assign(text_.names().of(*places_[i]), here_[i], from);
      here_[i] = own;
    }
  }

  void assign(const ir::Assign& node, const ir::Origin& from) {
    const ExpressionPtr value = tidy(known(node.value, from));
    for (std::size_t i = 0; i < 3; ++i)
      if (reads(here_[i], node.variable)) {
        const ir::VariableId own = place(i);
        text_.assign(text_.names().of(own), here_[i], from);
        here_[i] = ir::variable(own);
      }
    std::erase_if(results_, [&](const auto& one) { return reads(one.second.value, node.variable); });

    text_.assign(text_.names().of(node.variable), value, from);
  }

  void one(const ir::CycleStatement& statement) {
    const ir::Origin& from = statement.origin;
    ir::match(
        statement, [&](const ir::Assign& node) { assign(node, from); },
        [&](const ir::Label& node) {
          settle(from);
          results_.clear();
          text_.label(node.label, from);
        },
        [&](const ir::Jump& node) {
          settle(from);
          text_.jump(node.target, from);
        },
        [&](const ir::Branch& node) {
          settle(from);
          text_.jumpIf(known(node.condition, from), node.target, from);
        },
        [&](const ir::Return&) {
          ends_ = true;
          text_.add("goto " + end(), from);
        },
        [&](const ir::Move& node) { move(node, from); },
        [&](const ir::Measure& node) { measure(node, from); },
        [&](const ir::CallCycle& node) { call(node, from); },
        [&](const ir::OpaqueBlock&) {
          refuse(from.range(), "a block whose meaning is not known", "take it out of the cycle");
        },
        [&](const ir::OneOf<ir::Port, ir::Print> auto&) {
          refuse(from.range(), "what is printed through the port", "take it out of the cycle");
        },
        [](const ir::OneOf<ir::Comment, ir::ProbePower, ir::Spindle, ir::Coolant, ir::SetMode, ir::Dwell,
                           ir::Stop, ir::Alarm, ir::Store> auto&) {});
  }

  ir::Cycle cycle_;
  const Folder& folder_;
  MacroText& text_;
  std::array<ExpressionPtr, 3> here_;
  std::array<std::optional<ir::VariableId>, 3> places_, origins_;
  std::array<bool, 3> usesOrigin_{};
  std::optional<ir::VariableId> radius_;
  // What a touch has found; along an axis as the path counts it, without the origin.
  struct Found {
    ExpressionPtr value;
    std::optional<std::size_t> axis;
  };
  std::map<ir::ResultName, Found> results_;

  std::string end_;
  bool ends_ = false, refused_ = false;
};

} // namespace

std::vector<EmittedLine> pathLines(const ir::Cycle& cycle, const Folder& folder, MacroText& text) {
  return Path(cycle, folder, text).write();
}

} // namespace dotek::backends::gibbs
