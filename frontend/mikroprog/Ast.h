// Syntax tree of a program of Mikroprog, line by line, with what the programmer wrote.
#pragma once

#include "support/Source.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dotek::frontend::mikroprog {

struct Value {
  std::optional<double> number;
  std::optional<std::uint32_t> parameter; // P6, -P6; `number` is empty then
  bool negative = false;                  // of a parameter
  std::string digits;                     // as written, sign included
};

struct Word {
  char address = 0; // A to Z, or '@'
  Value value;
  std::string file; // of '@'
  SourceRange range;
};

struct Term {
  char op = '+';
  Value value;
  SourceRange range;
};
struct Assignment {
  std::uint32_t parameter = 0;
  std::vector<Term> terms;
  SourceRange range;
};

// The first word of an address: what is looked for most.
struct First {
  char address = 0;
  std::uint32_t at = 0; // in the words of the line
};

struct Line {
  std::optional<std::uint64_t> number;
  SourceRange numberRange;
  std::optional<Assignment> assignment;
  std::vector<Word> words;
  std::vector<First> firsts;          // of each address
  std::uint32_t addresses = 0;        // bits of those that there are; most questions are for others
  std::optional<std::string> comment; // bytes after `;`
  SourceRange commentRange;           // `;` included
  bool unread = false;                // reported; words and assignment are what precedes the defect
  SourceRange range;

  static constexpr std::uint32_t bitOf(char address) {
    return std::uint32_t(1) << (address >= 'A' && address <= 'Z' ? address - 'A' : 26);
  }
  const Word* find(char address) const { // the first; nullptr: none
    if ((addresses & bitOf(address)) == 0) return nullptr;
    for (const First& one : firsts)
      if (one.address == address) return &words[one.at];
    return nullptr;
  }
  void add(Word word);
};

struct Program {
  FileId file = kNoFile;
  std::vector<Line> lines; // each line of the text, empty ones left out
};

} // namespace dotek::frontend::mikroprog
