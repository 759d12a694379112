#include "frontend/gibbs/CheckFlow.h"

#include "frontend/gibbs/Walk.h"
#include "support/NearestName.h"
#include "support/WriteInstead.h"

#include <algorithm>
#include <map>
#include <set>

namespace dotek::frontend::gibbs {

namespace {

class Flow {
public:
  explicit Flow(const ParseContext& context) : context_(context) {}

  FlowFindings run(const Macro& macro, const std::vector<const Macro*>& included) {
    readBroken(macro);
    visit(macro.lines);
    if (found_.tooDeep) return std::move(found_);
    for (const Open& open : open_)
      if (!broken_["NEXT"]) found_.forsWithoutNext.emplace_back(open.range, open.variable);
    std::size_t includes = 0;
    walkLines(macro.lines,
              [&](const Statement& s) { includes += std::holds_alternative<Include>(s.node) ? 1 : 0; });
    std::set<std::string> foreign;
    for (const Macro* other : included) {
      // An included file is part of this one only in as far as it was found.
      collectLabels(other->lines, foreign);
      if (other->hasErrorNodes) broken_[":"] = true;
    }
    if (included.size() < includes) broken_[":"] = true;
    jumps(foreign);
    return std::move(found_);
  }

private:
  struct Open {
    std::size_t id;
    SourceRange range;
    Name variable;
  };
  struct Place {
    Name name;
    std::vector<std::size_t> loops; // open FORs, outermost first
  };

  // Broken lines may have held the other half of what is looked for.
  void readBroken(const Macro& macro) {
    walkLines(macro.lines, [&](const Statement& statement) {
      if (!std::holds_alternative<ErrorStatement>(statement.node)) return;
      const std::string text = foldCase(std::string(context_.sources.text(statement.range)));
      if (text.empty() || text.front() == ':' || text.back() == ':') broken_[":"] = true;
      for (const char* word : {"FOR", "NEXT"})
        if (text.find(word) != std::string::npos) broken_[word] = true;
    });
  }

  static void collectLabels(const std::vector<Line>& lines, std::set<std::string>& labels) {
    for (const Line& line : lines) {
      if (line.label) labels.insert(foldCase(line.label->name.text));
      if (line.statement == nullptr) continue;
      walkStatement(*line.statement, [&](const Statement& statement) {
        if (const auto* branch = std::get_if<If>(&statement.node)) {
          for (const std::vector<Line>* block : {&branch->thenBlock, &branch->elseBlock})
            for (const Line& inner : *block)
              if (inner.label) labels.insert(foldCase(inner.label->name.text));
        }
      });
    }
  }

  std::vector<std::size_t> loops() const {
    std::vector<std::size_t> ids;
    for (const Open& open : open_)
      ids.push_back(open.id);
    return ids;
  }

  void visit(const std::vector<Line>& lines) {
    for (const Line& line : lines) {
      if (line.label) addLabel(line.label->name);
      if (line.statement != nullptr) visit(*line.statement);
    }
  }

  void visit(const Statement& statement) {
    if (found_.tooDeep) return;
    if (const auto* loop = std::get_if<For>(&statement.node)) {
      if (open_.size() >= context_.limits.nesting) {
        found_.tooDeep = statement.range; // each place keeps the FORs around it
        return;
      }
      open_.push_back({nextId_++, spanning(statement.range, loop->variable.range), loop->variable});
    } else if (const auto* next = std::get_if<Next>(&statement.node)) {
      endLoop(*next, statement.range);
    } else if (std::holds_alternative<Continue>(statement.node)) {
      if (open_.empty() && !broken_["FOR"]) found_.continuesOutside.push_back(statement.range);
    } else if (const auto* jump = std::get_if<Goto>(&statement.node)) {
      jumps_.push_back({jump->label, loops()});
    } else if (const auto* handler = std::get_if<OnError>(&statement.node)) {
      jumps_.push_back({handler->label, loops()});
    } else if (const auto* branch = std::get_if<If>(&statement.node)) {
      if (branch->then != nullptr) visit(*branch->then);
      visit(branch->thenBlock);
      if (branch->elseStatement != nullptr) visit(*branch->elseStatement);
      visit(branch->elseBlock);
    }
  }

  void addLabel(const Name& name) {
    const auto [place, isNew] = labels_.try_emplace(foldCase(name.text), Place{name, loops()});
    if (!isNew) found_.labelsTwice.emplace_back(name, place->second.name.range);
  }

