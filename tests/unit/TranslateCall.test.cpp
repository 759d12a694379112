// Calls of one vendor's macros in the words of another's.
#include "backends/fanuc/TranslateCall.h"

#include "stdlib/DataFiles.h"

#include <cstdlib>
#include <doctest/doctest.h>
#include <fmt/format.h>

using namespace dotek;
using namespace dotek::backends::fanuc;

namespace {

stdlib::MacroSet macros(std::string_view name) {
  return *stdlib::MacroSet::load(stdlib::DataFiles(), name);
}

// "#24", "-5.", "20"
ir::ExpressionPtr value(const std::string& text) {
  if (text.starts_with("-#")) return ir::unary(ir::UnaryOp::Negate, value(text.substr(1)));
  if (text[0] == '#') return ir::machineVariable(ir::constant(std::strtod(text.c_str() + 1, nullptr)));
  return ir::constant(std::strtod(text.c_str(), nullptr), {}, text);
}

// "9811 X#24 S3"; "X[#24-#5041]" is written "X#24-#5041".
ir::Call call(const std::string& text) {
  ir::Call out;
  std::size_t at = text.find(' ');
  out.program = ir::constant(std::strtod(text.c_str(), nullptr));
  while (at < text.size()) {
    const std::size_t end = std::min(text.find(' ', at + 1), text.size());
    const std::string word = text.substr(at + 1, end - at - 1);
    const std::size_t minus = word.find('-', 2);
    ir::ExpressionPtr read = value(word.substr(1, minus - 1));
    if (minus != std::string::npos)
      read = ir::binary(ir::BinaryOp::Subtract, ir::unary(ir::UnaryOp::NullAsZero, read),
                        ir::unary(ir::UnaryOp::NullAsZero, value(word.substr(minus + 1))));
    out.arguments.push_back({word[0], stdlib::localOf(word[0]), read, {}});
    at = end;
  }
  return out;
}

std::string show(const ir::ExpressionPtr& expression) {
  if (const double* number = ir::constantValue(expression)) return fmt::format("{:g}", *number);
  if (const auto* variable = std::get_if<ir::MachineVariable>(&expression->node))
    return "#" + show(variable->number);
  if (const auto* unary = std::get_if<ir::Unary>(&expression->node))
    return unary->op == ir::UnaryOp::NullAsZero ? show(unary->operand)
           : unary->op == ir::UnaryOp::Negate   ? "-" + show(unary->operand)
           : unary->op == ir::UnaryOp::Absolute ? "ABS" + show(unary->operand)
                                                : "ROUND[" + show(unary->operand) + "]";
  const auto& binary = std::get<ir::Binary>(expression->node);
  const char* const sign = binary.op == ir::BinaryOp::Add        ? "+"
                           : binary.op == ir::BinaryOp::Multiply ? "*"
                           : binary.op == ir::BinaryOp::Divide   ? "/"
                                                                 : "-";
  return "[" + show(binary.left) + sign + show(binary.right) + "]";
}

std::string show(const ir::Condition& condition) {
  const auto& comparison = std::get<ir::Comparison>(condition.node);
  constexpr std::string_view kNames[] = {"EQ", "NE", "LT", "GT", "LE", "GE", "EQ", "NE"};
  return show(comparison.left) + " " + std::string(kNames[static_cast<std::size_t>(comparison.relation)]) +
         " " + show(comparison.right);
}

// The travel and 10 mm beyond.
std::string beyond(const std::string& travel, const std::string& more = "10") {
  return "[" + travel + "*[1+[" + more + "/ABS" + travel + "]]]";
}

struct Case {
  stdlib::MacroSet source, target;
  stdlib::Control control;
  ir::LabelId labels = 0;
  TranslateSettings settings() {
    return {source, target, control, [this] { return labels++; }, 150};
  }
};

Case between(std::string_view source, std::string_view target, std::string_view control = "fanuc-0i-md") {
  return {macros(source), macros(target), *stdlib::Control::load(stdlib::DataFiles(), control)};
}

std::string translated(Case one, const std::string& text) {
  const TranslatedCall out = translateCall(call(text), one.settings());
  if (!out.refusal.empty()) {
    CHECK(out.before.empty());
    CHECK_FALSE(out.call);
    return "refused: " + out.refusal;
  }
  std::string shown;
  for (const ir::ProgramStatement& statement : out.before) {
    if (const auto* block = std::get_if<ir::NcBlock>(&statement.node))
      shown += fmt::format("{}{} ", block->words[0].address, show(block->words[0].value));
    else if (const auto* branch = std::get_if<ir::Branch>(&statement.node))
      shown += "unless " + show(*branch->condition) + " ";
    else if (const auto* raise = std::get_if<ir::Raise>(&statement.node))
      shown += fmt::format("alarm {} ({}) ", show(raise->number), raise->text);
    else
      CHECK(std::holds_alternative<ir::Label>(statement.node));
  }
  if (!out.call) return shown;
  shown += "P" + show(out.call->program);
  for (const ir::CallArgument& argument : out.call->arguments) {
    CHECK(argument.local == stdlib::localOf(argument.letter));
    shown += fmt::format(" {}{}", argument.letter, show(argument.value));
  }
  return shown;
}

std::string toEasy(const std::string& text, std::string_view control = "fanuc-0i-md") {
  return translated(between("inspection-plus", "easyprobe", control), text);
}
std::string toPlus(const std::string& text, std::string_view control = "fanuc-0i-md") {
  return translated(between("easyprobe", "inspection-plus", control), text);
}

} // namespace

