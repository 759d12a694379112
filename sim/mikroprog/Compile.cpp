// Blocks of Mikroprog as instructions of the shared machine.
#include "ir/Rewrite.h"
#include "sim/machine/Compiler.h"
#include "sim/machine/Trace.h"
#include "sim/mikroprog/Acts.h"
#include "sim/mikroprog/Chain.h"
#include "sim/mikroprog/Dialect.h"
#include "sim/mikroprog/Functions.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>
#include <utility>

namespace dotek::sim::mikroprog {

namespace {

class BlockCompiler final : public sim::Compiler {
public:
  BlockCompiler(const ir::Program& main, const Profile& profile, const SourceMap& sources,
                const OtherPrograms& others)
      : Compiler(profile.machine, sources), profile_(profile), main_(main), others_(others) {
    use(main);
    for (const auto& [name, program] : others)
      use(*program);
    const auto* const state = profile.control.question(kStateOfProgram);
    if (uses("run-program") || uses("run-macro"))
      chain_ = std::make_shared<Chain>(profile.control, state != nullptr && state->assumed);
  }

  void addAll() {
    begin(main_);
    add(main_);
    for (const auto& [name, program] : others_) {
      if (program == &main_) continue;
      begin(*program);
      add(*program);
    }
    for (const OpenCall& call : openCalls_)
      join(call);
  }

  using Compiler::operator();

  void operator()(const ir::Store& store) override {
    const double* const number = ir::constantValue(store.number);
    const auto to = number == nullptr ? std::optional<std::uint32_t>() : cellOf(*number);
    emit(Op::CountBlock);
    if (!to) return refuse("a parameter of this number is not known");
    const auto sum = parameters(store.value);
    if (sum) emit(Op::ToIncrement, value(*sum), 0, *to, 'X'); // onto the grid of the coordinates
  }

  void operator()(const ir::NcBlock& block) override {
    Plan plan;
    if (!planOf(block, plan)) return;
    if (plan.words.words.empty() || !plan.settings.empty()) emit(Op::CountBlock);
    for (const stdlib::MikroprogFunction* setting : plan.settings)
      if (!act(*setting, block)) return;
    if (plan.stopsFirst) emit(Op::Pause, 0, text(comment()));
    if (!plan.words.words.empty()) words(plan.words, plan.probes && isProtected());
    if (plan.main != nullptr && !act(*plan.main, block)) return;
    if (plan.probes) missed(block);
    for (const auto& [flow, function] : plan.flows)
      step(flow, *function, block);
  }

protected:
  void textEnd() override { refuse("the program has no M30"); }

private:
  struct Plan {
    ir::NcBlock words;                                      // for the machine
    std::vector<const stdlib::MikroprogFunction*> settings; // before them
    const stdlib::MikroprogFunction* main = nullptr;        // takes the words of the block
    std::vector<std::pair<Flow, const stdlib::MikroprogFunction*>> flows;
    bool probes = false;
    bool stopsFirst = false; // a tool is changed by hand
  };

  const stdlib::MikroprogFunction* functionOf(const ir::Word& word) const {
    const auto number = word.address == 'G' || word.address == 'M' ? wholeOf(word) : std::nullopt;
    return number ? profile_.control.find(word.address, *number) : nullptr;
  }
  bool uses(std::string_view function) const { return used_.contains(std::string(function)); }

  std::optional<std::uint32_t> cellOf(double parameter) const {
    if (!(parameter >= 0 && parameter <= kLastParameter) || parameter != std::floor(parameter))
      return std::nullopt;
    const std::uint32_t cell = layout_.cellOf(variableOf(static_cast<std::uint32_t>(parameter)));
    return cell == CellLayout::kNone ? std::nullopt : std::optional(cell);
  }

  // With parameters as variables of the machine; each has to have a value. nullopt: refused.
  std::optional<ir::ExpressionPtr> parameters(const ir::ExpressionPtr& expression) {
    bool known = true;
    ir::ExpressionPtr out = ir::rewrite(expression, [&](const ir::ExpressionPtr& one) {
      const auto* variable = std::get_if<ir::MachineVariable>(&one->node);
      const double* number = variable == nullptr ? nullptr : ir::constantValue(variable->number);
      if (number == nullptr) return one;
      const auto cell = cellOf(*number);
      known = known && cell;
      if (!cell) return one;
      given(static_cast<std::uint32_t>(*number));
      return ir::machineVariable(ir::constant(*number + 1, one->range), one->range);
    });
    if (known) return out;
    refuse("a parameter of this number is not known");
    return std::nullopt;
  }

