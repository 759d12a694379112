#include "lint/ProgBlocks.h"

#include "frontend/compost/Walk.h"
#include "support/Ascii.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <set>

namespace dotek::lint {
namespace {

constexpr std::size_t kCallDepth = 16;
// Routines that call one another many times would give more blocks than anybody prints.
constexpr std::size_t kMostCalls = 2000;
constexpr std::size_t kMostCalledPieces = 20'000;

// The sink that rules look at: both sides of an IF, one after the other.
class Collector : private compost::Walk {
public:
  Collector(const compost::Program& prog, const Project& project) : prog_(prog), project_(project) {}

  std::vector<ProgBlock> run(const std::vector<compost::Statement>& statements) {
    body(statements);
    block_.open = true;
    close();
    return std::move(out_);
  }

private:
  const compost::Routine* routineOf(const compost::Word& word) const override {
    return word.kind == compost::WordKind::Command ? compost::findRoutine(prog_, word.name) : nullptr;
  }

  bool enter(const compost::Routine& routine, SourceRange) override {
    const bool open = std::find(open_.begin(), open_.end(), &routine) != open_.end();
    if (++calls_ > kMostCalls || calledPieces_ > kMostCalledPieces || open || open_.size() >= kCallDepth)
      return false;
    if (!block_.pieces.empty()) block_.joined.push_back(&routine);
    open_.push_back(&routine);
    return true;
  }
  void leave(const compost::Routine&) override { open_.pop_back(); }

  void literal(const compost::Literal& literal) override {
    if (!literal.text.empty()) add({ProgPiece::Kind::Text, literal.range, &literal, nullptr, "", 0});
  }
  void endLine(SourceRange) override {
    if (open_.empty()) block_.called = false;
    close();
  }

  void branch(const compost::If& branch) override {
    ++conditions_;
    const std::uint32_t outer = arm_;
    arm_ = ++arms_;
    body(branch.thenBody);
    arm_ = ++arms_;
    body(branch.elseBody);
    arm_ = outer;
    --conditions_;
  }

  void word(const compost::Word& word) override {
    if (word.kind == compost::WordKind::Boolean) return;
    const stdlib::ComPostKeyword* keyword = project_.compostKeywords.find(word.name);
    if (keyword != nullptr && keyword->prints == stdlib::Prints::No) return;
    ProgPiece piece{pieceKind(word, project_), word.range, nullptr, &word, "", 0};
    if (piece.kind == ProgPiece::Kind::Number && word.name == "OpFieldData" && word.arguments.size() == 1)
      piece.field = word.arguments[0].text;
    add(std::move(piece));
  }

  void add(ProgPiece piece) {
    piece.arm = arm_;
    if (!open_.empty()) ++calledPieces_;
    if (block_.pieces.empty()) {
      block_.range = piece.range;
      block_.conditional = conditions_ > 0;
      block_.called = true;
    } else if (block_.range.file == piece.range.file && piece.range.begin > block_.range.begin) {
      block_.range = spanning(block_.range, piece.range);
    }
    block_.called = block_.called && !open_.empty();
    block_.pieces.push_back(std::move(piece));
  }

  void close() {
    if (!block_.pieces.empty()) out_.push_back(std::move(block_));
    block_ = {};
  }