TEST_CASE("protected moves keep their coordinates") {
  CHECK(toPlus("9770 X10. Y#5 F1000.") == "P9810 X10 Y#5 F1000");
  CHECK(toEasy("9810 Z#26 F#9") == "P9770 Z#26 F#9");
  CHECK(toEasy("9810 Z5. M1").starts_with("refused: `M1` of P9810 (protected move) raises no alarm"));
  Case one = between("easyprobe", "inspection-plus");
  CHECK(translateCall(call("9770 Z5."), one.settings()).notes.at(0).find("feed") != std::string::npos);
}

TEST_CASE("a surface: coordinate and travel by the position, Z without the tool's length") {
  CHECK(toEasy("9811 X20. S3") == "G53 P9023 S56 X" + beyond("[20-#5041]") + " I20");
  CHECK(toEasy("9811 Y#25 S1") ==
        "G53 unless #25 NE #0 alarm 150 (Y IS MISSING) P9023 S54 Y" + beyond("[#25-#5042]") + " J#25");
  CHECK(toEasy("9811 X-#24 S1") ==
        "G53 unless #24 NE #0 alarm 150 (X IS MISSING) P9023 S54 X" + beyond("[-#24-#5041]") + " I-#24");
  CHECK(toEasy("9811 Z-5. S6") == "G53 P9023 S59 Z" + beyond("[-5-[#5043-#5083]]") + " K-5");
  // Without S EasyProbe cannot measure; Q says how far beyond it looks.
  CHECK(toEasy("9811 X20.") ==
        "refused: P9023 of `easyprobe` wants `S`, its system, and the call states none");
  CHECK(toEasy("9811 X20. S1 Q5.") == "G53 P9023 S54 X" + beyond("[20-#5041]", "5") + " I20");
  CHECK(toEasy("9811 X20. S7").find("names no system G54 to G59") != std::string::npos);
  CHECK(toEasy("9811 X20. S101")
            .find("beyond G59, which `easyprobe` does not set; take macros that set it "
                  "(`--probe-macros dotek`)") != std::string::npos);
}

TEST_CASE("a computed system is checked before the call") {
  CHECK(toEasy("9811 X20. S#19") ==
        "G53 unless #19 NE #0 alarm 150 (S IS MISSING) unless #19 GE 1 alarm 150 (S IS NOT G54 TO G59) "
        "unless #19 LE 6 alarm 150 (S IS NOT G54 TO G59) unless #19 EQ ROUND[#19] alarm 150 (S IS NOT G54 TO "
        "G59) P9023 S[#19+53] X" +
            beyond("[20-#5041]") + " I20");
}

TEST_CASE("a nominal becomes a correction only where it is the expected coordinate by proof") {
  // X[#26-#5041] I#26: the surface is expected at #26, which is its nominal.
  CHECK(toPlus("9023 S56. X#26-#5041 I#26") == "G53 P9811 X[#5041+[#26-#5041]] S3");
  CHECK(toPlus("9023 S56. X10. I0.").find("that is not known") != std::string::npos);
  CHECK(toPlus("9023 S56. Y#26-#5041 J#26").find("that is not known") != std::string::npos); // X, not Y
  CHECK(toPlus("9023 D30. S56. I#5041 J#5042") == "G53 P9814 D30 S3");
  CHECK(toPlus("9023 D30. S56. I30. J30.").find("that is not known") != std::string::npos);
}

TEST_CASE("a bore: the centre is expected where the probe is") {
  CHECK(toEasy("9814 D30. S2") == "G53 P9023 D30 S55 I#5041 J#5042");
  CHECK(toEasy("9814 D30.").find("wants `S`") != std::string::npos);
  CHECK(toEasy("9814 D30. Z-5. R5. S1") == "refused: `easyprobe` has no macro for boss");
  CHECK(toEasy("9812 X30. S1") == "refused: `easyprobe` has no macro for pocket");
}

