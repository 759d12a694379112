// Reads plain NC text (words and comments, no macro statement) block by block, at the speed of the disk's
// cache and in constant memory. What holds macro statements is read by a parser: `mayHoldMacros` decides
// beforehand.
#pragma once

#include "ir/NcWords.h"
#include "support/LineChunks.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace dotek::frontend::nc {

// Why a line is no plain block.
enum class ScanFault : std::uint8_t {
  None,
  BadCharacter, // a byte that begins no word
  NoNumber,     // an address without its number
  BadNumber,    // two points, or more digits than a number of a control has
  OpenComment,  // ( without )
  LateDelete,   // `/` after a word
  LateMark,     // `%` beside words
  LineTooLong,
  MacroText, // # [ ] = * or a word of the macro language
  Reading,   // the file could not be read on: chunks().error()
};

// Where: byte columns from 0 in the line.
struct ScanError {
  ScanFault fault = ScanFault::None;
  std::uint64_t line = 0;
  std::uint32_t begin = 0, end = 0;
};

class Scanner {
public:
  // All paths read the same; the others are for tests.
  enum class Way : std::uint8_t {
    Fastest,  // what the processor can do
    Portable, // what every processor can do
    Careful,  // byte by byte
  };
  explicit Scanner(LineChunks& chunks, Way way = Way::Fastest);

  enum class Result : std::uint8_t { Block, End, Error };
  // The next block that is not empty. After an error the line is skipped: reading may go on, except after
  // LineTooLong and Reading.
  Result next(ir::NcWords& words);

  const ScanError& error() const { return error_; }
  // Bytes of the line last read, without its end; good until the next call.
  std::string_view lineText() const;
  std::uint64_t line() const { return line_; }
  // From now on what precedes the first `%` is skipped, as controls do, where it ends in the first chunk.
  void skipsLeader() { skipsLeader_ = true; }
  // The first line of it; "": there is none.
  std::string_view leader() const { return leader_; }
  std::uint64_t leaderLine() const { return leaderLine_; }

private:
  bool quick(ir::NcWords& words);
  Result careful(ir::NcWords& words);
  Result fail(ScanFault fault, const char* begin, const char* end);
  bool refill();
  void skipLeader();

  LineChunks& chunks_;
  const char* at_ = nullptr;
  const char* end_ = nullptr;
  const char* lineStart_ = nullptr;
  std::uint64_t line_ = 0, leaderLine_ = 0;
  std::string leader_;
  bool skipsLeader_ = false;
  bool stopped_ = false;
  bool wide_, quick_;
  ScanError error_;
};

// Where the word is in the text of a block: the `which`-th (from 0) of this address. Comments do not
// count. nullopt: it does not.
struct WordPlace {
  std::uint32_t begin = 0, end = 0;
};
std::optional<WordPlace> findWord(std::string_view lineText, char letter, std::uint32_t which = 0);

// Whether outside of comments there is a # or a [, a word of the macro language, or G65, G66, M98, M99 in any
// spelling. Reads to the end, or to the first such place. A text that is too odd for the answer counts as one
// that may.
bool mayHoldMacros(LineChunks& chunks);

} // namespace dotek::frontend::nc
