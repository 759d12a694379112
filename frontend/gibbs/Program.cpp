#include "frontend/gibbs/Program.h"

#include <algorithm>

namespace dotek::frontend::gibbs {
namespace {

class Compiler {
public:
  Compiler(const Limits& limits, const MacroLoader& load) : limits_(limits), load_(load) {}

  Program compile(const Macro& macro) {
    including_.push_back(&macro);
    lines(macro.lines, false);
    if (isFull()) tooLarge();
    for (const Open& open : open_)
      abandon(open);
    leaveAbandonedLoops();
    return std::move(program_);
  }

private:
  struct Open {
    std::size_t loop;
    std::vector<std::size_t> continues; // instructions to patch with the NEXT
  };

  std::size_t here() const { return program_.instructions.size(); }
  std::size_t limit() const { return std::max<std::size_t>(1, limits_.steps); }

  // Files that bring in nothing but others count, too.
  bool isFull() const { return here() >= limit() || includes_ >= limit(); }

  template <class Step> std::size_t emit(SourceRange range, Step step) {
    if (here() >= limit()) return here() - 1; // tooLarge() will say so
    program_.instructions.push_back({range, open_.empty() ? kNowhere : open_.back().loop, std::move(step)});
    return here() - 1;
  }

  void lines(const std::vector<Line>& list, bool inBlock) {
    for (const Line& line : list) {
      if (isFull()) return;
      if (line.label) {
        const auto [place, isNew] = program_.labels.emplace(foldCase(line.label->name.text), here());
        if (!isNew) place->second = kNowhere;
        // A jump into a block passes the check at its IF.
        if (inBlock) emit(line.label->name.range, UnverifiedStep{"block-if"});
      }
      if (line.statement) statement(*line.statement, false);
    }
  }

  void tooLarge() {
    RefuseStep refusal{"the macro and what it includes have more statements than a run may execute"};
    if (here() == 0) program_.instructions.push_back({{}, kNowhere, refusal});
    // What ends early for its includes may leave out any statement: nothing of it runs.
    (here() < limit() ? program_.instructions.front() : program_.instructions.back()).step = refusal;
  }

  void statement(const Statement& s, bool afterThen) {
    std::visit([&](const auto& node) { visit(node, s.range, afterThen); }, s.node);
  }

  void visit(const Assignment& node, SourceRange range, bool) { emit(range, AssignStep{&node}); }
  void visit(const Goto& node, SourceRange range, bool) { emit(range, GotoStep{&node.label}); }
  void visit(const CallMacro& node, SourceRange range, bool) { emit(range, CallStep{&node}); }
  void visit(const Args& node, SourceRange range, bool) { emit(range, ArgsStep{&node}); }
  void visit(const Declaration& node, SourceRange range, bool) { emit(range, DeclareStep{&node}); }
  void visit(const OnError& node, SourceRange range, bool) { emit(range, OnErrorStep{&node.label}); }
  void visit(const Command& node, SourceRange range, bool) { emit(range, CommandStep{&node}); }
  void visit(const ErrorStatement&, SourceRange range, bool) {
    emit(range, RefuseStep{"the statement is broken"});
  }
  // Draws geometry; changes no variable but ContourRef, which is never known.
  void visit(const std::unique_ptr<GeometryBlock>& block, SourceRange range, bool) {
    if (!block || !block->closeRange) emit(range, RefuseStep{"the block is never closed"});
  }

  void visit(const If& node, SourceRange range, bool) {
    if (node.then == nullptr) emit(node.ifRange, UnverifiedStep{"block-if"});
    if (node.elseRange) emit(*node.elseRange, UnverifiedStep{"else"});
    const std::size_t branch = emit(range, BranchStep{&node.condition, kNowhere});
    if (node.then) {
      statement(*node.then, true);
    } else {
      lines(node.thenBlock, true);
    }
    std::size_t skip = kNowhere;
    if (node.elseRange) {
      skip = emit(*node.elseRange, JumpStep{});
      patch(branch, here());
      if (node.elseStatement) statement(*node.elseStatement, true);
      lines(node.elseBlock, true);
      patch(skip, here());
    } else {
      patch(branch, here());
    }
  }