TEST_CASE("a number without a point keeps its length") {
  // The 0i-MD's table counts millimetres; a control that counts increments hands over 0.020 mm.
  CHECK(toEasy("9811 X20 S3") == "G53 P9023 S56 X" + beyond("[20-#5041]") + " I20");
  Case one = between("inspection-plus", "easyprobe");
  one.control.decimal = stdlib::DecimalMode::Increment;
  const TranslatedCall scaled = translateCall(call("9811 X20 S3"), one.settings());
  CHECK(translated(std::move(one), "9811 X20 S3") == "G53 P9023 S56 X" + beyond("[0.02-#5041]") + " I0.02");
  REQUIRE(scaled.call);
  for (const ir::CallArgument& argument : scaled.call->arguments)
    if (const auto* constant = std::get_if<ir::Constant>(&argument.value->node))
      CHECK(constant->digits == (argument.letter == 'S' ? "56." : "0.02"));
}

TEST_CASE("the probe's switch: the machine's code where the set has no macro") {
  CHECK(toEasy("9832") == "M31 ");
  CHECK(toEasy("9833") == "M32 ");
  CHECK(toEasy("9832 W1").starts_with("refused: `W`"));
  Case one = between("inspection-plus", "easyprobe");
  std::erase_if(one.control.codes,
                [](const stdlib::CodeInfo& code) { return code.function == stdlib::Function::ProbeOn; });
  CHECK(translated(std::move(one), "9832").starts_with("refused: neither"));
}

TEST_CASE("calls that have no single meaning, or none that is known, are refused") {
  CHECK(toEasy("9999 X1.") == "refused: `inspection-plus` has no macro P9999");
  CHECK(toEasy("9811 X1. A2.").find("no argument `A`") != std::string::npos);
  CHECK(toEasy("9811 S1").find("lacks X or Y or Z") != std::string::npos);
  CHECK(toEasy("9811 X1. S1 T2").find("does not take S and T together") != std::string::npos);
  CHECK(toEasy("9816 X1. Y1.").starts_with("refused:"));
  Case one = between("inspection-plus", "easyprobe");
  ir::Call repeated = call("9811 X1. S1");
  repeated.repeats = ir::constant(2);
  CHECK_FALSE(translateCall(repeated, one.settings()).refusal.empty());
  ir::Call modal = call("9811 X1. S1");
  modal.kind = ir::CallKind::AfterMoves;
  CHECK_FALSE(translateCall(modal, one.settings()).refusal.empty());
  ir::Call computed = call("9811 X1. S1");
  computed.program = value("#1");
  CHECK_FALSE(translateCall(computed, one.settings()).refusal.empty());
  ir::Call second = call("9811 X1. S1");
  second.arguments[0].local = 27; // argument specification II
  CHECK_FALSE(translateCall(second, one.settings()).refusal.empty());
  one.control.variables.position.reset();
  CHECK(translateCall(call("9811 X1. S1"), one.settings()).refusal.find("no variable of the position") !=
        std::string::npos);
}

TEST_CASE("the same set keeps the call as it is") {
  Case one = between("inspection-plus", "inspection-plus");
  const TranslatedCall out = translateCall(call("9811 X#24 Q5. H.1"), one.settings());
  REQUIRE(out.call);
  CHECK(out.before.empty());
  CHECK(out.call->arguments.size() == 3);
}

TEST_CASE("results: the same output where both sets document it, else refused") {
  const auto result = [](std::string_view from, std::string_view to, const std::string& text,
                         std::uint32_t variable) {
    Case one = between(from, to);
    const TranslatedVariable out = translateResult(call(text), variable, one.settings());
    return out.refusal.empty() ? "#" + std::to_string(out.variable) : "refused: " + out.refusal;
  };
  CHECK(result("inspection-plus", "easyprobe", "9814 D30. S1", 550) == "#550");
  CHECK(result("inspection-plus", "easyprobe", "9814 D30. S1", 110).starts_with("refused: what #110 holds"));
  CHECK(result("inspection-plus", "easyprobe", "9814 D30. S1", 138) ==
        "refused: `easyprobe` is not known to leave the size in a variable");
  CHECK(result("easyprobe", "inspection-plus", "9023 D30. S56. I0. J0.", 138).find("no source says") !=
        std::string::npos);
  CHECK(result("inspection-plus", "inspection-plus", "9811 X1.", 138) == "#138");
  // A set of one's own that documents the size elsewhere.
  Case own = between("inspection-plus", "inspection-plus");
  own.target.name = "own";
  for (stdlib::MacroSignature& signature : own.target.signatures)
    for (stdlib::MacroResult& one : signature.results)
      one.variable += 50;
  CHECK(translateResult(call("9814 D30."), 138, own.settings()).variable == 188);
  CHECK_FALSE(translateResult(call("9811 X1."), 138, own.settings()).refusal.empty()); // not documented
  CHECK(translateResult(call("9811 X1."), 135, own.settings()).variable == 185);
}
