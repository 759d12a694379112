#include "frontend/gibbs/Explain.h"

#include "frontend/gibbs/Ast.h"
#include "frontend/gibbs/Words.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace dotek::frontend::gibbs {

using Lexer = grammar::GibbsMacroLexer;

namespace {

constexpr const char* kIfForm = "write `IF value < value THEN statement`";

bool isWord(std::size_t type) {
  return isNameType(type) || (type >= Lexer::KW_IF && type <= Lexer::KW_NOT);
}
bool isValue(std::size_t type) {
  return isNameType(type) || type == Lexer::NUMBER || type == Lexer::TEXT || type == Lexer::SINGLE_TEXT;
}
bool isRelation(std::size_t type) {
  return type >= Lexer::NOT_EQUAL && type <= Lexer::EQUAL;
}
bool isOperator(std::size_t type) {
  return type >= Lexer::PLUS && type <= Lexer::SLASH;
}

std::string quoted(const std::string& text) {
  return "`" + text + "`";
}

class BadLine {
public:
  BadLine(FileKind kind, const std::vector<Word>& words, std::size_t at, const std::string& comment)
      : kind_(kind), words_(words), at_(at), comment_(comment) {}

  std::string explain() const {
    if (words_.empty()) return "the line holds no statement";
    using Step = std::optional<std::string> (BadLine::*)() const;
    for (const Step step : {&BadLine::foreign, &BadLine::notEqual, &BadLine::relations, &BadLine::missing,
                            &BadLine::brackets, &BadLine::ifForms, &BadLine::definitions,
                            &BadLine::statementForms, &BadLine::separators, &BadLine::placement})
      if (std::optional<std::string> found = (this->*step)()) return *found;
    if (atEnd()) return "the statement ends too early, after " + quoted(words_.back().text);
    return quoted(words_[at_].text) + " does not fit here";
  }

private:
  bool atEnd() const { return at_ >= words_.size(); }
  std::size_t type(std::size_t i) const { return i < words_.size() ? words_[i].type : 0; }
  std::size_t here() const { return type(at_); }
  std::size_t before() const { return at_ > 0 ? type(at_ - 1) : 0; }
  std::string text(std::size_t i) const { return i < words_.size() ? words_[i].text : ""; }
  bool has(std::size_t wanted) const {
    return std::any_of(words_.begin(), words_.end(), [&](const Word& word) { return word.type == wanted; });
  }
  bool hasIf() const { return has(Lexer::KW_IF); }
  // Index of the last IF before the place.
  std::size_t lastIf() const {
    std::size_t found = 0;
    for (std::size_t i = 0; i < words_.size() && i <= at_; ++i)
      if (type(i) == Lexer::KW_IF) found = i;
    return found;
  }

  std::optional<std::string> foreign() const {
    if (kind_ != FileKind::Macro) return std::nullopt;
    std::size_t first = 0;
    for (std::size_t i = 0; i < at_ && i < words_.size(); ++i)
      if (type(i) == Lexer::KW_THEN || type(i) == Lexer::KW_ELSE) first = i + 1;
    if (first != 0 && first < words_.size() && type(first) != Lexer::KW_IF) {
      const std::string found = explainForeignWord(text(first));
      if (!found.empty()) return found;
    }
    const std::string found = explainForeignWord(text(0));
    if (found.empty()) return std::nullopt;
    return found;
  }

  std::optional<std::string> notEqual() const {
    if (!atEnd() || comment_.rfind("!=", 0) != 0) return std::nullopt;
    return "`!` begins a comment, so the line ends here; unequal is written `<>`";
  }

  std::optional<std::string> relations() const {
    if (atEnd() || at_ == 0 || !isRelation(here()) || !isRelation(before())) return std::nullopt;
    if (here() == Lexer::EQUAL && before() == Lexer::EQUAL) return "equality is written with one `=`";
    const std::string both = text(at_ - 1) + text(at_);
    if (both == "=<") return "`=<` is written `<=`";
    if (both == "=>") return "`=>` is written `>=`";
    if (both == "><") return "unequal is written `<>`";
    return "two signs of comparison are side by side; one of them is too many";
  }

  // A value lacks after an operator, at the end of the line or before something else.
  std::optional<std::string> missing() const {
    if (at_ == 0) return std::nullopt;
    const std::size_t last = before();
    const bool open =
        isOperator(last) || isRelation(last) || last == Lexer::LEFT_ROUND || last == Lexer::LEFT_SQUARE;
    const bool comma = last == Lexer::COMMA;
    if (atEnd()) {
      if (comma && at_ > 1 && kind_ != FileKind::DefineData)
        return "the line ends after a comma; an argument is missing";
      if (open || last == Lexer::KW_TO || last == Lexer::KW_STEP || last == Lexer::KW_AND ||
          last == Lexer::KW_OR || last == Lexer::KW_NOT)
        if (at_ > 1) return "the line ends after " + quoted(text(at_ - 1)) + "; a value is missing";
      if (last == Lexer::KW_IF && at_ == words_.size())
        return std::string("the line ends after IF; ") + kIfForm;
      return std::nullopt;
    }
    if (comma && here() == Lexer::COMMA) return "an argument is missing between two commas";
    if (comma && here() == Lexer::RIGHT_ROUND) return "an argument is missing before `)`";
    if (last == Lexer::LEFT_ROUND && here() == Lexer::COMMA) return "an argument is missing before `,`";
    if (open && (here() == Lexer::KW_THEN || here() == Lexer::COMMA || here() == Lexer::RIGHT_ROUND ||
                 here() == Lexer::RIGHT_SQUARE || isOperator(here())))
      return "a value is missing between " + quoted(text(at_ - 1)) + " and " + quoted(text(at_));
    return std::nullopt;
  }

