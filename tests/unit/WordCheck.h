// Where each NC word of a source went: into a line of the result, into a word that means the same, or into a
// message. Reads the text of the Prog, the text of the result and its line map; knows nothing of how the
// back ends work.
#pragma once

#include "driver/Driver.h"
#include "stdlib/MacroSet.h"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::tests {

struct NcWord {
  char letter = 0;   // '(': a comment, '#': an assignment, '@': a file
  std::string value; // numbers as numberText writes them; "{X}": what stands for the field X
  std::string spelled;
};

// The words of one block. Whatever is no word is passed over.
std::vector<NcWord> wordsOf(std::string_view block);

struct Place {
  std::string file;
  std::uint32_t first = 0, last = 0; // lines
};

struct SourceBlock {
  Place place;
  std::string text;
  std::vector<NcWord> words;
};

struct ResultLine {
  std::string text;
  std::vector<NcWord> words;
  std::vector<Place> places; // empty: made up
  std::string reason;

  ResultLine without(std::size_t word) const;
};

enum class WordTarget : std::uint8_t { Fanuc, Mikroprog, Fusion };

// What a cycle is converted with, beside its options.
struct WordCase {
  WordTarget target = WordTarget::Fanuc;
  const stdlib::MacroSet* source = nullptr; // the set that the Prog calls
  const stdlib::MacroSet* macros = nullptr; // of the result; Mikroprog has none
  std::map<std::string, double> hosts;      // mm; those that the command line gave
  bool diameters = false;                   // X of the result is a diameter
  bool byOperator = false;                  // who enters the datum
};

// The blocks that the Prog prints for the cycle, fields with their value where it is given.
std::vector<SourceBlock> sourceBlocks(const driver::ConvertOptions& options);

// The lines of one file of the result, with the places that --map gives.
std::vector<ResultLine> resultLines(const driver::Outcome& outcome, WordTarget target);

struct WordReport {
  int emitted = 0, translated = 0, explained = 0;
  std::vector<std::string> lost; // "file:line: word, of `block`"
};

// `outcome` for its messages.
WordReport checkWords(const WordCase& how, const std::vector<SourceBlock>& blocks,
                      const std::vector<ResultLine>& lines, const driver::Outcome& outcome);

} // namespace dotek::tests
