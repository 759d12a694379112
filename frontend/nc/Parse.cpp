#include "frontend/nc/Parse.h"

#include "frontend/nc/BlockParser.h"
#include "support/messages/Common.h"
#include "support/messages/Nc.h"

#include <algorithm>
#include <array>

namespace dotek::frontend::nc {
namespace {

// G65 or G66, by which every control of the tables calls a macro.
bool callsMacro(const Block& block) {
  return std::any_of(block.words.begin(), block.words.end(), [](const Word& word) {
    const auto* const number = word.value == nullptr ? nullptr : std::get_if<Number>(&word.value->node);
    return word.address == 'G' && number != nullptr && (number->value == 65 || number->value == 66);
  });
}

// Statements of a macro program that are no words. Longer ones before those that begin like them.
constexpr std::array<std::string_view, 11> kStatements = {"IF",    "GOTO",  "WHILE", "DO",    "END",  "THEN",
                                                          "POPEN", "PCLOS", "DPRNT", "BPRNT", "SETVN"};
constexpr std::size_t kMostDigits = 8;

// SETVN, and THEN without IF.
bool isOther(std::string_view statement) {
  return statement == "THEN" || statement == "SETVN";
}

bool isOfPort(std::string_view statement) {
  return statement.size() == 5 && statement != "WHILE" && statement != "SETVN";
}

std::size_t lengthOf(const std::vector<Piece>& pieces) {
  std::size_t length = 0;
  for (const Piece& piece : pieces) {
    const auto* text = std::get_if<TextPiece>(&piece);
    length += text == nullptr ? 1 : text->text.size();
  }
  return length;
}

SourceRange rangeOf(const std::vector<Piece>& pieces) {
  SourceRange range;
  for (const Piece& piece : pieces) {
    const SourceRange one = std::visit([](const auto& some) { return some.range; }, piece);
    if (!range.hasPlace() || one.file == range.file) range = spanning(range, one);
  }
  return range;
}

} // namespace

std::optional<Block> parseBlock(const std::vector<Piece>& pieces, const Limits& limits,
                                Diagnostics& diagnostics) {
  if (const std::size_t length = lengthOf(pieces); length > limits.lineBytes) {
    diagnostics.report<diag::LineTooLong>(rangeOf(pieces), length, limits.lineBytes);
    return std::nullopt;
  }
  std::optional<Block> block = BlockParser(pieces, limits, diagnostics).parse();
  if (block) block->range = rangeOf(pieces);
  return block;
}

std::optional<Block> BlockParser::parse() {
  Block block;
  in_.skipBlanks();
  if (in_.peek() == '/') {
    block.blockDelete = true;
    in_.skip();
    if (isDigit(in_.peek())) in_.skip(); // /2: one of several switches
    in_.skipBlanks();
  }
  if (in_.peek() == 'N' && !sequenceNumber(block)) return std::nullopt;
  for (in_.skipBlanks(); in_.peek() != Reader::kEnd; in_.skipBlanks()) {
    if (!item(block)) return std::nullopt;
  }
  if (!addressesOnce(block)) return std::nullopt;
  return block;
}

bool BlockParser::item(Block& block) {
  const char c = in_.peek();
  const SourceRange here = in_.here();
  if (c == '(') return comment(block);
  if (block.programMark) return unexpected();
  if (c == '%') {
    if (!block.words.empty() || !block.assignments.empty() || block.sequenceNumber) return unexpected();
    block.programMark = true;
    in_.skip();
    return true;
  }
  const auto statement = std::find_if(kStatements.begin(), kStatements.end(),
                                      [&](std::string_view one) { return in_.startsWith(one); });
  if (block.statement || block.port) {
    diagnostics_.report<diag::MixedBlock>(here);
    return false;
  }
  if (statement != kStatements.end() && !isOther(*statement)) {
    if (block.words.empty() && block.assignments.empty())
      return isOfPort(*statement) ? port(block, *statement) : this->statement(block);
    diagnostics_.report<diag::MixedBlock>(here);
    return false;
  }
  if (statement != kStatements.end()) {
    diagnostics_.report<diag::MacroStatement>(in_.range(in_.position(), in_.position() + statement->size()),
                                              *statement);
    return false;
  }
  if (c == '#' || isCapital(c)) {
    const bool mixed = c == '#' ? !block.words.empty() : !block.assignments.empty();
    if (mixed) {
      diagnostics_.report<diag::MixedBlock>(here);
      return false;
    }
    if (c == 'N') return syntax(here, "an `N` follows other words; a block number begins its block");
    return c == '#' ? assignment(block) : word(block);
  }
  if (c == Reader::kHole) {
    return syntax(here, "{} is printed where a word has to begin; put its address before it",
                  in_.hole().hole.name);
  }
  if (c == '/')
    return syntax(here, "`/` follows something; a control skips a block only where it begins with `/`");
  if (c >= 'a' && c <= 'z') {
    diagnostics_.report<diag::LowerCaseAddress>(here, c, static_cast<char>(c - 'a' + 'A'));
    return false;
  }
  return unexpected();
}

namespace {

// "D" of "field `D`".
std::string_view nameOf(std::string_view hole) {
  const std::size_t open = hole.find('`'), close = hole.rfind('`');
  return open < close && close != std::string_view::npos ? hole.substr(open + 1, close - open - 1) : hole;
}

} // namespace

bool BlockParser::comment(Block& block) {
  const std::size_t begin = in_.position();
  in_.skip();
  std::string text;
  while (in_.peek() != ')') {
    if (in_.peek() == Reader::kEnd)
      return syntax(in_.range(begin, begin + 1),
                    "the comment that begins here has no `)` in its block; a control skips all words after "
                    "it or stops with an alarm");
    if (in_.peek() == Reader::kHole) {
      const std::string& name = in_.hole().hole.name;
      // An operator would read another text than the source's.
      if (!block.assignments.empty() || block.statement) {
        diagnostics_.report<diag::ValueInComment>(in_.here(), name);
        return false;
      }
      text += nameOf(name);
      diagnostics_.report<diag::ValueNamed>(in_.here(), name, nameOf(name));
    } else {
      text += in_.text(in_.position(), in_.position() + 1);
    }
    in_.skip();
  }
  block.comments.push_back({std::move(text), {}});
  in_.skip();
  block.comments.back().range = in_.range(begin, in_.position());
  return true;
}

bool BlockParser::sequenceNumber(Block& block) {
  const std::size_t begin = in_.position();
  in_.skip();
  in_.skipBlanks();
  const std::size_t digits = in_.position();
  while (isDigit(in_.peek()))
    in_.skip();
  const std::size_t end = in_.position();
  if (end == digits || end - digits > kMostDigits || in_.peek() == Reader::kHole || in_.peek() == '.')
    return syntax(in_.range(begin, std::max(end, begin + 1)),
                  "`N` takes a block number of up to {} digits, and no value that is printed", kMostDigits);
  block.sequenceNumber = std::stoull(std::string(in_.text(digits, end)));
  return true;
}

bool BlockParser::word(Block& block) {
  const std::size_t begin = in_.position();
  Word word{in_.peek(), {}, nullptr};
  in_.skip();
  in_.skipBlanks();
  if (!wordValue(word)) return false;
  word.range = in_.range(begin, word.value ? in_.position() : begin + 1);
  block.words.push_back(std::move(word));
  return true;
}

bool BlockParser::wordValue(Word& word) {
  const std::size_t begin = in_.position();
  const char sign = in_.peek();
  const bool hasSign = sign == '-' || sign == '+';
  if (hasSign) {
    in_.skip();
    in_.skipBlanks();
  }
  const char c = in_.peek();
  if (isDigit(c) || c == '.') {
    word.value = number();
  } else if (c == Reader::kHole) {
    if (hasSign) warnOfSign(sign, begin);
    word.value = hole();
  } else if (c == '#' || c == '[') {
    if (sign == '+') return syntax(in_.range(begin, begin + 1), "a `+` is before a variable or a bracket");
    word.value = c == '#' ? variableRef() : bracketed();
  } else if (hasSign) {
    return syntax(in_.range(begin, begin + 1), "the sign has no number after it");
  } else {
    return true; // bare
  }
  if (!word.value) return false;
  if (sign == '-') word.value = make(begin, Negated{std::move(word.value)});
  return true;
}

bool BlockParser::assignment(Block& block) {
  const std::size_t begin = in_.position();
  if (!block.assignments.empty())
    return syntax(in_.here(), "a second assignment is in the block; write it into a block of its own");
  in_.skip();
  Assignment assignment;
  assignment.variable = variableNumber();
  if (!assignment.variable) return false;
  in_.skipBlanks();
  if (in_.peek() != '=')
    return syntax(in_.here(), "a block that begins with a variable assigns to it: `=` is missing");
  in_.skip();
  assignment.value = expression();
  if (!assignment.value) return false;
  assignment.range = in_.range(begin, in_.position());
  block.assignments.push_back(std::move(assignment));
  return true;
}

bool BlockParser::addressesOnce(const Block& block) {
  std::array<const Word*, 26> seen{};
  for (const Word& word : block.words) {
    const Word*& before = seen[static_cast<std::size_t>(word.address - 'A')];
    const bool point = word.address >= 'I' && word.address <= 'K';
    if (before != nullptr && point && callsMacro(block)) {
      diagnostics_.report<diag::ArgumentsRepeated>(word.range, word.address)
          .note(before->range, "the first is here");
      return false;
    }
    if (before != nullptr && word.address != 'G' && word.address != 'M') {
      diagnostics_.report<diag::AddressTwice>(word.range, word.address)
          .note(before->range, "the first is here");
      return false;
    }
    before = &word;
  }
  return true;
}

} // namespace dotek::frontend::nc
