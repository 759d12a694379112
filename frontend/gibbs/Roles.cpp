// What each word is at its place. There are no reserved words, so `to = to` is an assignment and
// `for to = to to to` a loop; the grammar sees names, commands and statement words apart.
#include "frontend/gibbs/Words.h"

#include <algorithm>

namespace dotek::frontend::gibbs {

using Lexer = grammar::GibbsMacroLexer;

namespace {

constexpr std::size_t kNone = SIZE_MAX;

class LineRoles {
public:
  explicit LineRoles(const std::vector<antlr4::CommonToken*>& line) {
    words_.reserve(line.size());
    for (antlr4::CommonToken* token : line)
      join(*token);
    matchBrackets();
  }

  void macro() {
    std::size_t first = 0;
    if (isPlainName(0) && type(1) == Lexer::COLON) {
      words_[0]->setType(Lexer::LABEL_NAME);
      first = 2;
    } else if (type(0) == Lexer::COLON && isPlainName(1)) {
      words_[1]->setType(Lexer::LABEL_NAME);
      first = 2;
    }
    for (std::size_t i = first; i < words_.size(); ++i) {
      switch (place_) {
      case Place::Statement: i = statement(i); break;
      case Place::Value: value(i); break;
      case Place::BehindValue: behindValue(i); break;
      }
    }
  }

  void control() {
    if (isPlainName(0)) words_[0]->setType(Lexer::COMMAND);
    bool begins = true; // an argument
    for (std::size_t i = 1; i < words_.size(); ++i) {
      if (begins && isPlainName(i) && (isPlainName(i + 1) || type(i + 1) == Lexer::NUMBER))
        for (; isPlainName(i) || type(i) == Lexer::NUMBER; ++i)
          words_[i]->setType(Lexer::LOOSE_TEXT);
      begins = type(i) == Lexer::COMMA;
      if (isName(i)) words_[i]->setType(Lexer::NAME);
    }
  }

  void definition() {
    for (std::size_t i = 0; i < words_.size(); ++i)
      if (isName(i)) words_[i]->setType(Lexer::NAME);
  }

private:
  enum class Place { Statement, Value, BehindValue };

  std::size_t type(std::size_t i) const { return i < words_.size() ? words_[i]->getType() : 0; }
  bool isName(std::size_t i) const { return isNameType(type(i)); }
  // A name that is not the name of a text.
  bool isPlainName(std::size_t i) const { return isName(i) && type(i) != Lexer::TEXT_NAME; }

  // `feed_ x` is one word: the first half takes the second one in.
  void join(antlr4::CommonToken& token) {
    const std::size_t type = token.getType();
    const bool half = type == Lexer::ID || type == Lexer::TEXT_NAME || type == Lexer::OPEN_NAME;
    if (half && !words_.empty() && words_.back()->getType() == Lexer::OPEN_NAME) {
      words_.back()->setStopIndex(token.getStopIndex());
      words_.back()->setType(type);
      token.setChannel(antlr4::Token::HIDDEN_CHANNEL);
      return;
    }
    words_.push_back(&token);
  }

  // Finds the end of each bracket, and the round ones that hold a comparison.
  void matchBrackets() {
    closing_.assign(words_.size(), kNone);
    compares_.assign(words_.size(), false);
    std::vector<std::size_t> open;
    std::size_t marked = 0; // the outermost of `open` are marked already
    for (std::size_t i = 0; i < words_.size(); ++i) {
      const std::size_t now = type(i);
      if (now == Lexer::LEFT_ROUND || now == Lexer::LEFT_SQUARE) {
        open.push_back(i);
      } else if (now == Lexer::RIGHT_ROUND || now == Lexer::RIGHT_SQUARE) {
        if (open.empty()) continue;
        closing_[open.back()] = i;
        open.pop_back();
        marked = std::min(marked, open.size());
      } else if ((now >= Lexer::NOT_EQUAL && now <= Lexer::EQUAL) || now == Lexer::KW_NOT) {
        for (; marked < open.size(); ++marked)
          compares_[open[marked]] = true;
      }
    }
  }

  bool isAssignment(std::size_t i) const {
    if (type(i + 1) == Lexer::EQUAL) return true;
    if (type(i + 1) != Lexer::LEFT_ROUND && type(i + 1) != Lexer::LEFT_SQUARE) return false;
    return closing_[i + 1] != kNone && type(closing_[i + 1] + 1) == Lexer::EQUAL;
  }

  // ELSE where a value may appear, too, begins the other branch only before a statement.
  bool beginsStatement(std::size_t i) const {
    switch (type(i)) {
    case Lexer::KW_ELSE:
    case Lexer::KW_TO:
    case Lexer::KW_STEP:
    case Lexer::KW_AND:
    case Lexer::KW_OR:
    case Lexer::OPEN_NAME:
    case Lexer::TEXT_NAME: return isAssignment(i);
    default: return isName(i) || type(i) == Lexer::KW_IF || type(i) == Lexer::HASH_INCLUDE;
    }
  }

