#include "frontend/gibbs/CheckFlow.h"

#include "frontend/gibbs/Walk.h"
#include "support/NearestName.h"
#include "support/messages/Common.h"
#include "support/messages/Gibbs.h"

#include <algorithm>
#include <map>
#include <set>

namespace dotek::frontend::gibbs {

namespace {

class Flow {
public:
  Flow(const ParseContext& context, std::vector<SourceRange>& intoFor)
      : context_(context), intoFor_(intoFor) {}

  void run(const Macro& macro, const std::vector<const Macro*>& included) {
    readBroken(macro);
    visit(macro.lines);
    if (tooDeep_) return;
    for (const Open& open : open_)
      if (!broken_["NEXT"]) context_.diagnostics.report<diag::ForWithoutNext>(open.range, open.variable.text);
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
    checkJumps(foreign);
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
    if (tooDeep_) return;
    if (const auto* loop = std::get_if<For>(&statement.node)) {
      if (open_.size() >= context_.limits.nesting) {
        context_.diagnostics.report<diag::NestingTooDeep>(statement.range, context_.limits.nesting);
        tooDeep_ = true;
        return;
      }
      open_.push_back({nextId_++, spanning(statement.range, loop->variable.range), loop->variable});
    } else if (const auto* next = std::get_if<Next>(&statement.node)) {
      endLoop(*next, statement.range);
    } else if (std::holds_alternative<Continue>(statement.node)) {
      if (open_.empty() && !broken_["FOR"])
        context_.diagnostics.report<diag::ContinueOutsideFor>(statement.range);
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
    if (isNew) return;
    context_.diagnostics.report<diag::DuplicateLabel>(name.range, name.text)
        .note(place->second.name.range, "the first one");
  }

  void endLoop(const Next& next, SourceRange range) {
    if (open_.empty()) {
      if (!broken_["FOR"]) context_.diagnostics.report<diag::NextWithoutFor>(range);
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
        context_.diagnostics
            .report<diag::NextOfOtherFor>(next.variable->range, next.variable->text,
                                          open_.back().variable.text)
            .note(open_.back().range, "the FOR that is open");
      open_.pop_back(); // most likely its end, misspelt
      return;
    }
    if (laterNext(open_.back().variable)) {
      context_.diagnostics
          .report<diag::NextOfOtherFor>(next.variable->range, next.variable->text, open_.back().variable.text)
          .note(open_.back().range, "the FOR that is open");
      open_.erase(std::next(outer).base());
      return;
    }
    for (auto inner = open_.rbegin(); inner != outer; ++inner)
      if (!broken_["NEXT"])
        context_.diagnostics.report<diag::ForWithoutNext>(inner->range, inner->variable.text);
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
  void checkJumps(const std::set<std::string>& foreign) {
    for (const Place& jump : jumps_) {
      const std::string key = foldCase(jump.name.text);
      const auto found = labels_.find(key);
      if (found == labels_.end()) {
        if (foreign.count(key) == 0 && !broken_[":"]) reportUndefined(jump.name, foreign);
        continue;
      }
      const std::vector<std::size_t>& inside = found->second.loops;
      const bool within =
          inside.size() <= jump.loops.size() && std::equal(inside.begin(), inside.end(), jump.loops.begin());
      if (!within) intoFor_.push_back(jump.name.range);
    }
  }

  void reportUndefined(const Name& name, const std::set<std::string>& foreign) {
    if (context_.diagnostics.full(diag::UndefinedLabel::code, name.range.file)) return;
    NearestName nearest(name.text);
    for (const auto& [key, place] : labels_)
      nearest.offer(place.name.text);
    for (const std::string& key : foreign)
      nearest.offer(key);
    const std::string remedy = nearest.result().empty() ? "; write a line `:" + name.text + "`"
                                                        : "; did you mean `" + nearest.result() + "`?";
    context_.diagnostics.report<diag::UndefinedLabel>(name.range, name.text, remedy);
  }

  const ParseContext& context_;
  std::vector<SourceRange>& intoFor_;
  std::map<std::string, bool> broken_;
  std::vector<Open> open_;
  bool tooDeep_ = false; // FORs within one another: each place keeps those around it
  std::size_t nextId_ = 0;
  std::map<std::string, Place> labels_;
  std::vector<Place> jumps_;
  std::set<std::string> nexts_;
};

} // namespace

void checkFlow(const Macro& macro, const std::vector<const Macro*>& included, const ParseContext& context,
               std::vector<SourceRange>& intoFor) {
  Flow flow(context, intoFor);
  flow.countNexts(macro);
  flow.run(macro, included);
}

} // namespace dotek::frontend::gibbs
