#include "lint/ProgBlocks.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace dotek::lint::rule {
namespace {

// How programs are numbered without a setting: N10, N20.
constexpr std::uint32_t kStep = 10;

// The digits at the beginning of a text, as a number; 0: none.
std::uint32_t numberAt(std::string_view text) {
  std::uint32_t out = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  return error == std::errc() ? out : 0;
}

std::string_view withoutBlanks(std::string_view text) {
  return text.substr(std::min(text.size(), text.find_first_not_of(" \t")));
}

// Numbers that GOTO has in a text.
void jumpsOf(std::string_view text, std::set<std::uint32_t>& into) {
  constexpr std::string_view kGoto = "GOTO";
  for (std::size_t at = text.find(kGoto); at != std::string_view::npos; at = text.find(kGoto, at + 1))
    into.insert(numberAt(withoutBlanks(text.substr(at + kGoto.size()))));
}

void checkBranch(const std::vector<ProgBlock>& blocks, std::set<std::uint32_t>& reported, Report& report) {
  std::uint32_t last = 0; // that a sequence word prints
  std::set<std::uint32_t> jumps;
  std::map<std::uint32_t, const ProgPiece*> labels;
  for (const ProgBlock& block : blocks) {
    const ProgPiece& first = block.pieces.front();
    if (first.kind == ProgPiece::Kind::Sequence) {
      last += kStep;
    } else if (first.kind == ProgPiece::Kind::Text) {
      const std::string_view text = withoutBlanks(first.literal->text);
      if (text.starts_with('N'))
        if (const std::uint32_t number = numberAt(text.substr(1)); number != 0)
          labels.try_emplace(number, &first);
    }
    for (const ProgPiece& piece : block.pieces)
      if (piece.kind == ProgPiece::Kind::Text) jumpsOf(piece.literal->text, jumps);
  }
  for (const auto& [number, piece] : labels) {
    if (number > last || number % kStep != 0 || !jumps.contains(number)) continue;
    if (!reported.insert(piece->range.begin).second) continue;
    report.at(piece->range,
              "N{0} is also the number of a block of a program that is numbered N10, N20 and so on; the "
              "control has two blocks N{0}, and GOTO{0} may go to either; take a number that no block gets",
              number);
  }
}

void check(const Project& project, Report& report) {
  const compost::Program* last = nullptr;
  std::set<std::uint32_t> reported; // by their places in the Prog
  for (const Siblings& siblings : siblingsOf(project)) {
    if (siblings.prog->hasErrorNodes || !siblings.routine->returnRange) continue;
    if (std::exchange(last, siblings.prog) != siblings.prog) reported.clear();
    for (const CycleBranch& branch : siblings.branches)
      checkBranch(branch.blocks, reported, report);
  }
}

} // namespace

DOTEK_LINT_RULE(label_among_block_numbers){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
