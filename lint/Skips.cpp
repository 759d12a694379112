#include "lint/Skips.h"

#include "ir/Dataflow.h"

#include <algorithm>
#include <array>

namespace dotek::lint {
namespace {

constexpr std::uint32_t kContact = 5061;
// Codes whose axis words move nothing: they are limits, centres, axes, coordinates and offsets.
constexpr std::array<double, 12> kNoMotion = {4, 10, 22, 50.1, 51, 51.1, 52, 68, 68.2, 92, 65, 66};
// Codes whose axis words are another motion than a plain move.
constexpr std::array<double, 6> kOtherMotion = {2, 3, 28, 30, 31, 53};

} // namespace

AxisSet axesOf(const ir::NcBlock& block) {
  unsigned out = 0;
  for (const ir::Word& word : block.words)
    if (word.address >= 'X' && word.address <= 'Z') out |= 1U << (word.address - 'X');
  return static_cast<AxisSet>(out);
}

const ir::NcBlock* skipOf(const ir::ProgramStatement& statement) {
  const auto* block = std::get_if<ir::NcBlock>(&statement.node);
  return block != nullptr && hasCode(*block, 'G', 31) ? block : nullptr;
}

bool moves(const ir::NcBlock& block) {
  return axesOf(block) != 0 && !hasAnyCode(block, 'G', kNoMotion);
}

bool isPlainMove(const ir::NcBlock& block) {
  return moves(block) && !hasAnyCode(block, 'G', kOtherMotion);
}

bool isPlainMove(const ir::ProgramStatement& statement) {
  const auto* block = std::get_if<ir::NcBlock>(&statement.node);
  return block != nullptr && isPlainMove(*block);
}

bool choosesSystem(const ir::NcBlock& block) {
  return std::any_of(block.words.begin(), block.words.end(), [](const ir::Word& word) {
    const double* code = word.address == 'G' ? ir::constantValue(word.value) : nullptr;
    return code != nullptr && ((*code >= 54 && *code < 60) || *code == 154 || (*code >= 110 && *code <= 129));
  });
}

std::optional<AxisSet> contactAxis(std::uint32_t variable) {
  if (variable < kContact || variable > kContact + 2) return std::nullopt;
  return static_cast<AxisSet>(1U << (variable - kContact));
}

std::optional<DistanceMode> statedMode(const ir::ProgramStatement& statement) {
  if (callOf(statement) != nullptr) return std::nullopt; // a macro gives back what it changes
  const auto* block = std::get_if<ir::NcBlock>(&statement.node);
  if (block == nullptr) return std::nullopt;
  std::optional<DistanceMode> out;
  for (const ir::Word& word : block->words) {
    if (word.address != 'G') continue;
    const double* code = ir::constantValue(word.value);
    if (code == nullptr) out = DistanceMode::Unknown;
    if (code != nullptr && *code == 90) out = DistanceMode::Absolute;
    if (code != nullptr && *code == 91) out = DistanceMode::Incremental;
  }
  return out;
}

std::vector<std::optional<DistanceMode>> distanceModes(const std::vector<ir::ProgramStatement>& body,
                                                       const ir::ProgramFlow& flow) {
  return ir::factsBefore<DistanceMode>(
      body, flow, DistanceMode::AsBefore,
      [&](std::size_t at, std::size_t, DistanceMode mode) { return statedMode(body[at]).value_or(mode); },
      [](DistanceMode& into, DistanceMode other) {
        if (into == other || into == DistanceMode::Unknown) return false;
        const bool known = into != DistanceMode::AsBefore && other != DistanceMode::AsBefore &&
                           other != DistanceMode::Unknown;
        const DistanceMode merged = known ? DistanceMode::Both : DistanceMode::Unknown;
        const bool changed = merged != into;
        into = merged;
        return changed;
      });
}

const ir::Call* callOf(const ir::ProgramStatement& statement) {
  const auto* call = std::get_if<ir::Call>(&statement.node);
  return call != nullptr && call->kind != ir::CallKind::Off ? call : nullptr;
}

} // namespace dotek::lint
