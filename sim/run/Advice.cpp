#include "sim/run/Advice.h"

#include "ir/Walk.h"
#include "stdlib/MacroSet.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <set>

namespace dotek::sim {
namespace {

constexpr double kLastLocal = 33;

std::uint32_t localOf(const ir::ExpressionPtr& number) {
  const double* value = ir::constantValue(number);
  return value != nullptr && *value >= 1 && *value <= kLastLocal
             ? static_cast<std::uint32_t>(std::lround(*value))
             : 0;
}

} // namespace

std::string argumentsOf(const ir::Program& program) {
  std::string out;
  std::set<std::uint32_t> known;
  for (const ir::ProgramStatement& statement : program.body) {
    ir::eachNode(statement, [&](const ir::Expression& node) {
      const auto* variable = std::get_if<ir::MachineVariable>(&node.node);
      const std::uint32_t local = variable == nullptr ? 0 : localOf(variable->number);
      if (local == 0 || !known.insert(local).second) return;
      if (const char letter = stdlib::letterOfLocal(local); letter != 0) out += letter;
    });
    if (const auto* store = std::get_if<ir::Store>(&statement.node))
      if (const std::uint32_t local = localOf(store->number); local != 0) known.insert(local);
  }
  return out;
}

std::string callAdvice(const ir::Program& program, bool part) {
  const std::string letters = argumentsOf(program);
  bool returns = false, probes = false, ends = false;
  for (const ir::ProgramStatement& one : program.body) {
    returns = returns || std::holds_alternative<ir::Exit>(one.node);
    const auto* block = std::get_if<ir::NcBlock>(&one.node);
    for (std::size_t i = 0; block != nullptr && i < block->words.size(); ++i) {
      const double* code = ir::constantValue(block->words[i].value);
      if (code == nullptr) continue;
      probes = probes || (block->words[i].address == 'G' && *code == 31);
      ends = ends || (block->words[i].address == 'M' && (*code == 2 || *code == 30));
    }
  }
  // A macro returns; what ends with M30 reads its locals for other reasons.
  if (!returns || (letters.empty() && !probes && ends)) return "";
  const std::string rest =
      probes && !part
          ? "; it probes: `--part PART.toml --machine MACHINE.toml` say what it touches with what, `--at "
            "X,Y,Z` where it begins"
          : "";
  if (letters.empty())
    return "at the end of a main program M99 begins it anew; `--call \" \"` calls it once, as a macro "
           "without "
           "arguments" +
           rest;
  std::string read, call;
  for (const char letter : letters) {
    read += fmt::format("{}{} (#{})", read.empty() ? "" : ", ", letter, stdlib::localOf(letter));
    call += fmt::format("{}{}..", call.empty() ? "" : " ", letter);
  }
  return fmt::format(
      "it reads the arguments {}, and a main program gets none; `--call \"{}\"` calls it with those that "
      "you write there{}",
      read, call, rest);
}

} // namespace dotek::sim
