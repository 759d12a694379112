// Offsets of tools: a program that says wear and writes the geometry.
#include "frontend/macrob/BlockWords.h"
#include "frontend/macrob/Calls.h"
#include "frontend/macrob/Check.h"

#include <algorithm>
#include <map>
#include <utility>

namespace dotek::frontend::macrob {

namespace {

char capital(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

std::string upper(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), capital);
  return out;
}

bool has(std::string_view text, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return text.find(word) != std::string_view::npos; });
}

// One of the words, capitals, is in a comment of the program.
bool isInComment(const Program& program, std::initializer_list<std::string_view> words) {
  std::string text;
  const auto isIn = [&](const Comment& comment) {
    text.resize(comment.text.size());
    std::transform(comment.text.begin(), comment.text.end(), text.begin(), capital);
    return has(text, words);
  };
  return std::any_of(program.comments.begin(), program.comments.end(), isIn) ||
         std::any_of(program.blocks.begin(), program.blocks.end(), [&](const Block& block) {
           return std::any_of(block.comments.begin(), block.comments.end(), isIn);
         });
}

// The L of a G10 that sets the length of a tool, 10, or its wear, 11; nullptr: another block.
const nc::Word* lengthInput(const Block& block) {
  const auto* words = std::get_if<Words>(&block.body);
  if (words == nullptr || findCode(*words, 'G', 10) == nullptr) return nullptr;
  const nc::Word* kind = findWord(*words, 'L');
  const auto l = kind != nullptr ? literal(*kind) : std::nullopt;
  return l == 10.0 || l == 11.0 ? kind : nullptr;
}

// What the numbers of variables are made of, as sums: a constant and whatever else is added.
class Addresses {
public:
  explicit Addresses(const std::vector<Block>& blocks) {
    for (const Block& block : blocks)
      if (const nc::Assignment* assignment = assignmentOf(block))
        if (const auto number = literal(*assignment->variable))
          set_[*number].push_back(assignment->value.get());
  }

  static const nc::Assignment* assignmentOf(const Block& block) {
    const auto* branch = std::get_if<If>(&block.body);
    return branch != nullptr ? std::get_if<nc::Assignment>(&branch->statement)
                             : std::get_if<nc::Assignment>(&block.body);
  }

  // The first variable that may be written: the one with this number, or the one after what a computed number
  // counts from: 2201 of #[2200+#7], since no tool has the number 0.
  std::optional<double> writtenFrom(const nc::Assignment& assignment) const {
    const Sum sum = sumOf(*assignment.variable, 0);
    if (!sum.any) return sum.constant;
    return sum.constant == 0 ? std::nullopt : std::optional(sum.constant + 1);
  }

private:
  struct Sum {
    double constant = 0;
    bool any = false; // something that is not known is added
  };
  static constexpr int kMostDepth = 8;

  Sum sumOf(const Expression& value, int depth) const {
    if (const auto number = literal(value)) return {*number, false};
    if (const auto* operation = std::get_if<nc::Operation>(&value.node)) {
      if (operation->op != "+" && operation->op != "-") return {0, true};
      const Sum left = sumOf(*operation->left, depth), right = sumOf(*operation->right, depth);
      return {left.constant + (operation->op == "+" ? right.constant : -right.constant),
              left.any || right.any};
    }
    const auto* variable = std::get_if<nc::VariableRef>(&value.node);
    const auto number = variable != nullptr ? literal(*variable->number) : std::nullopt;
    const auto set = number && depth < kMostDepth ? set_.find(*number) : set_.end();
    // One that is set in several places, or by itself, may be anything.
    if (set == set_.end() || set->second.size() != 1) return {0, true};
    const auto [known, added] = known_.try_emplace(*number, Sum{0, true});
    if (added) known->second = sumOf(*set->second.front(), depth + 1);
    return known->second;
  }

  std::map<double, std::vector<const Expression*>> set_;
  mutable std::map<double, Sum> known_; // of variables: each is asked for once
};

} // namespace

