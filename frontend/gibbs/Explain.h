// What a programmer wrote wrongly on a line that does not parse: the message, in the field's words.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace dotek::frontend::gibbs {

enum class FileKind : std::uint8_t { Macro, Dialog, DefineData };

struct Word {
  std::size_t type = 0; // token type of GibbsMacroLexer
  std::string text;     // UTF-8
  bool touchesNext = false;
};

// `words` are those of the line, without its end; `at` is the one that does not fit, words.size() for the
// end of the line. `comment` is the comment that ends the line, "" for none.
std::string explainLine(FileKind kind, const std::vector<Word>& words, std::size_t at,
                        const std::string& comment);

// `GibbsCAM macros have no WHILE; use ...` for a word of other languages; "" otherwise.
std::string explainForeignWord(const std::string& word);

} // namespace dotek::frontend::gibbs
