#include "ir/Expression.h"
#include "ir/Match.h"
#include "lint/NcProgram.h"
#include "lint/Skips.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace dotek::lint::rule {
namespace {

bool moves(const ir::ProgramStatement& statement) {
  const auto* block = std::get_if<ir::NcBlock>(&statement.node);
  return block != nullptr &&
         ((skipOf(statement) != nullptr && axesOf(*block) != 0) || isPlainMove(statement));
}

// Coordinates that are written out, 0 aside.
std::set<std::pair<char, double>> coordinates(const ir::ProgramStatement& statement) {
  std::set<std::pair<char, double>> out;
  for (const ir::Word& word : std::get<ir::NcBlock>(statement.node).words) {
    const double* value = ir::constantValue(word.value);
    if (value != nullptr && *value != 0 && word.address >= 'X' && word.address <= 'Z')
      out.emplace(word.address, *value);
  }
  return out;
}

// The only axis that a block names, with its coordinate; nothing: several, none, or a computed one.
std::optional<std::pair<char, double>> onlyAxis(const ir::ProgramStatement& statement) {
  std::optional<std::pair<char, double>> out;
  for (const ir::Word& word : std::get<ir::NcBlock>(statement.node).words) {
    if (word.address < 'X' || word.address > 'Z') continue;
    const double* value = ir::constantValue(word.value);
    if (out || value == nullptr) return std::nullopt;
    out = {word.address, *value};
  }
  return out;
}

// A second touch: a little back along one axis, and slowly farther than that towards the surface again.
bool touchesAgain(const ir::ProgramStatement& back, const ir::ProgramStatement& skip) {
  constexpr double kMostBack = 10, kMostFarther = 5; // mm; times the way back
  if (skipOf(skip) == nullptr || skipOf(back) != nullptr) return false;
  const auto one = onlyAxis(back), other = onlyAxis(skip);
  if (!one || !other || one->first != other->first || !(one->second * other->second < 0)) return false;
  const double away = std::abs(one->second), forth = std::abs(other->second);
  return away <= kMostBack && forth > away && forth <= kMostFarther * away;
}

bool takesOffset(const ir::ProgramStatement& statement) {
  const auto& block = std::get<ir::NcBlock>(statement.node);
  return hasCode(block, 'G', 43) || hasCode(block, 'G', 44) || choosesSystem(block);
}

// The block before, labels, comments and stores aside, is a G91 without a move: these are meant as distances.
// So are the holes of a canned cycle that begins after it.
bool isAnnounced(const std::vector<ir::ProgramStatement>& body, std::size_t at) {
  enum class Step : std::uint8_t { GoOn, Yes, No };
  const auto has = [&](const ir::NcBlock& block) { return firstWord(block, "GM") != nullptr; };
  std::size_t cycle = at;
  while (cycle > 0) {
    const auto* block = std::get_if<ir::NcBlock>(&body[cycle - 1].node);
    if (block == nullptr) break;
    --cycle;
    if (cycleOf(*block) != 0) {
      at = cycle;
      break;
    }
    if (has(*block)) break;
  }
  while (at-- > 0) {
    const Step step = ir::match(
        body[at],
        [](const ir::NcBlock& block) {
          return hasCode(block, 'G', 91) && axesOf(block) == 0 ? Step::Yes : Step::No;
        },
        [](const ir::OneOf<ir::Label, ir::Comment, ir::Store> auto&) { return Step::GoOn; },
        [](const ir::OneOf<ir::Jump, ir::Branch, ir::Call, ir::JumpTo, ir::Loop, ir::LoopEnd, ir::Exit,
                           ir::Raise, ir::Notice, ir::Port, ir::Print, ir::NameVariables> auto&) {
          return Step::No;
        });
    if (step != Step::GoOn) return step == Step::Yes;
  }
  return false;
}

// Of the first skip move: all that was done since a G91 before it are plain moves: a search that is meant to
// count from where it begins. Nothing has gone back from a surface, after which a G90 could be forgotten.
bool beginsSearch(const std::vector<ir::ProgramStatement>& body, std::size_t at) {
  enum class Step : std::uint8_t { GoOn, Yes, No };
  while (at-- > 0) {
    const Step step = ir::match(
        body[at],
        [](const ir::NcBlock& block) {
          if (axesOf(block) != 0 && !isPlainMove(block)) return Step::No;
          return hasCode(block, 'G', 91) ? Step::Yes : Step::GoOn;
        },
        [](const ir::OneOf<ir::Call, ir::Loop, ir::LoopEnd> auto&) { return Step::No; },
        [](const ir::OneOf<ir::Label, ir::Comment, ir::Store, ir::Jump, ir::Branch, ir::JumpTo, ir::Exit,
                           ir::Raise, ir::Notice, ir::Port, ir::Print, ir::NameVariables> auto&) {
          return Step::GoOn;
        });
    if (step != Step::GoOn) return step == Step::Yes;
  }
  return false;
}

// The value, or its opposite, is a term of the sum.
bool isTermOf(const ir::ExpressionPtr& value, const ir::ExpressionPtr& sum) {
  if (sum == nullptr) return false;
  if (const auto* both = std::get_if<ir::Binary>(&sum->node);
      both != nullptr && (both->op == ir::BinaryOp::Add || both->op == ir::BinaryOp::Subtract))
    return isTermOf(value, both->left) || isTermOf(value, both->right);
  if (const auto* one = std::get_if<ir::Unary>(&sum->node);
      one != nullptr && (one->op == ir::UnaryOp::Negate || one->op == ir::UnaryOp::NullAsZero))
    return isTermOf(value, one->operand);
  if (const auto* one = std::get_if<ir::Unary>(&value->node);
      one != nullptr && (one->op == ir::UnaryOp::Negate || one->op == ir::UnaryOp::NullAsZero))
    return isTermOf(one->operand, sum);
  const double* number = ir::constantValue(value);
  const double* other = ir::constantValue(sum);
  if (number != nullptr && other != nullptr) return std::abs(*number) == std::abs(*other);
  return ir::equal(value, sum);
}

// An absolute skip move goes as far from a position: X[#10-20.] beside X20.
bool isDistanceElsewhere(const ir::ProgramStatement& statement,
                         const std::vector<const ir::NcBlock*>& absoluteSkips) {
  const auto isSum = [](const ir::ExpressionPtr& value) {
    return value != nullptr && std::holds_alternative<ir::Binary>(value->node);
  };
  bool any = false;
  for (const ir::Word& word : std::get<ir::NcBlock>(statement.node).words) {
    if (word.address < 'X' || word.address > 'Z' || word.value == nullptr) continue;
    any = true;
    const bool found = std::any_of(absoluteSkips.begin(), absoluteSkips.end(), [&](const ir::NcBlock* skip) {
      return std::any_of(skip->words.begin(), skip->words.end(), [&](const ir::Word& other) {
        return other.address == word.address && isSum(other.value) && isTermOf(word.value, other.value);
      });
    });
    if (!found) return false;
  }
  return any;
}

// The skip moves look to both sides by the same distance, and one of them has lost its G91.
void checkPairs(const NcProgram& nc, Report& report) {
  const auto& body = nc.program.body;
  const auto& modes = nc.modes();
  struct Skip {
    std::size_t at = 0;
    std::pair<char, double> word;
    bool distance = false;
  };
  std::vector<Skip> all;
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (!modes[i] || skipOf(body[i]) == nullptr) continue;
    const auto mode = statedMode(body[i]).value_or(*modes[i]);
    const auto word = onlyAxis(body[i]);
    if (word && word->second != 0 && (mode == DistanceMode::Absolute || mode == DistanceMode::Incremental))
      all.push_back({i, *word, mode == DistanceMode::Incremental});
  }
  for (const Skip& one : all) {
    if (one.distance || statedMode(body[one.at])) continue;
    const auto partner = std::find_if(all.begin(), all.end(), [&](const Skip& other) {
      return other.distance && other.word.first == one.word.first && other.word.second == -one.word.second;
    });
    if (partner == all.end()) continue;
    report
        .at(body[one.at].origin.range(), "G90 is in force at this skip move, and the one to the other side, "
                                         "by the same distance, is under G91; "
                                         "this one goes to the coordinate; write G91 before")
        .note(body[partner->at].origin.range(), "to the other side");
    return;
  }
}