  std::uint32_t given(std::uint32_t parameter) {
    const std::uint32_t cell = layout_.cellOf(variableOf(parameter));
    emit(Op::Given, cell, text(fmt::format("P{} has no value", parameter)));
    return cell;
  }

  bool isProtected() const {
    const auto at = std::find_if(moves_.begin(), moves_.end(),
                                 [&](const SkipMoveUse& one) { return one.statement == at_; });
    return at != moves_.end() && at->use == SkipUse::Protected;
  }

  // false: the block ends the run here.
  bool planOf(const ir::NcBlock& block, Plan& plan) {
    const stdlib::MikroprogControl& control = profile_.control;
    const auto refused = [&](std::string why) {
      refuse(std::move(why));
      return false;
    };
    BlockSays says;
    std::string taken; // letters that functions of the block take
    for (const ir::Word& word : block.words)
      if (const auto* function = functionOf(word)) {
        taken += lettersOf(function->function);
        if (!takesWords(function->function)) continue;
        if (plan.main != nullptr)
          return refused(
              fmt::format("{} and {} want the words of one block", plan.main->code(), function->code()));
        plan.main = function;
      }
    for (const ir::Word& word : block.words) {
      const char letter = word.address;
      if (letter != 'G' && letter != 'M') {
        if (kJumpLetters.find(letter) != std::string_view::npos || taken.find(letter) != std::string::npos)
          continue;
        if (plan.main != nullptr && letter != 'F' && letter != 'S') continue;
        says.speed = says.speed || letter == 'S';
        if (isAxis(letter)) {
          if (!control.hasAxis(letter)) return refused(fmt::format("there is no axis {}", letter));
          if (!says.flow.empty())
            return refused(fmt::format("whether the move or {} comes first is not known", says.flow));
          says.axes = true;
          says.diameters = says.diameters || control.isDiameter(letter);
        }
        if ((letter == 'I' || letter == 'J' || letter == 'K') && !assumes(3))
          return refused(fmt::format("whether {} counts from the start of the arc or is a coordinate is not "
                                     "known (Q3); write the radius, R",
                                     letter));
        if (const double* number = ir::constantValue(word.value); letter == 'R' && number && *number < 0)
          return refused("an arc with R is at most half a turn here; what a negative R means is not stated");
        const auto with = parameters(word.value);
        if (!with) return false;
        plan.words.words.push_back({letter, control.isDiameter(letter) ? half(*with) : *with, word.range});
        continue;
      }
      if (!take(word, plan, says)) return false;
    }
    return check(plan, says);
  }

  // What a block has, for check().
  struct BlockSays {
    bool sets = false, axes = false, diameters = false, speed = false, motion = false, once = false;
    std::optional<bool> incremental, radius;
    std::string flow; // code of the first
  };

  bool assumes(std::uint32_t question) const {
    const stdlib::MikroprogQuestion* const asked = profile_.control.question(question);
    return asked != nullptr && asked->assumed;
  }

  // A G or an M.
  bool take(const ir::Word& word, Plan& plan, BlockSays& says) {
    const auto number = wholeOf(word);
    const stdlib::MikroprogFunction* const function = functionOf(word);
    if (function == nullptr || !function->usable) {
      refuse(!number ? fmt::format("a computed {} is not known", word.address)
             : function == nullptr
                 ? fmt::format("{}{} is not known", word.address, *number)
                 : fmt::format("{} ({}) cannot be used: {}", function->code(), function->title,
                               function->notes.empty() ? "" : function->notes.front()));
      return false;
    }
    const std::string& what = function->function;
    const bool comesBack = what == "end" && program_ != &main_;
    if (const Flow flow = comesBack ? Flow::End : flowOf(what); flow != Flow::None) {
      plan.flows.emplace_back(flow, function);
      if (says.flow.empty()) says.flow = function->code();
    } else if (isSetting(what)) {
      plan.settings.push_back(function);
    } else if (what == "radius") {
      says.radius = true;
    } else if (profile_.machine.find(word.address, *number * 10) != nullptr) {
      plan.words.words.push_back(word);
      plan.probes = plan.probes || what == "probe-move";
      says.sets = says.sets || what == "set-position";
      says.once = says.once || plan.probes || says.sets;
      says.motion = says.motion || function->group == "motion";
      if (what == "absolute" || what == "incremental") says.incremental = what == "incremental";
      if (what == "absolute") says.radius = false;
      if (what == "tool-change") {
        if (says.flow.empty()) says.flow = function->code();
        const auto* tool = function->find('T');
        plan.stopsFirst = tool == nullptr || !tool->most; // without places there is no turret
      }
    } else if (plan.main != function && !isQuiet(what)) {
      refuse(whyNotFollowed(*function));
      return false;
    }
    return true;
  }