  const compost::Program& prog_;
  const Project& project_;
  std::vector<const compost::Routine*> open_;
  std::size_t conditions_ = 0;
  std::size_t calls_ = 0, calledPieces_ = 0;
  std::uint32_t arm_ = 0, arms_ = 0;
  ProgBlock block_;
  std::vector<ProgBlock> out_;
};

std::string printed(const ProgBlock& block, bool fields) {
  std::string out;
  for (const ProgPiece& piece : block.pieces) {
    switch (piece.kind) {
    case ProgPiece::Kind::Text: out += piece.literal->text; break;
    case ProgPiece::Kind::Number:
      out += fields && !piece.field.empty() ? "{" + piece.field + "}" : "{}";
      break;
    case ProgPiece::Kind::Command: out += " <" + piece.word->name + ">"; break;
    case ProgPiece::Kind::Sequence: break;
    }
  }
  std::string one;
  for (const char c : out) {
    const bool blank = c == ' ' || c == '\t';
    if (blank && (one.empty() || one.back() == ' ')) continue;
    one += blank ? ' ' : c;
  }
  while (!one.empty() && one.back() == ' ')
    one.pop_back();
  return one;
}

bool isNumberCharacter(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '+';
}

// GOTO8012, END1: no address.
bool isMacroWord(std::string_view text) {
  constexpr std::string_view kWords[] = {"GOTO",  "IF",    "WHILE", "DO",    "END",  "THEN",
                                         "POPEN", "PCLOS", "DPRNT", "BPRNT", "SETVN"};
  return std::any_of(std::begin(kWords), std::end(kWords),
                     [&](std::string_view word) { return text.starts_with(word); });
}

// Words of one literal; false where the rest of the block is no NC block.
// Where the text before has ended: in a comment, in how many brackets of a value.
struct Within {
  bool comment = false;
  int brackets = 0;
  bool readsBrackets = false; // else they are not taken apart
};

bool wordsOfText(const ProgPiece& piece, Within& within, std::vector<ProgWord>& out) {
  bool& comment = within.comment;
  const std::string& text = piece.literal->text;
  // Places are known where the literal's range holds its bytes between two apostrophes.
  const bool placed = piece.range.end - piece.range.begin == text.size() + 2;
  const auto place = [&](std::size_t begin, std::size_t end) -> SourceRange {
    if (!placed) return piece.range;
    const std::uint32_t first = piece.range.begin + 1;
    return {piece.range.file, first + static_cast<std::uint32_t>(begin),
            first + static_cast<std::uint32_t>(end)};
  };
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (within.brackets > 0) {
      within.brackets += c == '[' ? 1 : c == ']' ? -1 : 0;
      ++at;
    } else if (comment || c == '(') {
      comment = c != ')';
      ++at;
    } else if (c == ' ' || c == '\t' || c == '/') {
      ++at;
    } else if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      if (isMacroWord(std::string_view(text).substr(at))) return false;
      std::size_t end = at + 1;
      while (end < text.size() && isNumberCharacter(text[end]))
        ++end;
      // A variable by its number is a value like another.
      if (end == at + 1 && end + 1 < text.size() && text[end] == '#' && isDigit(text[end + 1]))
        for (++end; end < text.size() && isDigit(text[end]);)
          ++end;
      if (within.readsBrackets && end < text.size() && text[end] == '[' && end == at + 1) {
        out.push_back(
            {static_cast<char>(std::toupper(static_cast<unsigned char>(c))), "[", nullptr, place(at, end)});
        within.brackets = 1;
        at = end + 1;
        continue;
      }
      if (end < text.size() && (text[end] == '#' || text[end] == '[')) return false;
      out.push_back({static_cast<char>(std::toupper(static_cast<unsigned char>(c))),
                     text.substr(at + 1, end - at - 1), nullptr, place(at, end)});
      at = end;
    } else {
      return false;
    }
  }
  return true;
}

} // namespace

std::string ProgBlock::shape() const {
  return printed(*this, false);
}

std::string ProgBlock::text() const {
  return printed(*this, true);
}

ProgPiece::Kind pieceKind(const compost::Word& word, const Project& project) {
  if (word.kind == compost::WordKind::Numeric) return ProgPiece::Kind::Number;
  const stdlib::ComPostKeyword* keyword = project.compostKeywords.find(word.name);
  const bool number = (keyword != nullptr && keyword->kind == stdlib::KeywordKind::Sequence) ||
                      (project.form != nullptr && project.form->sequences.contains(word.name));
  return number ? ProgPiece::Kind::Sequence : ProgPiece::Kind::Command;
}

std::vector<ProgWord> wordsOf(const ProgBlock& block, const stdlib::Form* form, bool expressions) {
  std::vector<ProgWord> out;
  Within within;
  within.readsBrackets = expressions;
  for (const ProgPiece& piece : block.pieces) {
    if (piece.kind == ProgPiece::Kind::Text) {
      if (!wordsOfText(piece, within, out)) return {};
    } else if (within.comment || within.brackets > 0 || piece.kind == ProgPiece::Kind::Sequence) {
      continue;
    } else if (piece.kind == ProgPiece::Kind::Number) {
      const bool open = !out.empty() && out.back().hole == nullptr &&
                        (out.back().digits.empty() || out.back().digits == "-" || out.back().digits == "+");
      if (open) out.back().hole = &piece;
    } else if (form != nullptr) {
      const auto entry = form->commands.find(piece.word->name);
      if (entry == form->commands.end()) continue;
      const std::size_t letter = entry->second.text.find_first_not_of(' ');
      if (letter == std::string::npos) continue;
      const std::string& text = entry->second.text;
      out.push_back({text[letter], text.substr(letter + 1), entry->second.value.empty() ? nullptr : &piece,
                     piece.range});
    }
  }
  return out;
}

bool printsUnknown(const ProgBlock& block, const stdlib::Form* form) {
  return std::any_of(block.pieces.begin(), block.pieces.end(), [&](const ProgPiece& piece) {
    return piece.kind == ProgPiece::Kind::Command &&
           (form == nullptr || !form->commands.contains(piece.word->name));
  });
}

const ProgWord* findWord(const std::vector<ProgWord>& words, char address) {
  const auto at =
      std::find_if(words.begin(), words.end(), [&](const ProgWord& word) { return word.address == address; });
  return at == words.end() ? nullptr : &*at;
}

