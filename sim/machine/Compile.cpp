#include "sim/machine/Compile.h"

#include "ir/NcWords.h"
#include "sim/machine/Arguments.h"
#include "sim/machine/Compiler.h"
#include "sim/machine/Decimal8.h"
#include "sim/machine/Refusals.h"
#include "stdlib/Lathe.h"
#include "stdlib/ReadAhead.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::sim {

std::uint64_t sequenceNumber(double value, const stdlib::Control& control) {
  const double whole = std::round(value);
  return whole >= 1 && whole <= control.sequenceLast ? static_cast<std::uint64_t>(whole) : 0;
}

namespace {

ir::NcWords numbersOf(const ir::NcBlock& block) {
  ir::NcWords out;
  for (const ir::Word& word : block.words) {
    if (word.address > 'Z') continue; // `,C`
    const double* value = ir::constantValue(word.value);
    stdlib::addWord(out, word.address, value == nullptr ? std::nullopt : std::optional(*value));
  }
  return out;
}

// "": none is for a lathe.
std::string latheOf(const std::vector<const ir::Program*>& programs, std::size_t made,
                    const SourceMap& sources) {
  stdlib::LatheSigns signs;
  std::vector<SourceRange> places;
  for (std::size_t i = made; i < programs.size(); ++i)
    for (const ir::ProgramStatement& statement : programs[i]->body) {
      const auto* block = std::get_if<ir::NcBlock>(&statement.node);
      if (block == nullptr) continue;
      signs.look(numbersOf(*block), places.size());
      if (signs.isOfMill()) return "";
      places.push_back(statement.origin.range());
    }
  const auto sign = signs.sign();
  return sign ? latheText(sources.line(places[sign->at]), sign->what) : "";
}

} // namespace

Bytecode compile(const std::vector<const ir::Program*>& programs, const stdlib::Control& control,
                 const SourceMap& sources, std::size_t made) {
  Compiler compiler(control, sources);
  if (!control.turning) compiler.refuseLathe(latheOf(programs, made, sources));
  for (const ir::Program* program : programs)
    compiler.add(*program);
  return compiler.finish();
}

void Compiler::add(const ir::Program& program) {
  program_ = &program;
  temporaries_ = 0;
  loop_ = 0;
  open_.clear();
  jumps_.clear();
  if (code_.outerLoops.empty()) code_.outerLoops.push_back(0);
  labelPlaces_.assign(program.labels.size(), kNoCell);
  labelLoops_.assign(program.labels.size(), 0);
  findLoops();
  Routine routine;
  routine.number = program.nameKind == ir::Program::NameKind::Name ? 0 : program.number;
  routine.program = &program;
  routine.begin = static_cast<std::uint32_t>(code_.instructions.size());
  for (at_ = 0; at_ < program.body.size(); ++at_)
    statement(program.body[at_]);
  if (at_ > 0) --at_;
  loop_ = 0;
  textEnd();
  emit(Op::End);
  routine.end = static_cast<std::uint32_t>(code_.instructions.size());
  for (const OpenJump& jump : jumps_) {
    Instruction& instruction = code_.instructions[jump.instruction];
    const std::uint32_t place = jump.label < labelPlaces_.size() ? labelPlaces_[jump.label] : kNoCell;
    if (place != kNoCell)
      instruction.c = place;
    else
      instruction = {Op::Refuse, 0, 0, text("a jump to a label that is nowhere"), 0};
  }
  for (std::size_t label = 0; label < program.labels.size(); ++label)
    if (program.labels[label].number != 0 && labelPlaces_[label] != kNoCell)
      routine.labels.push_back({program.labels[label].number, labelPlaces_[label], labelLoops_[label]});
  std::sort(routine.labels.begin(), routine.labels.end(), [](const NumberedPlace& a, const NumberedPlace& b) {
    return a.number != b.number ? a.number < b.number : a.place < b.place;
  });
  code_.routines.push_back(std::move(routine));
}

Bytecode Compiler::finish() {
  for (std::uint32_t i = 0; i < code_.routines.size(); ++i)
    if (code_.routines[i].number != 0) code_.byNumber.push_back(i);
  std::stable_sort(code_.byNumber.begin(), code_.byNumber.end(), [&](std::uint32_t a, std::uint32_t b) {
    return code_.routines[a].number < code_.routines[b].number;
  });
  return std::move(code_);
}