  bool check(const Plan& plan, const BlockSays& says) {
    if ((plan.probes || says.sets) && !says.axes) {
      emit(Op::Fault, 0, text(plan.probes ? "G31 without an axis" : "G92 without an axis"));
      return false;
    }
    if (plan.main != nullptr && (says.motion || says.once)) {
      refuse(fmt::format("{} and a move want the words of one block", plan.main->code()));
      return false;
    }
    if (says.radius && uses("radius")) run(keep(kRadius, *says.radius ? 1 : 0));
    if (uses("thread-pass") && says.motion) run(keep(kMotionLost, 0));
    if (uses("thread-pass") && says.axes && !says.motion && !says.once) run(checkMotion());
    if (uses("surface-speed") && says.speed) run(endSurfaceSpeed());
    if (says.sets) run(checkNoShift());
    if (plan.probes && !absolute(says.incremental, "G31 under G91 (Q20)")) return false;
    if (!says.diameters || says.sets) return true;
    if (!uses("radius")) return absolute(says.incremental, "G91 with a diameter (Q9)");
    if (says.incremental.value_or(true)) run(checkDiameters(says.incremental.has_value()));
    return true;
  }

  // In incremental mode the run ends here; false: it is certain to.
  bool absolute(std::optional<bool> incremental, const char* why) {
    if (incremental && *incremental) {
      refuse(why);
      return false;
    }
    if (!incremental) emit(Op::Absolute, 0, text(why));
    return true;
  }

  // A diameter as the radius that the machine counts; under G24 it is one.
  ir::ExpressionPtr half(const ir::ExpressionPtr& value) const {
    const SourceRange range = value->range;
    if (uses("radius")) // null counts as 0
      return ir::binary(ir::BinaryOp::Divide, value,
                        ir::binary(ir::BinaryOp::Subtract, ir::constant(2, range),
                                   ir::machineVariable(ir::constant(variableOf(kRadius), range), range),
                                   range),
                        range);
    if (const double* number = ir::constantValue(value)) return ir::constant(*number / 2, range);
    return ir::binary(ir::BinaryOp::Divide, value, ir::constant(2, range), range);
  }

  void run(Action action) {
    code_.actions.push_back(std::move(action));
    emit(Op::Act, static_cast<std::uint32_t>(code_.actions.size() - 1));
  }

  // false: the block ends the run here.
  bool act(const stdlib::MikroprogFunction& function, const ir::NcBlock& block) {
    Act out(profile_.control, function);
    const std::string_view letters = lettersOf(function.function);
    for (const ir::Word& word : block.words) {
      const char letter = word.address;
      const bool own = takesWords(function.function)
                           ? letter != 'F' && letter != 'S' && letter != 'G' && letter != 'M'
                           : letters.find(letter) != std::string_view::npos;
      if (!own || letter < 'A' || letter > 'Z') continue;
      if (out.has(letter)) {
        refuse(fmt::format("{} twice in a block is not stated (Q15)", letter));
        return false;
      }
      const auto with = parameters(word.value);
      if (!with) return false;
      out.words[static_cast<std::size_t>(letter - 'A')] = value(*with);
    }
    for (const stdlib::MikroprogAddress& address : function.addresses)
      if (address.use == stdlib::AddressUse::Needed && address.letter >= 'A' && address.letter <= 'Z' &&
          !out.has(address.letter)) {
        emit(Op::Fault, 0, text(fmt::format("{} without {}", function.code(), address.letter)));
        return false;
      }
    run(actionOf(out));
    return true;
  }

  // What `write` adds runs where the instruction jumps.
  template <class Write> void where(std::uint32_t condition, const Write& write) {
    const std::uint32_t over = emit(Op::Jump);
    code_.instructions[condition].c = static_cast<std::uint32_t>(code_.instructions.size());
    write();
    code_.instructions[over].c = static_cast<std::uint32_t>(code_.instructions.size());
  }

  void missed(const ir::NcBlock& block) {
    const std::uint32_t jump = emit(Op::JumpMissed, 0, text("G31 begins in contact (Q19)"));
    where(jump, [&] {
      if (find(block, 'L') != nullptr)
        go(block);
      else
        emit(Op::Fault, 0, text("G31 has found nothing"));
    });
  }