  void endLoop(const Next& next, SourceRange range) {
    if (open_.empty()) {
      if (!broken_["FOR"]) found_.nextsWithoutFor.push_back(range);
      return;
    }
    if (!next.variable || foldCase(next.variable->text) == foldCase(open_.back().variable.text)) {
      open_.pop_back();
      return;
    }
    // A FOR further out: those inside lack their NEXT.
    const std::string key = foldCase(next.variable->text);
    const auto outer = std::find_if(open_.rbegin(), open_.rend(),
                                    [&](const Open& open) { return foldCase(open.variable.text) == key; });
    if (outer == open_.rend()) {
      if (!broken_["FOR"])
        found_.nextsOfOther.push_back({&*next.variable, open_.back().variable, open_.back().range});
      open_.pop_back(); // most likely its end, misspelt
      return;
    }
    if (laterNext(open_.back().variable)) {
      found_.nextsOfOther.push_back({&*next.variable, open_.back().variable, open_.back().range});
      open_.erase(std::next(outer).base());
      return;
    }
    for (auto inner = open_.rbegin(); inner != outer; ++inner)
      if (!broken_["NEXT"]) found_.forsWithoutNext.emplace_back(inner->range, inner->variable);
    open_.erase(std::next(outer).base(), open_.end());
  }

  // Whether another NEXT of the variable follows is found by counting all of them once.
  bool laterNext(const Name& variable) const { return nexts_.count(foldCase(variable.text)) != 0; }

public:
  void countNexts(const Macro& macro) {
    walkLines(macro.lines, [&](const Statement& statement) {
      const auto* next = std::get_if<Next>(&statement.node);
      if (next != nullptr && next->variable) nexts_.insert(foldCase(next->variable->text));
    });
  }

private:
  void jumps(const std::set<std::string>& foreign) {
    for (const auto& [key, place] : labels_)
      found_.labels.push_back(place.name.text);
    found_.labels.insert(found_.labels.end(), foreign.begin(), foreign.end());
    for (const Place& jump : jumps_) {
      const std::string key = foldCase(jump.name.text);
      const auto found = labels_.find(key);
      if (found == labels_.end()) {
        if (foreign.count(key) == 0 && !broken_[":"]) found_.undefinedLabels.push_back(jump.name);
        continue;
      }
      const std::vector<std::size_t>& inside = found->second.loops;
      const bool within =
          inside.size() <= jump.loops.size() && std::equal(inside.begin(), inside.end(), jump.loops.begin());
      if (!within) found_.intoFor.push_back(jump.name.range);
    }
  }

  const ParseContext& context_;
  FlowFindings found_;
  std::map<std::string, bool> broken_;
  std::vector<Open> open_;
  std::size_t nextId_ = 0;
  std::map<std::string, Place> labels_;
  std::vector<Place> jumps_;
  std::set<std::string> nexts_;
};

} // namespace

FlowFindings flowOf(const Macro& macro, const std::vector<const Macro*>& included,
                    const ParseContext& context) {
  Flow flow(context);
  flow.countNexts(macro);
  return flow.run(macro, included);
}

void undefinedLabel(const CheckedFile& input, Report& report) {
  for (const Name& name : input.flow.undefinedLabels) {
    if (report.full(input.file)) return;
    NearestName nearest(name.text);
    for (const std::string& label : input.flow.labels)
      nearest.offer(label);
    report
        .at(name.range, "there is no label `{}`; GibbsCAM stops when it reaches this line{}", name.text,
            nearest.result().empty() ? "; write a line `:" + name.text + "`" : didYouMean(nearest.result()))
        .fix = writeInstead(name.range, nearest.result());
  }
}

void duplicateLabel(const CheckedFile& input, Report& report) {
  for (const auto& [name, first] : input.flow.labelsTwice)
    report
        .at(name.range, "the label `{}` appears twice; which of them GOTO takes is not known; rename one",
            name.text)
        .note(first, "the first one");
}

void forWithoutNext(const CheckedFile& input, Report& report) {
  for (const auto& [range, variable] : input.flow.forsWithoutNext)
    report.at(
        range,
        "this FOR has no `NEXT {}`; its lines run once, or GibbsCAM stops; write NEXT where the loop ends",
        variable.text);
}

void nextWithoutFor(const CheckedFile& input, Report& report) {
  for (const SourceRange& range : input.flow.nextsWithoutFor)
    report.at(range, "this NEXT has no FOR before it; GibbsCAM has nowhere to go back to");
}

void nextOfOtherFor(const CheckedFile& input, Report& report) {
  for (const FlowFindings::OtherFor& one : input.flow.nextsOfOther)
    report
        .at(one.next->range,
            "NEXT names `{}`, but the innermost open FOR counts `{}`; loops end in reverse order",
            one.next->text, one.open.text)
        .note(one.openRange, "the FOR that is open");
}

void continueOutsideFor(const CheckedFile& input, Report& report) {
  for (const SourceRange& range : input.flow.continuesOutside)
    report.at(range, "CONTINUE is in no FOR; it has no NEXT to go to");
}

} // namespace dotek::frontend::gibbs