// On Fanuc #2001 and up are the wear and #2201 and up the geometry of tool lengths; on Haas it is the other
// way round.
void wearInGeometry(const CheckedProgram& input, Report& report) {
  const stdlib::Control* control = input.control;
  if (control != nullptr && (!control->variables.toolGeometry || !control->variables.toolWear)) return;
  const int geometry = control != nullptr ? *control->variables.toolGeometry : 2200;
  const int wear = control != nullptr ? *control->variables.toolWear : 2000;
  const int count = control != nullptr ? control->variables.toolCount : 200;
  const auto in = [&](double number, int first) { return number > first && number <= first + count; };
  // Long programs of some controls have the same offsets by other numbers, too.
  const auto isWear = [&](double number) {
    return in(number, wear) || (control != nullptr && control->variables.toolWearToo &&
                                in(number, *control->variables.toolWearToo));
  };
  const auto isGeometry = [&](double number) {
    return in(number, geometry) || (control != nullptr && control->variables.toolGeometryToo &&
                                    in(number, *control->variables.toolGeometryToo));
  };
  if (!isInComment(input.program, {"WEAR", "VERSCHLEI", "OPOT"})) return;
  const bool both = isInComment(input.program, {"GEOM", "GEO ", "DELK"});
  const Addresses addresses(input.program.blocks);
  std::vector<std::pair<SourceRange, const nc::Word*>> writes; // with the L of a G10
  bool second = false;                                         // the first of them is by the second number
  bool writesWear = false;
  const std::vector<Comment>* before = nullptr;
  for (const Block& block : input.program.blocks) {
    const nc::Assignment* assignment = Addresses::assignmentOf(block);
    const std::vector<Comment>* above = std::exchange(before, nullptr);
    if (std::holds_alternative<std::monostate>(block.body)) before = &block.comments;
    const nc::Word* kind = lengthInput(block);
    if (assignment == nullptr && kind == nullptr) continue;
    const auto from = assignment != nullptr ? addresses.writtenFrom(*assignment) : std::nullopt;
    const bool toGeometry = kind != nullptr ? literal(*kind) == 10.0 : from && isGeometry(*from);
    if (!toGeometry) {
      writesWear = writesWear || kind != nullptr || (from && isWear(*from));
      continue;
    }
    std::string near;
    for (const Comment& comment : block.comments)
      near += upper(comment.text) + "\n";
    for (const Comment& comment : above != nullptr ? *above : std::vector<Comment>{})
      near += upper(comment.text) + "\n";
    const bool saysWear = has(near, {"WEAR", "VERSCHLEI", "OPOT"}) && !has(near, {"GEOM"});
    // A program that speaks of wear alone, and writes the geometry alone.
    if (saysWear || (!both && kind == nullptr && near.empty())) {
      if (writes.empty()) second = from && !in(*from, geometry);
      writes.emplace_back(kind != nullptr ? kind->range : assignment->range, kind);
    }
    if (saysWear) writesWear = false;
  }
  if (writes.empty() || writesWear) return;
  if (writes.front().second != nullptr) {
    report.at(writes.front().first,
              "the program says wear, and L10 of G10 writes the geometry of the tool's length, which is "
              "overwritten; the wear is L11");
    return;
  }
  if (control != nullptr) {
    const bool other = second && control->variables.toolWearToo;
    const int named = other ? *control->variables.toolGeometryToo : geometry;
    const int right = other ? *control->variables.toolWearToo : wear;
    report.at(writes.front().first,
              "the program says wear, and this writes the geometry: on the {}, #{}.. is the geometry of tool "
              "lengths and #{}.. the wear; the length of the tool is overwritten; write `#[{}+..]`",
              control->title, named + 1, right + 1, right);
    return;
  }
  report.at(
      writes.front().first,
      "the program says wear, and this writes the geometry: #{}.. is the geometry of tool lengths on a Fanuc "
      "control, #{}.. the wear; the length of the tool is overwritten; write `#[{}+..]` (Haas counts the "
      "other "
      "way round)",
      geometry + 1, wear + 1, wear);
}

} // namespace dotek::frontend::macrob
