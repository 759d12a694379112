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

} // namespace dotek::frontend::macrob