// Which loop each label is in, before jumps to it are met.
void Compiler::findLoops() {
  loopIds_.assign(program_->body.size(), 0);
  std::vector<std::uint32_t> open = {0};
  for (std::size_t i = 0; i < program_->body.size(); ++i) {
    match(
        program_->body[i],
        [&](const ir::Loop&) {
          loopIds_[i] = static_cast<std::uint32_t>(code_.outerLoops.size());
          code_.outerLoops.push_back(open.back());
          open.push_back(loopIds_[i]);
        },
        [&](const ir::LoopEnd&) {
          if (open.size() > 1) open.pop_back();
        },
        [&](const ir::Label& node) {
          if (node.label < labelLoops_.size()) labelLoops_[node.label] = open.back();
        },
        [](const ir::OneOf<ir::Jump, ir::Branch, ir::Store, ir::Comment, ir::NcBlock, ir::JumpTo, ir::Call,
                           ir::Exit, ir::Raise, ir::Notice, ir::Port, ir::Print, ir::NameVariables> auto&) {
        });
  }
}

std::uint32_t Compiler::emit(Op op, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint8_t detail) {
  const auto place = static_cast<std::uint32_t>(code_.instructions.size());
  code_.instructions.push_back({op, detail, a, b, c});
  code_.statements.push_back(at_);
  code_.lines.push_back(line_);
  code_.loops.push_back(loop_);
  return place;
}

std::uint32_t Compiler::text(std::string text) {
  code_.texts.push_back(std::move(text));
  return static_cast<std::uint32_t>(code_.texts.size() - 1);
}

void Compiler::refuse(std::string why) {
  emit(Op::Refuse, 0, text(std::move(why)));
}

void Compiler::jumpTo(std::uint32_t instruction, ir::LabelId label) {
  jumps_.push_back({instruction, label});
}

bool Compiler::reaches(ir::LabelId label) const {
  return label < labelLoops_.size() && !code_.entersLoop(loop_, labelLoops_[label]);
}

void Compiler::statement(const ir::ProgramStatement& statement) {
  temporaries_ = 0;
  line_ = sources_.line(statement.origin.range());
  std::optional<std::uint32_t> over;
  if (statement.blockDelete != 0) over = emit(Op::SkipDelete, 0, 0, 0, statement.blockDelete);
  match(statement, *this);
  if (over) code_.instructions[*over].c = static_cast<std::uint32_t>(code_.instructions.size());
}

void Compiler::operator()(const ir::Label& label) {
  if (label.label >= labelPlaces_.size()) return refuse("a label that the program does not list");
  labelPlaces_[label.label] = static_cast<std::uint32_t>(code_.instructions.size());
  const std::uint64_t number = program_->labels[label.label].number;
  if (number != 0 && number < UINT32_MAX) emit(Op::Sequence, static_cast<std::uint32_t>(number));
}

void Compiler::operator()(const ir::Store& store) {
  const std::optional<std::uint32_t> number = literalNumber(store.number);
  if (number) {
    if (const std::uint32_t cell = layout_.cellOf(*number); cell != CellLayout::kNone) {
      const std::uint32_t from = value(store.value, cell);
      if (from != cell) emit(Op::Copy, from, 0, cell);
      return;
    }
    const std::uint32_t from = value(store.value);
    emit(Op::Write, *number, from);
    return;
  }
  const std::uint32_t at = operand(store.number);
  const std::uint32_t from = value(store.value);
  emit(Op::WriteAt, at, from);
}

namespace {
constexpr const char* kIntoLoop =
    "a jump into a loop from outside: the control does not know how it was begun";
}

void Compiler::operator()(const ir::Jump& jump) {
  if (!reaches(jump.target)) return refuse(kIntoLoop);
  jumpTo(emit(Op::Jump), jump.target);
}

void Compiler::operator()(const ir::JumpTo& jump) {
  emit(Op::JumpTo, operand(jump.number));
}

void Compiler::operator()(const ir::Branch& branch) {
  if (reaches(branch.target)) {
    if (const auto place = jumpIf(branch.condition, true)) jumpTo(*place, branch.target);
    return;
  }
  const auto over = jumpIf(branch.condition, false);
  refuse(kIntoLoop);
  if (over) code_.instructions[*over].c = static_cast<std::uint32_t>(code_.instructions.size());
}

// The condition is at both ends, so that a pass takes one jump.
void Compiler::operator()(const ir::Loop& loop) {
  const std::uint32_t outer = loop_;
  loop_ = loopIds_[at_];
  if (loop.condition != nullptr) {
    loop_ = outer;
    if (const auto leave = jumpIf(loop.condition, false)) jumpTo(*leave, loop.end);
    loop_ = loopIds_[at_];
  }
  open_.push_back({&loop, static_cast<std::uint32_t>(code_.instructions.size())});
}

void Compiler::operator()(const ir::LoopEnd&) {
  if (open_.empty()) return refuse("END without a loop");
  const OpenLoop loop = open_.back();
  open_.pop_back();
  if (loop.loop->condition == nullptr)
    emit(Op::Jump, 0, 0, loop.body);
  else if (const auto again = jumpIf(loop.loop->condition, true))
    code_.instructions[*again].c = loop.body;
  loop_ = code_.outerLoops[loop_];
}

