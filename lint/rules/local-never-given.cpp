#include "frontend/macrob/Calls.h"
#include "ir/Walk.h"
#include "lint/NcProgram.h"
#include "lint/OwnCalls.h"
#include "stdlib/MacroSet.h"

#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>

namespace dotek::lint::rule {
namespace {

constexpr std::uint32_t kLastLocal = 33;

// A variable or a number, no calculation.
bool isPlain(const ir::Expression& expression) {
  const auto* unary = std::get_if<ir::Unary>(&expression.node);
  if (unary != nullptr && unary->op == ir::UnaryOp::NullAsZero) return isPlain(*unary->operand);
  return std::holds_alternative<ir::Constant>(expression.node) || variableNumber(expression).has_value();
}

// A store to a computed number that does not count from one above the locals: #[#1] may be any.
bool maySetLocal(const ir::ProgramStatement& statement) {
  const auto* store = std::get_if<ir::Store>(&statement.node);
  if (store == nullptr || storedNumber(statement)) return false;
  const auto first = store->number ? ir::firstNumber(store->number) : std::nullopt;
  return !first || *first <= kLastLocal;
}

// Letters that no call gives, two or more, and that the program does nothing with but add: shifts that may be
// left out, as I and J beside X and Y. One alone may be a misprint.
std::set<std::uint32_t> optionalShifts(const NcProgram& nc, const std::set<std::uint32_t>& given) {
  std::map<std::uint32_t, int> read;
  for (const VariableRead& one : nc.reads())
    if (one.number > 0 && one.number <= kLastLocal && !given.contains(one.number) &&
        stdlib::letterOfLocal(one.number) != 0)
      ++read[one.number];
  for (const ir::ProgramStatement& statement : nc.program.body)
    ir::eachNode(statement, [&](const ir::Expression& node) {
      const auto* sum = std::get_if<ir::Binary>(&node.node);
      if (sum == nullptr || (sum->op != ir::BinaryOp::Add && sum->op != ir::BinaryOp::Subtract)) return;
      for (const ir::ExpressionPtr& side : {sum->left, sum->right}) {
        const auto* asZero = std::get_if<ir::Unary>(&side->node);
        const bool plain = asZero == nullptr || asZero->op == ir::UnaryOp::NullAsZero;
        const auto number =
            plain ? variableNumber(asZero != nullptr ? *asZero->operand : *side) : std::nullopt;
        if (const auto at = number ? read.find(*number) : read.end(); at != read.end()) --at->second;
      }
    });
  std::set<std::uint32_t> out;
  for (const auto& [number, left] : read)
    if (left == 0) out.insert(number);
  if (out.size() < 2) out.clear();
  return out;
}

// `calls`: the locals that some call of the program sets; nullptr: nothing calls it.
void checkProgram(const NcProgram& nc, const std::set<std::uint32_t>* calls, Report& report) {
  const ir::Program& program = nc.program;
  std::set<std::uint32_t> given;
  if (calls != nullptr) given = *calls;
  for (const ir::ProgramStatement& statement : program.body) {
    if (maySetLocal(statement)) return;
    if (const auto number = storedNumber(statement)) given.insert(*number);
    const ir::Call* call = callOf(statement);
    if (call != nullptr && call->kind == ir::CallKind::Subprogram) return;
  }
  std::set<std::uint32_t> told, tested, asked;
  for (const ir::ProgramStatement& statement : program.body) {
    const auto* branch = std::get_if<ir::Branch>(&statement.node);
    if (branch == nullptr) continue;
    ir::eachNode(branch->condition, [&](const ir::Expression& node) {
      if (const auto number = variableNumber(node)) tested.insert(*number);
    });
    // An argument that is asked for may be left out; a local without a letter is always empty.
    if (const auto one = nullCompared(branch->condition)) asked.insert(*one);
    const auto number = nullTested(branch->condition);
    if (!number || *number == 0 || *number > kLastLocal || given.contains(*number)) continue;
    if (stdlib::letterOfLocal(*number) == 0 && told.insert(*number).second)
      report.at(statement.origin.range(),
                "#{} is asked whether it is empty, and it always is: no letter of a call sets it and the "
                "program does "
                "not; write the number of the argument that is meant",
                *number);
  }
  if (calls == nullptr) return;
  const std::set<std::uint32_t> optional = optionalShifts(nc, given);
  for (std::size_t i = 0; i < program.body.size(); ++i) {
    const ir::ProgramStatement& statement = program.body[i];
    const auto* branch = std::get_if<ir::Branch>(&statement.node);
    if ((branch != nullptr && nullCompared(branch->condition)) || callOf(statement) != nullptr) continue;
    // A flag that is compared as such may be left out.
    if (const auto* flag =
            branch == nullptr ? nullptr : std::get_if<ir::Comparison>(&branch->condition->node))
      if (isPlain(*flag->left) && isPlain(*flag->right)) continue;
    for (const auto& [number, range] : nc.reads(i)) {
      if (number == 0 || number > kLastLocal || given.contains(number) || optional.contains(number)) continue;
      // A test beside it shows that leaving it out is meant.
      if (asked.contains(number) || (branch == nullptr && tested.contains(number))) continue;
      if (!told.insert(number).second) continue;
      const char letter = stdlib::letterOfLocal(number);
      report.at(range.hasPlace() ? range : statement.origin.range(),
                "#{} is read here, no call in the files gives it{}, and the program does not set it; it is "
                "empty, and counts as 0 or drops the word; write the number that is meant{}",
                number, letter == 0 ? "" : fmt::format(" (by {})", letter),
                letter == 0 ? "" : fmt::format(", or `{}` in the call", letter));
    }
  }
}

// What some call gives, by program: of all files, those with errors too. nullopt: a call cannot be read.
std::optional<std::map<std::uint32_t, std::set<std::uint32_t>>> givenByProgram(const Project& project) {
  std::map<std::uint32_t, std::set<std::uint32_t>> out;
  std::set<std::uint32_t> shared; // by M98, with the locals of their caller
  for (const NcFile& file : project.programs)
    for (const macrob::Program& program : file.file->programs)
      for (const macrob::Block& block : program.blocks) {
        const auto* unread = std::get_if<macrob::Unread>(&block.body);
        if (unread != nullptr && unread->text.find("6") != std::string::npos &&
            unread->text.find('P') != std::string::npos)
          return std::nullopt;
        const auto* words = std::get_if<macrob::Words>(&block.body);
        const auto call = words == nullptr ? std::nullopt : macrob::callOf(*words);
        const auto number = call ? macrob::calledProgram(*call) : std::nullopt;
        if (!number) continue;
        if (call->kind == macrob::CallKind::Subprogram) shared.insert(*number);
        std::set<std::uint32_t>& given = out[*number];
        for (const macrob::CallArgument& argument : call->arguments)
          given.insert(argument.variable);
      }
  for (const std::uint32_t number : shared)
    out.erase(number);
  return out;
}

void check(const Project& project, Report& report) {
  const auto given = givenByProgram(project);
  if (!given) return;
  const auto& calls = *given;
  for (const auto& nc : programsOf(project)) {
    if (endsProgram(nc->program) || nc->program.number == 0) continue;
    const auto at = calls.find(static_cast<std::uint32_t>(nc->program.number));
    checkProgram(*nc, at == calls.end() ? nullptr : &at->second, report);
  }
}

} // namespace

DOTEK_LINT_RULE(local_never_given){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .check = check,
};

} // namespace dotek::lint::rule