std::string digitsOf(const std::vector<ProgWord>& words, char address) {
  const ProgWord* word = findWord(words, address);
  return word == nullptr ? "" : word->digits;
}

std::uint32_t macroCalled(const std::vector<ProgWord>& words) {
  const bool call = std::any_of(words.begin(), words.end(), [](const ProgWord& word) {
    return word.address == 'G' && word.digits == "65";
  });
  const std::string digits = call ? digitsOf(words, 'P') : "";
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return error == std::errc() && end == digits.data() + digits.size() ? number : 0;
}

std::vector<ProgBlock> collectBlocks(const std::vector<compost::Statement>& statements,
                                     const compost::Program& prog, const Project& project) {
  return Collector(prog, project).run(statements);
}

PartRoutines findParts(const compost::Program& prog, const Project& project) {
  PartRoutines out;
  for (const compost::Item& item : prog.items) {
    const auto* routine = std::get_if<compost::Routine>(&item);
    if (routine == nullptr) continue;
    eachStatement(routine->body, [&](const compost::Statement& statement) {
      const auto* word = std::get_if<compost::Word>(&statement);
      if (word != nullptr && word->kind == compost::WordKind::Command)
        out.called.insert(compost::findRoutine(prog, word->name));
    });
    for (const ProgBlock& block : blocksOf(routine->body, prog, project))
      out.begun.insert(block.joined.begin(), block.joined.end());
  }
  return out;
}

std::vector<const ProgBlock*> ownBlocks(const compost::Routine& routine, const compost::Program& prog,
                                        const Project& project) {
  std::vector<const ProgBlock*> out;
  const PartRoutines& parts = partsOf(prog, project);
  const std::vector<ProgBlock>& blocks = blocksOf(routine.body, prog, project);
  for (const ProgBlock& block : blocks) {
    const bool goesOn = &block == &blocks.front() && parts.begun.contains(&routine);
    if (!block.called && !goesOn && !(block.open && parts.called.contains(&routine))) out.push_back(&block);
  }
  return out;
}

std::vector<Siblings> findSiblings(const Project& project) {
  std::vector<Siblings> out;
  eachRoutine(project, [&](const compost::Program& prog, const compost::Routine& routine) {
    Siblings siblings{&prog, &routine, {}};
    eachStatement(routine.body, [&](const compost::Statement& statement) {
      const auto* branch = std::get_if<std::unique_ptr<compost::If>>(&statement);
      if (branch == nullptr) return;
      // A branch for several cycles is nobody's sibling.
      const auto ids = compost::cyclesOf((*branch)->condition);
      if (!ids || ids->size() != 1) return;
      CycleBranch one{
          *ids->begin(), {branch->get(), &routine, false}, blocksOf((*branch)->thenBody, prog, project)};
      if (!one.blocks.empty()) siblings.branches.push_back(std::move(one));
    });
    if (!siblings.branches.empty()) out.push_back(std::move(siblings));
  });
  return out;
}

void eachStatement(const std::vector<compost::Statement>& statements,
                   const std::function<void(const compost::Statement&)>& visit) {
  for (const compost::Statement& statement : statements) {
    visit(statement);
    if (const auto* branch = std::get_if<std::unique_ptr<compost::If>>(&statement)) {
      eachStatement((*branch)->thenBody, visit);
      eachStatement((*branch)->elseBody, visit);
    }
  }
}

void eachRoutine(const Project& project,
                 const std::function<void(const compost::Program&, const compost::Routine&)>& visit) {
  for (const compost::Program* prog : project.progs) {
    for (const compost::Item& item : prog->items) {
      if (const auto* routine = std::get_if<compost::Routine>(&item)) visit(*prog, *routine);
    }
  }
}

SourceRange rangeOf(const compost::Statement& statement) {
  if (const auto* branch = std::get_if<std::unique_ptr<compost::If>>(&statement)) return (*branch)->range;
  if (const auto* literal = std::get_if<compost::Literal>(&statement)) return literal->range;
  if (const auto* word = std::get_if<compost::Word>(&statement)) return word->range;
  if (const auto* end = std::get_if<compost::EndOfLine>(&statement)) return end->range;
  return std::get<compost::ErrorStatement>(statement).range;
}

bool MacroMeaning::measures() const {
  if (set == nullptr) return false;
  switch (intent) {
  case stdlib::Intent::ProtectedMove:
  case stdlib::Intent::FeatureToFeature:
  case stdlib::Intent::ToolUpdate:
  case stdlib::Intent::Calibration:
  case stdlib::Intent::ProbeOn:
  case stdlib::Intent::ProbeOff: return false;
  default: return true;
  }
}

MacroMeaning meaningOf(const Project& project, std::uint32_t program) {
  for (const stdlib::MacroSet& set : project.macroSets) {
    const auto signatures = set.of(program);
    if (!signatures.empty()) return {&set, signatures.front()->intent};
  }
  return {};
}

} // namespace dotek::lint
