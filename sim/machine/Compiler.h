// Programs to instructions. A dialect derives from it: it says what its plain blocks mean (sim/mikroprog);
// jumps, calls, loops and expressions of the IR are the same for all. Private to Compile*.cpp and to
// dialects.
#pragma once

#include "sim/machine/Compile.h"

#include <map>
#include <optional>
#include <string>
#include <utility>

namespace dotek::sim {

class Compiler {
public:
  Compiler(const stdlib::Control& control, const SourceMap& sources)
      : control_(control), sources_(sources), layout_(control) {}
  virtual ~Compiler() = default;
  Compiler(const Compiler&) = delete;
  Compiler& operator=(const Compiler&) = delete;
  void add(const ir::Program& program);
  // The programs are for a lathe, as the text says why: blocks that mean something else there are refused.
  void refuseLathe(std::string why) { lathe_ = std::move(why); }
  Bytecode finish();

  // The code of one statement (Compile.cpp).
  void operator()(const ir::Label& label);
  void operator()(const ir::Comment&) {}
  virtual void operator()(const ir::Store& store);
  void operator()(const ir::Jump& jump);
  void operator()(const ir::JumpTo& jump);
  void operator()(const ir::Branch& branch);
  void operator()(const ir::Loop& loop);
  void operator()(const ir::LoopEnd& end);
  virtual void operator()(const ir::NcBlock& block);
  void operator()(const ir::Call& call);
  void operator()(const ir::Exit& exit);
  void operator()(const ir::Raise& raise);
  void operator()(const ir::Notice& notice);
  void operator()(const ir::Port& port);
  void operator()(const ir::Print& print);
  void operator()(const ir::NameVariables& names);

protected:
  // ---- statements (Compile.cpp)
  virtual void textEnd() {} // the last code of a program, where its text ends without a block that ends it
  void words(const ir::NcBlock& block, bool positions); // as BlockSlots::positions

  std::uint32_t emit(Op op, std::uint32_t a = 0, std::uint32_t b = 0, std::uint32_t c = 0,
                     std::uint8_t detail = 0);
  void refuse(std::string why);
  std::uint32_t text(std::string text);
  void jumpTo(std::uint32_t instruction, ir::LabelId label); // its c, once the place of the label is known
  bool reaches(ir::LabelId label) const;                     // without entering a loop

  // ---- expressions (CompileExpression.cpp)
  // The cell that holds the value; with `into` it is computed there. Null stays null.
  std::uint32_t value(const ir::ExpressionPtr& expression, std::uint32_t into = kNoCell);
  // The same where null counts as 0 for whoever reads the cell.
  std::uint32_t operand(const ir::ExpressionPtr& expression);
  std::uint32_t constant(double value);
  std::uint32_t temporary(std::uint32_t into = kNoCell);
  std::uint32_t read(const ir::MachineVariable& variable, std::uint32_t into);
  std::uint32_t unary(const ir::Unary& unary, std::uint32_t into);
  std::uint32_t binary(const ir::Binary& binary, std::uint32_t into);
  // Jumps where the condition holds, or where it does not; gives the instruction whose c is open. nullopt: it
  // never jumps.
  std::optional<std::uint32_t> jumpIf(const ir::ConditionPtr& condition, bool holds);
  std::uint32_t truth(const ir::ConditionPtr& condition); // cell of 1 or 0
  std::optional<std::uint32_t> literalNumber(const ir::ExpressionPtr& expression) const;

  const stdlib::Control& control_;
  const SourceMap& sources_;
  CellLayout layout_;
  Bytecode code_;

  // Of the program that is compiled.
  const ir::Program* program_ = nullptr;
  std::uint32_t at_ = 0; // statement

private:
  void findLoops();
  void statement(const ir::ProgramStatement& statement);

  std::string lathe_; // "": of a mill
  std::map<double, std::uint32_t> constants_;
  std::uint32_t temporaries_ = 0;
  std::uint32_t line_ = 0;
  char letter_ = 0; // of the word that is computed
  std::uint32_t loop_ = 0;
  std::vector<std::uint32_t> labelPlaces_, labelLoops_; // by label
  struct OpenLoop {
    const ir::Loop* loop;
    std::uint32_t body;
  };
  std::vector<OpenLoop> open_;
  std::vector<std::uint32_t> loopIds_; // by statement, of each Loop
  struct OpenJump {
    std::uint32_t instruction;
    ir::LabelId label;
  };
  std::vector<OpenJump> jumps_;
};

} // namespace dotek::sim
