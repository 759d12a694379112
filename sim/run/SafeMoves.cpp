#include "sim/run/SafeMoves.h"

#include "ir/Walk.h"

#include <algorithm>
#include <cmath>

namespace dotek::sim {
namespace {

constexpr double kFirstSkip = 5061, kLastSkip = 5080; // positions of the last skip signal, an axis each
constexpr double kFirstOffset = 2000;                 // locals and common variables are below

bool does(const ir::ProgramStatement& statement, stdlib::Function function, const stdlib::Control& control) {
  const auto* block = std::get_if<ir::NcBlock>(&statement.node);
  return block != nullptr && std::any_of(block->words.begin(), block->words.end(), [&](const ir::Word& word) {
           const double* code = word.address == 'G' ? ir::constantValue(word.value) : nullptr;
           if (code == nullptr || !(*code >= 0 && *code < 1e5)) return false;
           const stdlib::CodeInfo* info =
               control.find('G', static_cast<std::uint32_t>(std::lround(*code * 10)));
           return info != nullptr && info->function == function;
         });
}

bool readsSkip(const ir::ProgramStatement& statement) {
  bool out = false;
  ir::eachNode(statement, [&](const ir::Expression& node) {
    const auto* variable = std::get_if<ir::MachineVariable>(&node.node);
    const double* number = variable == nullptr ? nullptr : ir::constantValue(variable->number);
    // A computed number may be any.
    out = out ||
          (variable != nullptr && (number == nullptr || (*number >= kFirstSkip && *number <= kLastSkip)));
  });
  return out;
}

} // namespace

std::set<std::pair<FileId, std::uint32_t>> safeMoves(const std::vector<const ir::Program*>& programs,
                                                     const stdlib::Control& control) {
  std::set<std::pair<FileId, std::uint32_t>> out;
  for (const ir::Program* program : programs) {
    const auto& body = program->body;
    for (std::size_t at = 0; at < body.size(); ++at) {
      if (!does(body[at], stdlib::Function::Skip, control)) continue;
      bool compared = false, kept = false;
      for (std::size_t i = at + 1; i < body.size() && !kept; ++i) {
        if (does(body[i], stdlib::Function::Skip, control)) break;
        if (!readsSkip(body[i])) continue;
        (std::holds_alternative<ir::Branch>(body[i].node) ? compared : kept) = true;
      }
      const SourceRange range = body[at].origin.range();
      if (compared && !kept) out.emplace(range.file, range.begin);
    }
  }
  return out;
}

bool mayWriteOffsets(const std::vector<const ir::Program*>& programs, const stdlib::Control& control) {
  return std::any_of(programs.begin(), programs.end(), [&](const ir::Program* program) {
    return std::any_of(program->body.begin(), program->body.end(), [&](const ir::ProgramStatement& one) {
      if (does(one, stdlib::Function::DataInput, control)) return true;
      const auto* store = std::get_if<ir::Store>(&one.node);
      const double* number = store == nullptr ? nullptr : ir::constantValue(store->number);
      return store != nullptr && (number == nullptr || *number >= kFirstOffset);
    });
  });
}

} // namespace dotek::sim