  // To the block that L names.
  void go(const ir::NcBlock& block, Op op = Op::Jump) {
    const ir::Word* const word = find(block, 'L');
    if (word == nullptr) {
      emit(Op::Fault, 0, text("a jump without L"));
    } else if (const auto number = wholeOf(*word)) {
      const auto label = numbers_.find(*number);
      if (label != numbers_.end() && op == Op::Jump && places_[label->second] <= at_) emit(Op::Round);
      if (label != numbers_.end())
        jumpTo(emit(op), label->second);
      else
        emit(Op::Fault, 0, text(fmt::format("no block N{}", *number)));
    } else if (op != Op::Jump) {
      refuse("a subprogram whose block a parameter names is not known");
    } else if (const auto with = parameters(word->value)) {
      emit(Op::JumpTo, value(*with));
    }
  }

  void step(Flow flow, const stdlib::MikroprogFunction& function, const ir::NcBlock& block) {
    switch (flow) {
    case Flow::None: return;
    case Flow::Jump: return go(block);
    case Flow::JumpIf:
      if (const auto condition = conditionOf(function, block))
        where(emit(Op::JumpTrue, ask(*condition)), [&] { go(block); });
      return;
    case Flow::Call:
      // H1 is one run or two.
      if (find(block, 'H') != nullptr)
        return refuse("whether H of G26 counts all runs or those after the first (Q8)");
      if (chain_ != nullptr)
        run([chain = chain_](Machine&, double*) {
          chain->call();
          return true;
        });
      return go(block, Op::CallPlace);
    case Flow::Return:
      if (chain_ != nullptr)
        run([chain = chain_](Machine&, double*) {
          chain->comeBack();
          return true;
        });
      emit(Op::LeavePlace, 0, text("M17 without a call"));
      return;
    case Flow::Program: return runProgram(block);
    case Flow::Macro:
      // How it ends is a part of the question.
      if (!assumes(kStateOfProgram)) return refuse(whyNotFollowed(function));
      return runNamed(macroFile(function), block);
    case Flow::End:
      run([chain = chain_](Machine& machine, double* cells) { return chain->leave(machine, cells); });
      emit(Op::LeavePlace, 0, text("the end of a program that nothing runs"));
      return;
    case Flow::Stop: emit(Op::Pause, 0, text(comment())); return;
    case Flow::StopIf:
      if (const auto condition = conditionOf(function, block))
        run(stopIf(profile_.control, *condition, comment()));
      return;
    case Flow::Wait: return waitFor(function, block);
    case Flow::Reference:
      if (find(block, 'H') != nullptr)
        return refuse("what H of G98 names is not known (Q29); G98 alone runs to the switches of all axes");
      act(function, block);
      return;
    case Flow::Output: act(function, block); return;
    case Flow::Text:
    case Flow::Position:
    case Flow::Value: return record(flow, block);
    }
  }

  // nullopt: the block ends the run here.
  std::optional<std::string> fileOf(const ir::NcBlock& block) {
    const ir::Word* const file = find(block, '@');
    const auto* name = file == nullptr ? nullptr : std::get_if<ir::Constant>(&file->value->node);
    if (name == nullptr || name->digits.empty())
      emit(Op::Fault, 0, text("no file"));
    else if (name->digits.find_first_of("/\\:") != std::string::npos)
      refuse("a file outside the folder of the programs");
    else
      return name->digits;
    return std::nullopt;
  }

  void record(Flow flow, const ir::NcBlock& block) {
    const auto name = fileOf(block);
    if (!name) return;
    if (flow == Flow::Text) return run(writeText(*name, comment()));
    emit(Op::Record, flow == Flow::Position ? kNoCell : given(kAccumulator), text(*name));
  }

  // G28.
  void runProgram(const ir::NcBlock& block) {
    if (const auto name = fileOf(block)) runNamed(*name, block);
  }

  void runNamed(const std::string& name, const ir::NcBlock& block) {
    const auto other = others_.find(name);
    if (other == others_.end())
      return refuse(fmt::format("no program `{}` is in the folder of this one", name));
    if (other->second == &main_)
      return refuse(
          fmt::format("`{}` is the program that runs, and no source says what G28 makes of that", name));
    OpenCall call{0, other->second, std::nullopt};
    if (const ir::Word* const word = find(block, 'L')) {
      call.number = wholeOf(*word);
      if (!call.number) return refuse("a program that begins with a block which a parameter names");
    }
    run([chain = chain_](Machine& machine, double* cells) { return chain->enter(machine, cells); });
    call.instruction = emit(Op::CallPlace);
    openCalls_.push_back(call);
  }