void Compiler::operator()(const ir::NcBlock& block) {
  if (!lathe_.empty())
    if (const std::string_view meaning = stdlib::meaningOnLathe(numbersOf(block)); !meaning.empty())
      return refuse(onLatheText(lathe_, meaning));
  words(block, false);
}

void Compiler::words(const ir::NcBlock& block, bool positions) {
  for (const ir::Word& word : block.words)
    if (word.address > 'Z')
      return refuse(word.address == 'a'
                        ? "`,A` is the angle of a straight line, from which the control computes the other "
                          "coordinate; Dotek does not follow it; write the point for a run here"
                        : "`,C` is a chamfer and `,R` a rounding at the corner to the next block; Dotek does "
                          "not follow them; write the points of the chamfer, or an arc, for a run here");
  BlockSlots slots;
  slots.positions = positions;
  std::vector<WordSlot> all;
  for (const ir::Word& word : block.words) {
    WordSlot slot;
    slot.letter = word.address;
    const auto* constant = std::get_if<ir::Constant>(&word.value->node);
    slot.computed = constant == nullptr || constant->digits.empty();
    if (!slot.computed) {
      const std::size_t point = constant->digits.find('.');
      slot.point = point != std::string::npos;
      slot.places =
          slot.point
              ? static_cast<std::uint8_t>(std::min<std::size_t>(99, constant->digits.size() - point - 1))
              : std::uint8_t{0};
    }
    letter_ = word.address;
    slot.cell = value(word.value);
    letter_ = 0;
    all.push_back(slot);
    if (word.address != 'G' && word.address != 'M' && word.address != 'T') continue;
    if (slot.computed) {
      slots.mayCall = slots.mayStop = true;
    } else {
      slots.mayCall = slots.mayCall || findCallCode(control_, word.address, constant->value) != nullptr;
      slots.mayStop = slots.mayStop || stdlib::stopsReadingAhead(control_, word.address, constant->value) ||
                      (word.address == 'G' && constant->value == 103);
    }
  }
  slots.firstWord = static_cast<std::uint32_t>(code_.words.size());
  slots.words = static_cast<std::uint32_t>(all.size());
  slots.line = line_;
  code_.words.insert(code_.words.end(), all.begin(), all.end());
  code_.blocks.push_back(slots);
  emit(Op::Block, static_cast<std::uint32_t>(code_.blocks.size() - 1));
}

void Compiler::operator()(const ir::Call& call) {
  CallSlots slots;
  slots.kind = call.kind;
  if (call.program != nullptr) slots.program = value(call.program);
  if (call.repeats != nullptr) slots.repeats = value(call.repeats);
  std::vector<ArgumentSlot> arguments;
  for (const ir::CallArgument& argument : call.arguments) {
    ArgumentSlot slot;
    slot.local = argument.local;
    slot.bare =
        ir::numberWithoutPoint(argument.value) != nullptr && control_.countsIncrements(argument.letter);
    slot.cell = value(argument.value);
    const bool block = slot.local == 0 && call.kind == ir::CallKind::Subprogram; // to begin at
    if (!block && (slot.local == 0 || slot.local > layout_.locals()))
      return refuse(fmt::format("the argument {} sets no local variable", argument.letter));
    arguments.push_back(slot);
  }
  slots.firstArgument = static_cast<std::uint32_t>(code_.arguments.size());
  slots.arguments = static_cast<std::uint32_t>(arguments.size());
  code_.arguments.insert(code_.arguments.end(), arguments.begin(), arguments.end());
  code_.calls.push_back(slots);
  emit(Op::Call, static_cast<std::uint32_t>(code_.calls.size() - 1));
}

void Compiler::operator()(const ir::Exit& exit) {
  emit(Op::Exit, exit.block == nullptr ? kNoCell : value(exit.block));
}

void Compiler::operator()(const ir::Raise& raise) {
  const std::uint32_t number = operand(raise.number);
  emit(Op::Raise, number, text(raise.text));
}

void Compiler::operator()(const ir::Notice& notice) {
  const std::uint32_t number = operand(notice.number); // what it computes may raise an alarm
  emit(Op::Notice, number, text(notice.text));
}

void Compiler::operator()(const ir::Port& port) {
  emit(Op::OpenPort, 0, 0, 0, port.open ? 1 : 0);
}

void Compiler::operator()(const ir::Print& print) {
  code_.prints.push_back(&print);
  emit(Op::Print, static_cast<std::uint32_t>(code_.prints.size() - 1));
}

void Compiler::operator()(const ir::NameVariables& names) {
  code_.names.push_back(&names);
  emit(Op::Name, static_cast<std::uint32_t>(code_.names.size() - 1));
}

} // namespace dotek::sim