  void visit(const For& node, SourceRange range, bool afterThen) {
    if (afterThen) {
      emit(range, RefuseStep{"a FOR after THEN opens a loop on one path only"});
      return;
    }
    const std::size_t index = program_.loops.size();
    emit(range, ForStep{&node, index});
    program_.loops.push_back({&node, open_.empty() ? kNowhere : open_.back().loop, here(), kNowhere});
    open_.push_back({index, {}});
  }

  void visit(const Next& node, SourceRange range, bool afterThen) {
    if (afterThen) {
      emit(range, RefuseStep{"a NEXT after THEN closes a loop on one path only"});
      return;
    }
    if (!node.variable) emit(range, UnverifiedStep{"next-without-name"});
    auto match = open_.rbegin();
    if (node.variable) {
      const std::string name = foldCase(node.variable->text);
      match = std::find_if(open_.rbegin(), open_.rend(), [&](const Open& open) {
        return foldCase(program_.loops[open.loop].statement->variable.text) == name;
      });
    }
    if (match == open_.rend()) {
      emit(range, RefuseStep{"the NEXT belongs to no FOR"});
      return;
    }
    for (auto inner = open_.rbegin(); inner != match; ++inner)
      abandon(*inner);
    open_.erase(match.base(), open_.end());
    const std::size_t next = emit(range, NextStep{open_.back().loop});
    program_.loops[open_.back().loop].next = next;
    for (const std::size_t place : open_.back().continues)
      patch(place, next);
    open_.pop_back();
  }

  void visit(const Continue&, SourceRange range, bool) {
    if (open_.empty()) {
      emit(range, RefuseStep{"the CONTINUE is in no FOR"});
      return;
    }
    open_.back().continues.push_back(emit(range, JumpStep{}));
  }

  void visit(const Include& node, SourceRange range, bool afterThen) {
    if (afterThen) {
      emit(range, RefuseStep{"an #INCLUDE after THEN brings in lines on one path only"});
      return;
    }
    if (including_.size() > limits_.includeDepth) {
      emit(node.fileRange,
           RefuseStep{"#INCLUDE is nested too deep; `--limit include-depth=N` raises the limit"});
      return;
    }
    if (looped_) { // read for ever on any path: the paths need not be tried
      emit(node.fileRange, RefuseStep{"a file includes itself"});
      return;
    }
    if (++includes_ >= limit()) return; // tooLarge() will say so
    program_.includes = true;
    const Macro* macro = load_ ? load_(node.file, node.fileRange) : nullptr;
    if (macro == nullptr) {
      emit(node.fileRange, RefuseStep{"the file that #INCLUDE names is not there"});
    } else if (std::find(including_.begin(), including_.end(), macro) != including_.end()) {
      looped_ = true;
      emit(node.fileRange, RefuseStep{"the file includes itself"});
    } else {
      including_.push_back(macro);
      lines(macro->lines, false);
      including_.pop_back();
    }
  }

  void patch(std::size_t place, std::size_t target) {
    auto& step = program_.instructions[place].step;
    if (BranchStep* branch = std::get_if<BranchStep>(&step)) branch->otherwise = target;
    if (JumpStep* jump = std::get_if<JumpStep>(&step)) jump->target = target;
  }

  void abandon(const Open& open) {
    for (const std::size_t place : open.continues) {
      program_.instructions[place].step = RefuseStep{"the FOR around the CONTINUE has no NEXT"};
    }
  }

  // A FOR without NEXT has no body.
  void leaveAbandonedLoops() {
    const auto closed = [this](std::size_t loop) {
      while (loop != kNowhere && program_.loops[loop].next == kNowhere)
        loop = program_.loops[loop].parent;
      return loop;
    };
    for (Instruction& instruction : program_.instructions)
      instruction.loop = closed(instruction.loop);
    for (Loop& loop : program_.loops)
      loop.parent = closed(loop.parent);
  }

  const Limits& limits_;
  const MacroLoader& load_;
  Program program_;
  std::vector<Open> open_;
  std::vector<const Macro*> including_;
  std::size_t includes_ = 0;
  bool looped_ = false;
};

} // namespace

Program compileProgram(const Macro& macro, const Limits& limits, const MacroLoader& load) {
  return Compiler(limits, load).compile(macro);
}

} // namespace dotek::frontend::gibbs
