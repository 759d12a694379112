#include "frontend/macrob/Keywords.h"

#include <algorithm>
#include <iterator>

namespace dotek::frontend::macrob {
namespace {

struct Keyword {
  std::string_view text;
  WordKind kind;
};

constexpr Keyword kKeywords[] = {
    {"IF", WordKind::If},          {"THEN", WordKind::Then},      {"GOTO", WordKind::Goto},
    {"WHILE", WordKind::While},    {"DO", WordKind::Do},          {"END", WordKind::End},
    {"AND", WordKind::And},        {"OR", WordKind::Or},          {"XOR", WordKind::Xor},
    {"MOD", WordKind::Mod},        {"EQ", WordKind::Relation},    {"NE", WordKind::Relation},
    {"GT", WordKind::Relation},    {"GE", WordKind::Relation},    {"LT", WordKind::Relation},
    {"LE", WordKind::Relation},    {"SIN", WordKind::Function},   {"COS", WordKind::Function},
    {"TAN", WordKind::Function},   {"ASIN", WordKind::Function},  {"ACOS", WordKind::Function},
    {"ATAN", WordKind::Function},  {"SQRT", WordKind::Function},  {"ABS", WordKind::Function},
    {"ROUND", WordKind::Function}, {"FIX", WordKind::Function},   {"FUP", WordKind::Function},
    {"LN", WordKind::Function},    {"EXP", WordKind::Function},   {"BIN", WordKind::Function},
    {"BCD", WordKind::Function},   {"POW", WordKind::Function},   {"ADP", WordKind::Function},
    {"POPEN", WordKind::Port},     {"PCLOS", WordKind::Port},     {"DPRNT", WordKind::Print},
    {"BPRNT", WordKind::Print},    {"SETVN", WordKind::SetNames},
};

} // namespace

WordMatch wordAt(std::string_view letters) {
  WordMatch best;
  for (const Keyword& keyword : kKeywords)
    if (keyword.text.size() > best.length && letters.starts_with(keyword.text))
      best = {keyword.kind, keyword.text.size()};
  return best;
}

bool isExpressionWord(std::string_view letters) {
  while (!letters.empty()) {
    const WordMatch match = wordAt(letters);
    switch (match.kind) {
    case WordKind::And:
    case WordKind::Or:
    case WordKind::Xor:
    case WordKind::Mod:
    case WordKind::Relation:
    case WordKind::Function: letters.remove_prefix(match.length); break;
    default: return false;
    }
  }
  return true;
}

std::uint32_t argumentVariable(char letter) {
  switch (letter) {
  case 'A': return 1;
  case 'B': return 2;
  case 'C': return 3;
  case 'D': return 7;
  case 'E': return 8;
  case 'F': return 9;
  case 'H': return 11;
  case 'I': return 4;
  case 'J': return 5;
  case 'K': return 6;
  case 'M': return 13;
  case 'Q': return 17;
  case 'R': return 18;
  case 'S': return 19;
  case 'T': return 20;
  case 'U': return 21;
  case 'V': return 22;
  case 'W': return 23;
  case 'X': return 24;
  case 'Y': return 25;
  case 'Z': return 26;
  default: return 0;
  }
}

} // namespace dotek::frontend::macrob
