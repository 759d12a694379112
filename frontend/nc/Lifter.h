// Private to Lift*.cpp: one block on its path to statements.
#pragma once

#include "frontend/nc/Lift.h"
#include "stdlib/ReadCall.h"

#include <map>
#include <string_view>

namespace dotek::frontend::nc {

// The code times ten: `G54.1` is 541. nullopt: no constant with at most one decimal.
std::optional<std::uint32_t> codeTenths(const Word& word);
// The word's number where it is one, sign included.
std::optional<double> literalOf(const Expression& value);
// `Z-5.`; of a word with a hole or a formula its address.
std::string wordText(const Word& word);

// How a word's number is read.
struct Reading {
  ir::Kind kind = ir::Kind::Number;
  bool increments = false; // without a point it counts least increments where the control does so
};

class Lifter {
public:
  Lifter(const Block& block, LiftContext& context, std::vector<ir::CycleStatement>& out);

  bool run();

private:
  struct Code {
    const Word* word = nullptr;
    std::uint32_t tenths = 0;
    const stdlib::CodeInfo* info = nullptr; // nullptr: not in the control's table
  };
  // What the words of a block ask for.
  struct Plan {
    std::vector<ir::SetMode> modes;
    std::optional<ir::ProbePower> probe;
    std::optional<ir::Spindle> spindle;
    std::optional<ir::Coolant> coolant;
    std::optional<ir::Stop> stop;
    std::optional<ir::Motion> motion;
    bool dwell = false;
    bool skipped = false;   // a word was left out with a note
    std::string opaque;     // the word that makes the block opaque, "" for none
    bool anyEffect = false; // of an opaque block: it may change any mode
  };

  // LiftRun: blocks without a call.
  bool assignments();
  bool computedAssignment(const Assignment& assignment);
  bool readCodes(char address);
  bool onePerGroup();
  bool words();
  bool function(const Code& code, Plan& plan);
  bool miscellaneous(const Code& code, Plan& plan);
  void modalCodes(Plan& plan);
  void leftOver(Plan& plan);
  // Reports a feed in a block without a move.
  void feedAlone();
  // Refuses a number that is known and below 0, or 0 where `zero` is not allowed.
  bool inRange(const Word& word, std::string_view what, bool zero);
  bool motion(const ir::ExpressionPtr& feed);
  bool dwell();
  bool opaque(const Plan& plan);
  // Refuses a coordinate of an opaque block under a mode that is not known.
  bool knownModes(const Plan& plan);

  // LiftFlow
  bool statement();
  void enter(ir::LabelId label);
  void arrive(ir::LabelId label);
  ir::ConditionPtr condition(const Condition& condition); // null pointer: reported

  // LiftCall
  bool call(std::uint32_t program, const Word& programWord);
  // `words`: of the letters of the reading.
  bool protectedMove(const stdlib::CallReading& reading, const std::vector<const Word*>& words);
  bool measure(const stdlib::CallReading& reading, const std::vector<const Word*>& words);
  bool cycle(const stdlib::CallReading& reading, const std::vector<const Word*>& words);
  bool isExtended(const stdlib::MacroArgument& argument, double number) const;
  ir::ExpressionPtr workSystem(const stdlib::MacroArgument& argument, const Word& word,
                               const ir::ExpressionPtr& read);
  ir::ExpressionPtr argument(const stdlib::MacroArgument& argument, const Word& word);

  // LiftValue: null pointers are reported.
  ir::ExpressionPtr value(const Word& word, Reading reading);
  ir::ExpressionPtr rawValue(const Word& word); // of an opaque block
  ir::ExpressionPtr literal(const Word& word, double value, const std::string& digits, bool point,
                            Reading reading);
  ir::ExpressionPtr holeValue(const Expression& at, const Hole& hole, Reading reading);
  bool checkPicture(SourceRange where, const Hole& hole, Reading reading);
  ir::ExpressionPtr formula(const Expression& expression, bool inWord);
  ir::ExpressionPtr operand(const Expression& expression, bool inWord);
  ir::ExpressionPtr operation(const Expression& expression, const Operation& operation, bool inWord);
  ir::ExpressionPtr functionCall(const Expression& expression, const FunctionCall& call, bool inWord);
  ir::ExpressionPtr variableValue(const Expression& expression, const VariableRef& variable);
  // The number of a variable is an expression of variables: #[541+#540].
  static bool isComputed(const Expression& number);
  // It, where it counts from a common variable; null pointer: reported.
  ir::ExpressionPtr computedNumber(const Expression& number);
  std::optional<std::uint32_t> variableNumber(const Expression& number);
  std::optional<double> fixedValue(const Hole& hole) const;
  std::optional<double> knownNumber(const Expression& value) const;
  std::optional<std::uint32_t> knownTenths(const Word& word) const;
  double increments(double count) const; // of that many least increments, mm

  const Word* find(char address) const;
  template <class Node> void add(Node node) { out_.push_back({std::move(node), origin_}); }
  template <class Id, class... Args> bool refuse(SourceRange range, const Args&... args) {
    context_.diagnostics.report<Id>(range, args...);
    return false;
  }

  const Block& block_;
  LiftContext& context_;
  std::vector<ir::CycleStatement>& out_;
  ir::Origin origin_;
  std::vector<Code> codes_; // G and M words, in source order
};

} // namespace dotek::frontend::nc
