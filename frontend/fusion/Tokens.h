// Words of JavaScript, as posts of Fusion are written in.
#pragma once

#include "support/Source.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace dotek::frontend::fusion {

enum class TokenType : std::uint8_t {
  End,
  Name, // keywords too: some are names where posts use them so
  Number,
  String,
  Template, // `..`, or a part of one: `..${, }..${, }..`
  Regex,
  Sign,
  Bad // a character of no word, a text that does not end
};

struct Token {
  TokenType type = TokenType::End;
  bool newLine = false; // a line ends before it
  std::uint32_t begin = 0, end = 0;
};

struct Comment {
  SourceRange range;
};

struct Tokens {
  std::vector<Token> tokens; // the last one is End
  std::vector<Comment> comments;
  std::vector<SourceRange> mergeMarkers; // lines that a version control left in the file; read as comments
};

Tokens tokenize(FileId file, std::string_view text);

bool isNameStart(char c);
bool isNamePart(char c);
// A word that cannot be the name of a variable.
bool isReserved(std::string_view word);

} // namespace dotek::frontend::fusion