  std::optional<std::string> brackets() const {
    int depth = 0;
    for (std::size_t i = 0; i < at_ && i < words_.size(); ++i) {
      if (type(i) == Lexer::LEFT_ROUND) ++depth;
      if (type(i) == Lexer::RIGHT_ROUND && depth > 0) --depth;
    }
    if (here() == Lexer::RIGHT_ROUND && depth == 0) return "this `)` has no `(` before it";
    if (depth == 0) return std::nullopt;
    if (atEnd()) return "a closing bracket `)` is missing";
    if (here() == Lexer::KW_THEN) return "a closing bracket `)` is missing before THEN";
    if (isRelation(here()) || here() == Lexer::EQUAL || here() == Lexer::KW_TO || here() == Lexer::KW_STEP)
      return "a closing bracket `)` is missing before " + quoted(text(at_));
    return std::nullopt;
  }

  std::optional<std::string> ifForms() const {
    if (kind_ != FileKind::Macro) return std::nullopt;
    if (!hasIf()) {
      if (here() == Lexer::KW_THEN || type(0) == Lexer::KW_THEN)
        return std::string("THEN without IF; ") + kIfForm;
      return std::nullopt;
    }
    const std::size_t start = lastIf();
    bool then = false;
    bool relation = false;
    for (std::size_t i = start; i < words_.size() && i <= at_; ++i) {
      if (type(i) == Lexer::KW_THEN && i < at_) then = true;
      if (!then && isRelation(type(i))) relation = true;
    }
    if (then) {
      if (here() == Lexer::KW_THEN) return "THEN appears twice";
      return std::nullopt;
    }
    if (here() == Lexer::KW_THEN && !relation)
      return "the condition holds no comparison; write `IF a = 1 THEN statement`";
    if (start == at_ && start != 0) return "an IF is only at the start of a line or after THEN";
    if (isRelation(here()) && relation && !isRelation(before()))
      return "a condition compares two values once; use a second IF";
    if (atEnd() || isWord(here()) || here() == Lexer::COMMA || isValue(here())) {
      if (relation) return std::string("THEN is missing after the condition; ") + kIfForm;
      if (atEnd()) return std::string("IF without a comparison and THEN; ") + kIfForm;
      return "a comparison is missing after " + quoted(text(at_ == 0 ? 0 : at_ - 1)) + "; " + kIfForm;
    }
    return std::nullopt;
  }

  std::optional<std::string> definitions() const {
    if (kind_ != FileKind::DefineData) return std::nullopt;
    if (type(1) == Lexer::EQUAL && here() == Lexer::EQUAL)
      return "a second `=`; write one `NAME = number` a line";
    if (here() == Lexer::COMMA && at_ > 2)
      return "a decimal point is written `.`; one `NAME = number` is on a line";
    return "this is no definition; each line of DefineData.txt reads `NAME = number`";
  }

  std::optional<std::string> statementForms() const {
    if (kind_ != FileKind::Macro) return std::nullopt;
    const std::size_t first = type(0);
    if (first == Lexer::KW_FOR) return forForm();
    if (first == Lexer::KW_GOTO) return "GOTO takes the name of one label: `GOTO label`";
    if (first == Lexer::KW_ON_ERROR) return "an error handler is written `ON_ERROR GOTO label`";
    if (first == Lexer::KW_NEXT) return "NEXT takes the variable of its FOR: `NEXT i`";
    if (first == Lexer::KW_CONTINUE) return "nothing follows CONTINUE";
    if (first == Lexer::HASH_INCLUDE) return "`#INCLUDE` takes one file name: `#INCLUDE \"file.mac\"`";
    if (first == Lexer::KW_ARGS || first == Lexer::KW_GLOBAL || first == Lexer::KW_LOCAL ||
        first == Lexer::KW_PERMANENT)
      return text(0) + " takes names separated by commas: `" + text(0) + " a, b$`";
    if (isNameType(first) && type(1) == Lexer::EQUAL && at_ > 1) {
      if (here() == Lexer::EQUAL) return "a second `=` in an assignment; a comparison is only after IF";
      if (here() == Lexer::COMMA) return "an assignment takes one value; a decimal point is written `.`";
    }
    if (!hasIf() && isRelation(here())) {
      if (here() == Lexer::EQUAL) return "`=` follows one variable only, at the start of an assignment";
      return "a comparison is only after IF";
    }
    return std::nullopt;
  }