void check(const NcProgram& nc, Report& report) {
  checkPairs(nc, report);
  const ir::Program& program = nc.program;
  const auto& body = program.body;
  const auto& modes = nc.modes();
  const auto modeOf = [&](std::size_t i) { return statedMode(body[i]).value_or(*modes[i]); };
  std::set<std::pair<char, double>> absolute;
  std::vector<const ir::NcBlock*> absoluteSkips;
  const auto firstSkip = static_cast<std::size_t>(
      std::find_if(body.begin(), body.end(), [](const auto& one) { return skipOf(one) != nullptr; }) -
      body.begin());
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (!modes[i] || !moves(body[i]) || modeOf(i) != DistanceMode::Absolute) continue;
    absolute.merge(coordinates(body[i]));
    constexpr std::size_t kMost = 200; // more say nothing new
    if (const ir::NcBlock* skip = skipOf(body[i]); skip != nullptr && absoluteSkips.size() < kMost)
      absoluteSkips.push_back(skip);
  }
  const ir::ProgramStatement* before = nullptr;
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (!modes[i] || !moves(body[i])) continue;
    const ir::ProgramStatement* const last = std::exchange(before, &body[i]);
    if (statedMode(body[i])) continue;
    if (*modes[i] == DistanceMode::Both) {
      report.at(
          body[i].origin.range(),
          "this block is reached with G90 on one path and with G91 on another; what it moves to differs; "
          "state the mode here");
      return;
    }
    if (*modes[i] != DistanceMode::Incremental) continue;
    if (last != nullptr && touchesAgain(*last, body[i])) continue;
    if (isAnnounced(body, i)) continue;
    const auto words = coordinates(body[i]);
    const bool same =
        std::any_of(words.begin(), words.end(), [&](const auto& w) { return absolute.contains(w); });
    const auto isOddSkip = [&] {
      return skipOf(body[i]) != nullptr && !absoluteSkips.empty() &&
             !(i == firstSkip && beginsSearch(body, i)) && !isDistanceElsewhere(body[i], absoluteSkips);
    };
    if (!same && !takesOffset(body[i]) && !isOddSkip()) continue;
    report.at(
        body[i].origin.range(),
        "G91 is still in force here, so the words are distances; elsewhere the program writes such words "
        "as coordinates; write G90 before, or into the block");
    return;
  }
}

} // namespace

DOTEK_LINT_RULE(coordinate_as_distance){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
