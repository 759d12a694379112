#include "project/CycleDeeds.h"

#include "frontend/cycle/Link.h"
#include "frontend/cycle/Parse.h"
#include "ir/Match.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>
#include <tuple>

namespace dotek::project {

namespace cycle = frontend::cycle;

namespace {

std::string_view ofTool(cycle::ToolPart part) {
  constexpr std::string_view kTitles[] = {"length", "wear of the length", "radius", "wear of the radius"};
  return kTitles[static_cast<std::size_t>(part)];
}

using Names = std::set<std::string, std::less<>>;

// What is known of a cycle as it is called: the optional parameters that it is not given, and which flags are
// `yes` or `no` wherever they are set.
class Certain {
public:
  Certain(const cycle::File& file, Names absent) : absent_(std::move(absent)) { assigned(file.body); }

  // nullopt: it depends.
  std::optional<bool> of(const cycle::Expression& condition) const {
    return std::visit(ir::Overloaded{[&](const cycle::Given& given) -> std::optional<bool> {
                                       if (absent_.contains(given.name.text)) return false;
                                       return std::nullopt;
                                     },
                                     [&](const cycle::NameUse& use) -> std::optional<bool> {
                                       const auto at = flags_.find(use.name);
                                       return at == flags_.end() ? std::nullopt : at->second;
                                     },
                                     [&](const cycle::Bracketed& inner) { return of(*inner.inner); },
                                     [&](const cycle::Unary& unary) -> std::optional<bool> {
                                       const std::optional<bool> value = of(*unary.operand);
                                       if (unary.op != cycle::UnaryOp::Not || !value) return std::nullopt;
                                       return !*value;
                                     },
                                     [&](const cycle::Binary& both) -> std::optional<bool> {
                                       const bool all = both.op == cycle::BinaryOp::And;
                                       if (!all && both.op != cycle::BinaryOp::Or) return std::nullopt;
                                       const std::optional<bool> a = of(*both.left), b = of(*both.right);
                                       if (a == !all || b == !all) return !all;
                                       return a && b ? std::optional(all) : std::nullopt;
                                     },
                                     [](const auto&) -> std::optional<bool> { return std::nullopt; }},
                      condition.node);
  }

private:
  // Those of branches that are not taken give no value.
  void assigned(const cycle::Block& block) {
    for (const cycle::Statement& statement : block.statements) {
      if (const auto* assign = std::get_if<cycle::Assign>(&statement.node)) {
        const auto* value = std::get_if<cycle::NameUse>(&assign->value->node);
        const bool literal = value != nullptr && (value->name == "yes" || value->name == "no");
        const std::optional<bool> now = literal ? std::optional(value->name == "yes") : std::nullopt;
        const auto [at, isNew] = flags_.emplace(assign->name.text, now);
        if (!isNew && at->second != now) at->second = std::nullopt;
      }
      if (const auto* choice = std::get_if<cycle::If>(&statement.node)) {
        for (const cycle::If::Part& part : choice->parts)
          if (givenIn(*part.condition) != false) assigned(part.body);
        if (choice->otherwise != nullptr) assigned(*choice->otherwise);
      }
      if (const auto* touch = std::get_if<cycle::Touch>(&statement.node);
          touch != nullptr && touch->otherwise != nullptr)
        assigned(*touch->otherwise);
      if (const auto* loop = std::get_if<cycle::Repeat>(&statement.node)) assigned(loop->body);
      if (const auto* loop = std::get_if<cycle::For>(&statement.node)) assigned(loop->body);
      if (const auto* loop = std::get_if<cycle::While>(&statement.node)) assigned(loop->body);
    }
  }
  // By what is absent alone: the values of the flags are not known yet.
  std::optional<bool> givenIn(const cycle::Expression& condition) const {
    Certain alone;
    alone.absent_ = absent_;
    return alone.of(condition);
  }
  Certain() = default;

  Names absent_;
  std::map<std::string, std::optional<bool>, std::less<>> flags_;
};

// Ways to call cycles that are kept apart; beyond them each alarm counts as one that can come.
constexpr std::size_t kMostWays = 1000;

// What the statements of a cycle do, those of the cycles that it calls included.
class Walk {
public:
  explicit Walk(CyclePage& page) : page_(page) {}

  void file(const cycle::File& file, const Names& absent = {}) {
    if (!seen_.emplace(&file, absent).second) return;
    const Certain certain(file, absent);
    const auto around = std::pair(certain_, absent_);
    certain_ = &certain;
    absent_ = &absent;
    block(file.body);
    std::tie(certain_, absent_) = around;
  }

private:
  void add(std::vector<std::string>& list, const std::string& text) {
    if (std::find(list.begin(), list.end(), text) == list.end()) list.push_back(text);
  }