  // The call of another program, once all are compiled.
  struct OpenCall {
    std::uint32_t instruction = 0;
    const ir::Program* program = nullptr;
    std::optional<std::uint32_t> number; // of the block where it begins
  };
  void join(const OpenCall& call) {
    const auto routine = std::find_if(code_.routines.begin(), code_.routines.end(),
                                      [&](const Routine& one) { return one.program == call.program; });
    std::optional<std::uint32_t> place = routine->begin;
    if (call.number) {
      place.reset();
      for (const NumberedPlace& one : routine->labels)
        if (!place && one.number == *call.number) place = one.place;
    }
    Instruction& instruction = code_.instructions[call.instruction];
    if (place)
      instruction.c = *place;
    else
      instruction = {Op::Fault, 0, 0, text(fmt::format("no block N{} in the program", *call.number)), 0};
  }

  // The number of O. nullopt: the block ends the run here.
  std::optional<std::uint32_t> conditionOf(const stdlib::MikroprogFunction& function,
                                           const ir::NcBlock& block) {
    const ir::Word* const word = find(block, 'O');
    const auto number = word == nullptr ? std::nullopt : wholeOf(*word);
    if (word == nullptr)
      emit(Op::Fault, 0, text(function.code() + " without O"));
    else if (!number)
      refuse("a condition whose number a parameter gives is not known");
    else if (profile_.control.condition(*number) == nullptr)
      refuse(fmt::format("O{} is no condition", *number));
    else
      return *number;
    return std::nullopt;
  }

  // A cell that is 1 where the condition holds, else 0.
  std::uint32_t ask(std::uint32_t condition) {
    if ((condition == 11 || condition == 12) && uses("radius") && profile_.control.isDiameter('X'))
      run(checkRadius("what P90 is compared with under G24 is not stated (Q13)"));
    const std::uint32_t cell = temporary();
    run(askCondition(profile_.control, condition, cell));
    return cell;
  }

  // G5: the time is over where the condition does not hold, since nothing moves meanwhile.
  void waitFor(const stdlib::MikroprogFunction& function, const ir::NcBlock& block) {
    const auto condition = conditionOf(function, block);
    const ir::Word* const time = find(block, 'E');
    if (!condition) return;
    if (time == nullptr) {
      emit(Op::Fault, 0, text("G5 without E"));
      return;
    }
    const auto with = parameters(time->value);
    if (!with) return;
    const std::uint32_t seconds = value(*with);
    where(emit(Op::JumpFalse, ask(*condition)), [&] {
      run(dwellThen(seconds));
      if (find(block, 'L') != nullptr)
        go(block);
      else
        emit(Op::Fault, 0, text(fmt::format("O{} did not hold within the time of G5", *condition)));
    });
  }

  // The text beside the block that is compiled: what the operator reads.
  std::string comment() const { return textBeside(*program_, at_); }

  void use(const ir::Program& program) {
    for (const ir::ProgramStatement& statement : program.body)
      if (const auto* block = std::get_if<ir::NcBlock>(&statement.node))
        for (const ir::Word& word : block->words)
          if (const auto* function = functionOf(word)) used_.insert(function->function);
  }

  void begin(const ir::Program& program) {
    moves_ = skipMoves(program, profile_.control);
    numbers_.clear();
    for (ir::LabelId label = 0; label < program.labels.size(); ++label)
      numbers_.emplace(program.labels[label].number, label);
    places_.assign(program.labels.size(), 0);
    for (std::size_t i = 0; i < program.body.size(); ++i)
      if (const auto* label = std::get_if<ir::Label>(&program.body[i].node)) places_[label->label] = i;
  }

  const Profile& profile_;
  const ir::Program& main_;
  const OtherPrograms& others_;
  std::shared_ptr<Chain> chain_; // nullptr: no program runs another one
  std::vector<OpenCall> openCalls_;
  std::set<std::string> used_; // functions of all blocks
  // Of the program that is compiled.
  std::vector<SkipMoveUse> moves_;
  std::map<std::uint64_t, ir::LabelId> numbers_; // N to the first block that has it
  std::vector<std::size_t> places_;              // of each label: its statement
};

} // namespace

Bytecode compile(const ir::Program& program, const Profile& profile, const SourceMap& sources,
                 const OtherPrograms& others) {
  BlockCompiler compiler(program, profile, sources, others);
  compiler.addAll();
  return compiler.finish();
}

} // namespace dotek::sim::mikroprog
