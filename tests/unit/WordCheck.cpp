#include "WordCheck.h"

#include "stdlib/ReadCall.h"
#include "support/Decimal.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <doctest/doctest.h>
#include <fmt/format.h>

namespace dotek::tests {

namespace {

using stdlib::ArgumentRole;
using stdlib::Intent;

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(' ') - first + 1));
}

std::string upper(std::string text) {
  for (char& c : text)
    c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

bool overlaps(const Place& a, const Place& b) {
  return a.file == b.file && a.first <= b.last && b.first <= a.last;
}

// `#26` in `X[#26+#1]`, not in `#261`; `Z` in `{x + Z}`, not in `{ZB}`.
bool mentions(std::string_view text, std::string_view name) {
  const auto joins = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if (end < text.size() && joins(text[end])) continue;
    if (at > 0 && name[0] != '#' && joins(text[at - 1])) continue;
    return true;
  }
  return false;
}

class Checker {
public:
  Checker(const WordCase& how, const std::vector<ResultLine>& lines, const driver::Outcome& outcome)
      : how_(how), lines_(lines), outcome_(outcome) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto start = how.hosts.find(fmt::format("start_{}", "xyz"[axis]));
      if (start != how.hosts.end()) at_[axis] = start->second;
    }
    for (const ResultLine& line : lines) {
      // (X #24 NAME ..
      if (line.text.size() < 6 || line.text[0] != '(' || line.text.substr(2, 2) != " #") continue;
      const std::size_t name = line.text.find_first_not_of(' ', line.text.find(' ', 3));
      names_.emplace(line.text.substr(name, line.text.find(' ', name) - name),
                     trimmed(std::string_view(line.text).substr(3, name - 3)));
    }
  }

  void block(const SourceBlock& block) {
    here_.clear();
    for (const ResultLine& line : lines_)
      if (std::any_of(line.places.begin(), line.places.end(),
                      [&](const Place& place) { return overlaps(place, block.place); }))
        here_.push_back(&line);
    block_ = &block;
    const NcWord* program = callOf(block.words, 65);
    signature_ = nullptr;
    if (program != nullptr) {
      std::string letters;
      for (const NcWord& word : block.words)
        if (std::string_view("GP(").find(word.letter) == std::string_view::npos) letters += word.letter;
      const auto number = parseNumber(program->value);
      REQUIRE_MESSAGE((number && how_.source != nullptr), block.text);
      signature_ = stdlib::readCall(*how_.source, static_cast<std::uint32_t>(*number), letters).signature;
      REQUIRE_MESSAGE(signature_ != nullptr, block.text);
    }
    for (const NcWord& word : block.words) {
      if (emitted(word))
        ++report_.emitted;
      else if (translated(word))
        ++report_.translated;
      else if (explained(word))
        ++report_.explained;
      else
        lose(word);
    }
    follow();
  }

  WordReport take() { return std::move(report_); }