  void choose(const cycle::If& choice) {
    for (const cycle::If::Part& part : choice.parts) {
      const std::optional<bool> taken = certain_->of(*part.condition);
      if (taken != false) block(part.body);
      if (taken == true) return;
    }
    if (choice.otherwise != nullptr) block(*choice.otherwise);
  }

  void call(const cycle::Call& call) {
    if (depth_ == 0) add(page_.calls, call.cycle.text);
    if (call.called == nullptr) return;
    Names given, absent;
    for (const auto* list : {&call.arguments, &call.handedOn})
      for (const cycle::Argument& one : *list) {
        const auto* use = std::get_if<cycle::NameUse>(&one.value->node);
        if (use == nullptr || !absent_->contains(use->name)) given.insert(one.name.text);
      }
    for (const cycle::Statement* one : cycle::declarations(*call.called)) {
      const auto* declared = std::get_if<cycle::Parameter>(&one->node);
      if (declared == nullptr) continue;
      const bool written =
          std::any_of(declared->names.begin(), declared->names.end(), [&](const cycle::Name& name) {
            return std::any_of(
                call.arguments.begin(), call.arguments.end(),
                [&](const cycle::Argument& argument) { return argument.name.text == name.text; });
          });
      // Those that options hand on are checked where the caller takes them.
      if (written) refusals(*declared);
      for (const cycle::Name& name : declared->names)
        if (declared->optional && !given.contains(name.text)) absent.insert(name.text);
    }
    for (const cycle::Statement* one : cycle::declarations(*call.called))
      if (const auto* require = std::get_if<cycle::Require>(&one->node))
        add(page_.alarms,
            require->message ? require->message->text : layOut(*require->condition) + " is not so");
    if (seen_.size() >= kMostWays) absent.clear();
    ++depth_;
    file(*call.called, absent);
    --depth_;
  }

  // What a called cycle refuses is refused where it is called, while the caller runs.
  void refusals(const cycle::Parameter& parameter) {
    for (const cycle::Clause& clause : parameter.clauses) {
      if (clause.kind == cycle::Clause::Kind::Require)
        add(page_.alarms, clause.text ? clause.text->text : parameter.names.front().text + " out of range");
      if (clause.kind == cycle::Clause::Kind::Range)
        add(page_.alarms, parameter.names.front().text + " out of range");
    }
  }

  void block(const cycle::Block& block) {
    for (const cycle::Statement& statement : block.statements)
      std::visit(ir::Overloaded{[&](const cycle::Alarm& alarm) { add(page_.alarms, alarm.text.text); },
                                [&](const cycle::Move& move) {
                                  if (move.kind == cycle::Move::Kind::Protected) page_.meetStops = true;
                                },
                                [&](const cycle::Touch& touch) {
                                  if (touch.otherwise == nullptr)
                                    page_.missStops = true;
                                  else
                                    this->block(*touch.otherwise);
                                },
                                [&](const cycle::If& choice) { choose(choice); },
                                [&](const cycle::Repeat& loop) { this->block(loop.body); },
                                [&](const cycle::For& loop) { this->block(loop.body); },
                                [&](const cycle::While& loop) { this->block(loop.body); },
                                [&](const cycle::SetOffset& set) {
                                  std::string axes;
                                  for (const cycle::Becomes& item : set.items)
                                    axes += std::string(axes.empty() ? "" : ", ") + axisLetter(item.axis);
                                  // What a called cycle sets depends on what it is given.
                                  if (depth_ == 0)
                                    add(page_.sets,
                                        fmt::format("work offset `{}` in {}", layOut(*set.system), axes));
                                },
                                [&](const cycle::SetTool& set) {
                                  if (depth_ == 0)
                                    add(page_.sets, fmt::format("{} of tool offset `{}`", ofTool(set.part),
                                                                layOut(*set.tool)));
                                },
                                [&](const cycle::SetStored& set) {
                                  add(page_.sets, fmt::format("stored value `{}`", set.name.text));
                                },
                                [&](const cycle::Call& one) { call(one); }, [](const auto&) {}},
                 statement.node);
  }

  CyclePage& page_;
  std::set<std::pair<const cycle::File*, Names>> seen_;
  const Certain* certain_ = nullptr; // of the file that is walked
  const Names* absent_ = nullptr;
  int depth_ = 0;
};

} // namespace

void addDeeds(const cycle::File& file, CyclePage& page) {
  Walk(page).file(file, {});
}

} // namespace dotek::project