  // A file name without quotes from `i` on; with `always` one of a single word, too. Gives its end.
  std::size_t file(std::size_t i, bool always) {
    bool separated = always;
    bool separator = true;
    std::size_t end = i;
    for (;; ++end) {
      const std::size_t now = type(end);
      if (now == Lexer::KW_ELSE && !separator && beginsStatement(end + 1)) break;
      separator = now == Lexer::DOT || now == Lexer::BACKSLASH || now == Lexer::COLON;
      separated = separated || separator;
      if (!separator && !isPlainName(end) && now != Lexer::NUMBER && now != Lexer::MINUS) break;
    }
    if (!separated) return i;
    for (std::size_t k = i; k < end; ++k)
      words_[k]->setType(Lexer::FILE_PART);
    return end;
  }

  void expectValue(bool comparison = false, bool maybeElse = false) {
    place_ = Place::Value;
    comparison_ = comparison;
    maybeElse_ = maybeElse;
  }

  // The one name that FOR, NEXT and GOTO take. Gives the last word that was dealt with.
  std::size_t plainName(std::size_t i) {
    place_ = Place::BehindValue;
    if (!isPlainName(i)) return i - 1;
    words_[i]->setType(Lexer::NAME);
    return i;
  }

  // Gives the last word that was dealt with.
  std::size_t statement(std::size_t i) {
    if (isName(i) && isAssignment(i)) {
      words_[i]->setType(Lexer::NAME);
      place_ = Place::BehindValue;
      return i;
    }
    std::size_t last = i;
    switch (type(i)) {
    case Lexer::KW_ELSE:
    case Lexer::LEFT_SQUARE:
    case Lexer::RIGHT_SQUARE: break; // a statement may follow
    case Lexer::KW_IF: expectValue(true); break;
    case Lexer::ID:
      words_[i]->setType(Lexer::COMMAND);
      expectValue(false, true);
      break;
    case Lexer::KW_CONTINUE: place_ = Place::BehindValue; break;
    case Lexer::KW_NEXT:
      if (type(i + 1) == Lexer::KW_ELSE && beginsStatement(i + 2))
        place_ = Place::BehindValue;
      else
        last = plainName(i + 1);
      break;
    case Lexer::KW_FOR:
    case Lexer::KW_GOTO: last = plainName(i + 1); break;
    case Lexer::KW_ARGS:
    case Lexer::KW_GLOBAL:
    case Lexer::KW_LOCAL:
    case Lexer::KW_PERMANENT: expectValue(); break;
    case Lexer::KW_ON_ERROR: last = plainName(type(i + 1) == Lexer::KW_GOTO ? i + 2 : i + 1); break;
    case Lexer::KW_CALL:
    case Lexer::HASH_INCLUDE: {
      const std::size_t begin = type(i) == Lexer::KW_CALL && type(i + 1) == Lexer::COMMA ? i + 2 : i + 1;
      const std::size_t end = file(begin, type(i) == Lexer::HASH_INCLUDE);
      expectValue();
      if (end > begin) place_ = Place::BehindValue;
      last = end - 1;
      break;
    }
    default:
      if (isName(i)) words_[i]->setType(Lexer::NAME);
      place_ = Place::BehindValue;
    }
    return last;
  }

  void value(std::size_t i) {
    const std::size_t now = type(i);
    if (now == Lexer::KW_ELSE && maybeElse_ && beginsStatement(i + 1)) {
      place_ = Place::Statement;
    } else if (isName(i)) {
      words_[i]->setType(Lexer::NAME);
      place_ = Place::BehindValue;
    } else if (now == Lexer::KW_THEN) {
      place_ = Place::Statement;
    } else if (now == Lexer::KW_IF || now == Lexer::KW_NOT) {
      expectValue(true);
    } else if (now == Lexer::LEFT_ROUND && comparison_ && compares_[i]) {
      words_[i]->setType(Lexer::CONDITION_ROUND);
      maybeElse_ = false;
    } else if (now == Lexer::NUMBER || now == Lexer::TEXT || now == Lexer::SINGLE_TEXT ||
               now == Lexer::RIGHT_ROUND || now == Lexer::RIGHT_SQUARE) {
      place_ = Place::BehindValue;
    } else {
      expectValue(false, maybeElse_ && now == Lexer::COMMA);
    }
  }

  void behindValue(std::size_t i) {
    switch (type(i)) {
    case Lexer::KW_THEN:
    case Lexer::KW_ELSE: place_ = Place::Statement; break;
    case Lexer::KW_IF:
    case Lexer::KW_AND:
    case Lexer::KW_OR: expectValue(true); break;
    case Lexer::RIGHT_ROUND:
    case Lexer::RIGHT_SQUARE: break;
    default:
      if (!isName(i) || type(i) == Lexer::KW_TO || type(i) == Lexer::KW_STEP) expectValue();
    }
  }

  std::vector<antlr4::CommonToken*> words_;
  std::vector<std::size_t> closing_; // of each opening bracket; kNone: there is none
  std::vector<bool> compares_;       // by opening bracket
  Place place_ = Place::Statement;
  bool comparison_ = false; // a comparison may begin here
  bool maybeElse_ = false;  // no value need are here
};

} // namespace

void assignRoles(const std::vector<antlr4::CommonToken*>& line, FileKind kind) {
  LineRoles roles(line);
  switch (kind) {
  case FileKind::Macro: return roles.macro();
  case FileKind::Dialog: return roles.control();
  case FileKind::DefineData: return roles.definition();
  }
}

} // namespace dotek::frontend::gibbs