private:
  // P of a call with G65.
  static const NcWord* callOf(const std::vector<NcWord>& words, double code) {
    const NcWord* program = nullptr;
    bool calls = false;
    for (const NcWord& word : words) {
      calls = calls || (word.letter == 'G' && word.value == numberText(code));
      if (word.letter == 'P') program = &word;
    }
    return calls ? program : nullptr;
  }

  // ---- what stands for a value

  // How the result spells a field or a host.
  std::string nameOf(const std::string& field) const {
    if (how_.target == WordTarget::Fanuc) {
      const auto found = names_.find(upper(field));
      return found == names_.end() ? "?" : found->second;
    }
    std::string out; // tool_radius: toolRadius
    for (std::size_t i = 0; i < field.size(); ++i) {
      if (field[i] == '_' && i + 1 < field.size())
        out += static_cast<char>(std::toupper(static_cast<unsigned char>(field[++i])));
      else
        out += field[i];
    }
    return out;
  }

  // Whether the text holds the value of a word of the source: the number, or what stands for its field.
  bool holds(const std::string& text, const NcWord& word) const {
    if (!word.value.starts_with("{")) return text == word.value;
    return mentions(text, nameOf(word.value.substr(1, word.value.size() - 2)));
  }
  bool same(const NcWord& word, const NcWord& other) const {
    if (word.letter != other.letter) return false;
    if (word.letter == '(') return upper(other.value).find(upper(word.value)) != std::string::npos;
    if (word.letter == '#') return other.value == word.value;
    if (word.value.starts_with("{") && how_.target == WordTarget::Fanuc)
      return other.value == nameOf(word.value.substr(1, word.value.size() - 2));
    if (word.value.starts_with("{"))
      return other.value == "{" + nameOf(word.value.substr(1, word.value.size() - 2)) + "}";
    return other.value == word.value;
  }

  std::optional<double> numberOf(const NcWord& word) const { return parseNumber(word.value); }

  // A word of a line of this block with this number, of a line that has `code` (G31; 0: any).
  bool wordOf(char letter, double value, double code = 0) const {
    if (letter == 'X' && how_.diameters) value *= 2;
    const std::string text = numberText(std::round(value * 1000) / 1000);
    return std::any_of(here_.begin(), here_.end(), [&](const ResultLine* line) {
      bool coded = code == 0, found = false;
      for (const NcWord& word : line->words) {
        coded = coded || (word.letter == 'G' && word.value == numberText(code));
        found = found || (word.letter == letter && word.value == text);
      }
      return coded && found;
    });
  }
  bool says(std::string_view text) const {
    return std::any_of(here_.begin(), here_.end(),
                       [&](const ResultLine* line) { return line->text.find(text) != std::string::npos; });
  }
  bool fileSays(std::string_view text) const {
    return std::any_of(lines_.begin(), lines_.end(),
                       [&](const ResultLine& line) { return line.text.find(text) != std::string::npos; });
  }
  // A message at the block; `text`: what it says.
  bool told(std::string_view code, std::string_view text = "") const {
    const auto& all = outcome_.diagnostics.all();
    return std::any_of(all.begin(), all.end(), [&](const Diagnostic& one) {
      if (one.code != code || !one.range.hasPlace() || one.message.find(text) == std::string::npos)
        return false;
      const SourceFile& file = outcome_.sources.file(one.range.file);
      const std::uint32_t line = file.place(one.range.begin).line;
      return file.name() == block_->place.file && line >= block_->place.first && line <= block_->place.last;
    });
  }

  // ---- emitted: the same word

  bool emitted(const NcWord& word) const {
    return std::any_of(here_.begin(), here_.end(), [&](const ResultLine* line) {
      // A letter of one macro means another thing in a call of another.
      if (signature_ != nullptr && !callsSource(*line)) return false;
      return std::any_of(line->words.begin(), line->words.end(),
                         [&](const NcWord& other) { return same(word, other); });
    });
  }
  bool callsSource(const ResultLine& line) const {
    const NcWord* program = callOf(line.words, 65);
    return program != nullptr && program->value == numberText(signature_->program);
  }

  // ---- translated: a word that the tables say means the same

  const stdlib::MacroSignature* target() const {
    return how_.macros == nullptr ? nullptr : how_.macros->find(signature_->intent, axis());
  }
  ir::Axis axis() const {
    for (const stdlib::MacroArgument& argument : signature_->arguments)
      if (argument.role == ArgumentRole::Target && signature_->intent == Intent::Surface)
        return argument.axis;
    return ir::Axis::X;
  }
  // The line that calls the target's macro for the block.
  const ResultLine* targetCall() const {
    const stdlib::MacroSignature* signature = target();
    if (signature == nullptr) return nullptr;
    for (const ResultLine* line : here_) {
      const NcWord* program = callOf(line->words, 65);
      if (program != nullptr && program->value == numberText(signature->program)) return line;
    }
    return nullptr;
  }

  bool translated(const NcWord& word) const {
    if (signature_ != nullptr) return how_.target == WordTarget::Mikroprog ? toSearch(word) : toCall(word);
    const auto number = numberOf(word);
    if (word.letter == 'M' && number && (*number == 31 || *number == 32) && how_.macros != nullptr) {
      const auto* macro = how_.macros->find(*number == 31 ? Intent::ProbeOn : Intent::ProbeOff);
      return macro != nullptr && says(fmt::format("G65 P{}", macro->program));
    }
    if (word.letter == '#') return toResult(word);
    if (!number) return false;
    if (hasCode(4) && (word.letter == 'X' || word.letter == 'P')) {
      const double seconds = word.letter == 'P' ? *number / 1000 : *number;
      return wordOf(how_.target == WordTarget::Mikroprog ? 'E' : 'X', seconds, 4);
    }
    // A travel that became a coordinate.
    if (word.letter == 'G' && word.value == "91" && how_.target == WordTarget::Fusion) return says("G90 ");
    const std::size_t axis = std::string_view("XYZ").find(word.letter);
    if (axis >= 3 || (!incremental() && how_.target != WordTarget::Mikroprog)) return false;
    if (incremental() && !at_[axis]) return false;
    return wordOf(word.letter, *number + (incremental() ? *at_[axis] : 0) + shift_[axis]);
  }
  // Whether the block counts travels.
  bool incremental() const { return hasCode(91) || (incremental_ && !hasCode(90)); }
  bool hasCode(double code) const {
    return std::any_of(block_->words.begin(), block_->words.end(), [&](const NcWord& word) {
      return word.letter == 'G' && word.value == numberText(code);
    });
  }

  // #550=#138: the result that the target's macro gives.
  bool toResult(const NcWord& word) const {
    if (how_.macros == nullptr) return false;
    const std::string variable = word.value.substr(0, word.value.find('='));
    return std::any_of(here_.begin(), here_.end(), [&](const ResultLine* line) {
      for (const NcWord& other : line->words) {
        if (other.letter != '#' || !other.value.starts_with(variable + "=#")) continue;
        const auto number = parseNumber(other.value.substr(variable.size() + 2));
        for (const stdlib::MacroSignature& one : how_.macros->signatures)
          for (const stdlib::MacroResult& result : one.results)
            if (number && result.variable == *number) return told("result-differs") || result.documented;
      }
      return false;
    });
  }

  bool toCall(const NcWord& word) const {
    const ResultLine* call = targetCall();
    if (call == nullptr) return false;
    if (word.letter == 'G' || word.letter == 'P') return true;
    const stdlib::MacroArgument* given = signature_->find(word.letter);
    if (given == nullptr) return false;
    const auto number = numberOf(word);
    const stdlib::MacroArgument* taken = target()->find(given->role, given->axis);
    const std::size_t axis = ir::indexOf(given->axis);
    for (const NcWord& other : call->words) {
      if (taken == nullptr || other.letter != taken->letter) continue;
      if (!number) {
        if (holds(other.value, word)) return true;
        continue;
      }
      // Where the axis is, is asked of the control: [#5041+19.], [#5041+[-13]].
      if (given->role == ArgumentRole::Target && given->frame == ir::Frame::Here) {
        const std::string from = fmt::format("#504{}", axis + 1);
        const std::string plain = withoutBrackets(other.value);
        if (plain.starts_with(from)) {
          const std::string rest = plain.substr(from.size());
          const auto added = parseNumber(rest.starts_with("+") ? rest.substr(1) : rest);
          if (added && std::abs(*added - *number) < 1e-6) return true;
        }
      }
      const auto value = numberOf(other);
      if (!value) continue;
      double wanted = *number;
      if (given->role == ArgumentRole::Target && given->frame != taken->frame) {
        if (!at_[axis]) continue;
        wanted += given->frame == ir::Frame::Here ? *at_[axis] : -*at_[axis];
      }
      if (given->role == ArgumentRole::System && taken->systemCode != given->systemCode)
        wanted += taken->systemCode == stdlib::SystemCode::Index ? -53 : 53;
      if (std::abs(*value - wanted) < 1e-6) return true;
    }
    // An offset that the program writes by itself: old value + measured - nominal, in the variables of the
    // system; or a nominal that the fragment compares with the target, or that is the target.
    if (given->role == ArgumentRole::System && number)
      return says(fmt::format("#{}=", 5220 + 20 * (*number - 54) + 1)) ||
             says(fmt::format("#{}=", 5220 + 20 * (*number - 54) + 2)) ||
             says(fmt::format("#{}=", 5220 + 20 * (*number - 54) + 3));
    if (given->role == ArgumentRole::Nominal && number) {
      if (says("]+#") && offsetHas(*number)) return true;
      const auto* set = target()->find(ArgumentRole::System, given->axis);
      const auto reached = targetOf(*given);
      return set != nullptr && set->systemRule == stdlib::SystemRule::Error &&
             hasLetter(*call, set->letter) && reached && std::abs(*reached - *number) < 1e-6;
    }
    if (given->role == ArgumentRole::System || given->role == ArgumentRole::Nominal)
      return std::any_of(here_.begin(), here_.end(), [&](const ResultLine* line) {
        const bool writes = line->text.starts_with("#[52") || line->text.starts_with("#{String(52") ||
                            line->text.find("Math.abs(") != std::string::npos;
        return line != call && writes && holds(line->text, word);
      });
    return false;
  }
  static std::string withoutBrackets(std::string text) {
    std::erase_if(text, [](char c) { return c == '[' || c == ']'; });
    return text;
  }
  static bool hasLetter(const ResultLine& line, char letter) {
    return std::any_of(line.words.begin(), line.words.end(),
                       [&](const NcWord& word) { return word.letter == letter; });
  }
  // `..+#135-3.`; of 0 nothing is written.
  bool offsetHas(double nominal) const {
    return std::any_of(here_.begin(), here_.end(), [&](const ResultLine* line) {
      const std::size_t at = line->text.rfind("]+#");
      if (!line->text.starts_with("#") || at == std::string::npos) return false;
      const std::size_t end = line->text.find_first_of("+-", at + 3);
      std::string rest = end == std::string::npos ? "0" : withoutBrackets(line->text.substr(end));
      if (rest.starts_with("--")) rest.erase(0, 2); // -[-3]
      const auto value = parseNumber(rest);
      return value && std::abs(*value + nominal) < 1e-6;
    });
  }
  // Where the source's call expects the feature, along the axis of its nominal.
  std::optional<double> targetOf(const stdlib::MacroArgument& nominal) const {
    const auto* wanted = signature_->find(ArgumentRole::Target, nominal.axis);
    const std::size_t axis = ir::indexOf(nominal.axis);
    if (wanted == nullptr) return at_[axis]; // a bore: where the probe is
    for (const NcWord& word : block_->words)
      if (const auto number = numberOf(word); word.letter == wanted->letter && number && at_[axis])
        return *at_[axis] + *number;
    return std::nullopt;
  }

  // Mikroprog: a search along the axis, a record, the datum.
  bool toSearch(const NcWord& word) const {
    if (word.letter == 'G' || word.letter == 'P') return says(" G31 ");
    const stdlib::MacroArgument* given = signature_->find(word.letter);
    const auto number = numberOf(word);
    if (given == nullptr || !number) return false;
    const std::size_t axis = ir::indexOf(given->axis);
    const char letter = ir::letterOf(given->axis);
    const auto host = [&](const char* name) { return how_.hosts.at(name); };
    const bool moves = signature_->intent == Intent::ProtectedMove;
    switch (given->role) {
    case ArgumentRole::Target: {
      if (moves) return wordOf(letter, *number + shift_[axis], 31);
      const double over = *number < 0 ? -host("overtravel") : host("overtravel");
      return at_[axis] && wordOf(letter, *at_[axis] + *number + over + shift_[axis], 31);
    }
    case ArgumentRole::Diameter: {
      // Both walls along both axes, from the middle; with a comparison the first contact is 0.
      const double half = *number / 2 - host("tool_radius"), over = host("overtravel");
      for (std::size_t i = 0; i < 2; ++i) {
        const char wall = "XY"[i];
        const double minus = how_.byOperator ? *at_[i] - half - over : -2 * half - over;
        if (!at_[i] || !wordOf(wall, *at_[i] + half + over, 31) || !wordOf(wall, minus, 31)) return false;
      }
      return true;
    }
    case ArgumentRole::Nominal: {
      const auto touch = travel();
      const double side = given->axis == ir::Axis::Z || !touch ? 0 : *touch < 0 ? 1 : -1;
      const double contact = *number + side * host("tool_radius");
      if (!how_.byOperator) return wordOf(letter, contact, 92);
      const double written = letter == 'X' && how_.diameters ? 2 * contact : contact;
      const std::string text = fmt::format("{}{}", letter, numberText(written));
      return std::any_of(here_.begin(), here_.end(), [&](const ResultLine* line) {
        return line->text.find("M0 ;") != std::string::npos &&
               (" " + line->text + " ").find(" " + text + " ") != std::string::npos;
      });
    }
    default: return false;
    }
  }
  std::optional<double> travel() const {
    for (const NcWord& word : block_->words)
      if (const auto* given = signature_->find(word.letter);
          given != nullptr && given->role == ArgumentRole::Target)
        return numberOf(word);
    return std::nullopt;
  }

  // ---- explained: a message at the block and, of what changes, a comment in the file

  bool explained(const NcWord& word) const {
    const bool control = how_.target == WordTarget::Mikroprog;
    if (word.letter == 'F' && told("word-left-out", word.spelled)) return true; // see follow()
    if (control && word.letter == 'F') return told("feed-dropped") && says("F" + word.value + " NOT KEPT");
    if (control && word.letter == 'S' && signature_ != nullptr)
      return told("offset-number-dropped") && fileSays("OFFSET " + word.value + " NOT WRITTEN");
    if (control && word.letter == '#')
      return told("result-dropped") && says(word.value.substr(0, word.value.find('=')) + " NOT KEPT");
    if (control && word.letter == 'M' && (word.value == "31" || word.value == "32"))
      return told("probe-power-dropped") && says(word.value == "31" ? "PROBE ON" : "PROBE OFF");
    if (control && hasCode(43) && std::string_view("GHD").find(word.letter) != std::string_view::npos)
      return told("mode-dropped", word.spelled) && fileSays(word.spelled);
    static const std::map<std::string, std::string_view> kModes = {
        {"0", "a motion code"}, {"1", "a motion code"}, {"80", "canned cycles"},
        {"90", "absolute"},     {"91", "incremental"},  {"94", "feed per minute"}};
    if (const auto mode = kModes.find(word.value); control && word.letter == 'G' && mode != kModes.end())
      return told("mode-dropped", mode->second) && (word.value != "80" || fileSays("CANNED CYCLES"));
    return word.letter == 'G' && word.value == "21" && told("word-left-out", word.spelled);
  }

  // A feed that stood in a block without a move has to be with the moves that run at it.
  void followFeed() {
    bool moves = false, feeds = false;
    for (const NcWord& word : block_->words) {
      if (word.letter == 'G' && (word.value == "0" || word.value == "1")) motion_ = word.value[0];
      moves = moves || (word.letter >= 'X' && word.letter <= 'Z' && signature_ == nullptr && !hasCode(4));
      if (word.letter != 'F') continue;
      feeds = true;
      feed_.reset();
      if (told("word-left-out", word.spelled)) feed_ = word;
    }
    if (signature_ != nullptr) feed_.reset();
    if (moves && !feeds && feed_ && motion_ == '1' && !emitted(*feed_)) lose(*feed_);
  }
  void lose(const NcWord& word) {
    report_.lost.push_back(fmt::format("{}:{}: {}{}, of `{}`", block_->place.file, block_->place.first,
                                       word.letter, word.value, block_->text));
  }

  // Where the probe follows the block, in the coordinates of the source.
  void follow() {
    followFeed();
    const bool measures = signature_ != nullptr && signature_->intent != Intent::ProtectedMove;
    const bool travels = incremental();
    for (const NcWord& word : block_->words) {
      const std::size_t axis = std::string_view("XYZ").find(word.letter);
      const auto number = numberOf(word);
      if (!measures && axis < 3 && !hasCode(4)) {
        if (travels && at_[axis] && number)
          *at_[axis] += *number;
        else
          at_[axis] = travels ? std::nullopt : number;
      }
      if (!measures || !number || how_.target != WordTarget::Mikroprog) continue;
      const stdlib::MacroArgument* given = signature_->find(word.letter);
      if (given == nullptr || given->role != ArgumentRole::Nominal || !says(" G92 ")) continue;
      if (const auto expected = targetOf(*given)) shift_[ir::indexOf(given->axis)] = *number - *expected;
    }
    incremental_ = travels;
  }

  const WordCase& how_;
  const std::vector<ResultLine>& lines_;
  const driver::Outcome& outcome_;
  std::map<std::string, std::string> names_; // field: its variable
  std::array<std::optional<double>, 3> at_;
  std::array<double, 3> shift_{};
  bool incremental_ = false;   // of the source
  char motion_ = 0;            // of the source: '0', '1'
  std::optional<NcWord> feed_; // in force in the source, and left out where it is
  const SourceBlock* block_ = nullptr;
  const stdlib::MacroSignature* signature_ = nullptr; // of the block, where it calls
  std::vector<const ResultLine*> here_;               // lines that come from the block
  WordReport report_;
};

} // namespace

WordReport checkWords(const WordCase& how, const std::vector<SourceBlock>& blocks,
                      const std::vector<ResultLine>& lines, const driver::Outcome& outcome) {
  Checker checker(how, lines, outcome);
  for (const SourceBlock& block : blocks)
    checker.block(block);
  return checker.take();
}

} // namespace dotek::tests