  std::optional<std::string> forForm() const {
    const std::string form = "write `FOR i = 1 TO 10` and, further down, `NEXT i`";
    if (!isNameType(type(1))) return "the variable of FOR is missing; " + form;
    if (type(2) != Lexer::EQUAL) return "`=` is missing after the variable of FOR; " + form;
    if (!has(Lexer::KW_TO)) return "TO is missing in FOR; " + form;
    return std::nullopt;
  }

  std::optional<std::string> separators() const {
    if (at_ == 0) return std::nullopt;
    const bool value = isValue(here()) || here() == Lexer::LEFT_ROUND;
    const bool after = isValue(before()) || before() == Lexer::RIGHT_ROUND;
    if (!value || !after) return std::nullopt;
    if (before() == Lexer::NUMBER && isNameType(here()) && words_[at_ - 1].touchesNext)
      return "a name begins with a letter; between " + quoted(text(at_ - 1)) + " and " + quoted(text(at_)) +
             " an operator or a comma is missing";
    const bool assignment = kind_ == FileKind::Macro && type(1) == Lexer::EQUAL;
    if (assignment)
      return "an operator is missing between " + quoted(text(at_ - 1)) + " and " + quoted(text(at_));
    return "a comma is missing between " + quoted(text(at_ - 1)) + " and " + quoted(text(at_)) +
           "; arguments are separated by commas";
  }

  std::optional<std::string> placement() const {
    switch (here()) {
    case Lexer::LEFT_SQUARE:
    case Lexer::RIGHT_SQUARE:
      return quoted(text(at_)) + " is on a line of its own, where it opens or closes a block";
    case Lexer::COLON: return "a label is a name and is alone on its line: `:name` or `name:`";
    case Lexer::DOT:
      return type(0) == Lexer::KW_CALL ? "put the file name between quotes" : "`.` is only inside a number";
    case Lexer::BACKSLASH: return "a file name is between quotes";
    case Lexer::HASH_INCLUDE: return "`#INCLUDE` is at the start of a line";
    default: break;
    }
    if (type(0) == Lexer::COLON) return "a label is a name and is alone on its line: `:name` or `name:`";
    if (at_ == 0 && !isWord(here()))
      return "a line begins with a command, a variable or a label, not with " + quoted(text(0));
    return std::nullopt;
  }

  FileKind kind_;
  const std::vector<Word>& words_;
  std::size_t at_;
  const std::string& comment_;
};

} // namespace

std::string explainLine(FileKind kind, const std::vector<Word>& words, std::size_t at,
                        const std::string& comment) {
  return BadLine(kind, words, at, comment).explain();
}

std::string explainForeignWord(const std::string& word) {
  static constexpr std::array<std::pair<const char*, const char*>, 32> kWords{{
      {"WHILE", "use FOR or IF ... GOTO"},
      {"WEND", "use FOR or IF ... GOTO"},
      {"ENDWHILE", "use FOR or IF ... GOTO"},
      {"END_WHILE", "use FOR or IF ... GOTO"},
      {"DO", "use FOR or IF ... GOTO"},
      {"LOOP", "use FOR or IF ... GOTO"},
      {"REPEAT", "use FOR or IF ... GOTO"},
      {"UNTIL", "use FOR or IF ... GOTO"},
      {"ENDIF", "an IF holds one statement on its line; for more use GOTO"},
      {"END_IF", "an IF holds one statement on its line; for more use GOTO"},
      {"ELSEIF", "write a second IF"},
      {"ELSIF", "write a second IF"},
      {"ELIF", "write a second IF"},
      {"END", "a macro ends with its last line, a FOR with NEXT"},
      {"ENDFOR", "a FOR ends with NEXT and its variable"},
      {"BREAK", "leave a FOR with GOTO"},
      {"EXIT", "leave a FOR with GOTO"},
      {"EXITFOR", "leave a FOR with GOTO"},
      {"GOSUB", "use CALL and a file of its own"},
      {"RETURN", "a called macro ends with its last line"},
      {"SUB", "use CALL and a file of its own"},
      {"FUNCTION", "use CALL and a file of its own"},
      {"LET", "write `name = value`"},
      {"DIM", "how an array is declared is not known"},
      {"REM", "a comment begins with `!`"},
      {"SELECT", "use several IF"},
      {"SWITCH", "use several IF"},
      {"CASE", "use several IF"},
      {"PRINT", "use MESSAGE or DEBUG"},
      {"FOREACH", "use FOR"},
      {"MSGBOX", "use MESSAGE"},
      {"VAR", "write `name = value`, or LOCAL and GLOBAL"},
  }};
  const std::string key = foldCase(word);
  for (const auto& [name, remedy] : kWords)
    if (key == name) return "GibbsCAM macros have no " + key + "; " + remedy;
  return "";
}

} // namespace dotek::frontend::gibbs
