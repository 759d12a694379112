#include "frontend/mikroprog/Renumber.h"

#include "support/messages/Mikroprog.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <vector>

namespace dotek::frontend::mikroprog {

namespace {

constexpr std::uint64_t kLast = 999'999'999; // what the reader takes

struct Change {
  std::uint32_t begin = 0, end = 0;
  std::string text;
};

} // namespace

std::optional<std::string> renumber(const Program& program, const Renumbering& how, const SourceMap& sources,
                                    Diagnostics& diagnostics) {
  std::map<std::uint64_t, std::uint64_t> numbers; // old to new; of several blocks: 0
  std::vector<Change> changes;
  bool good = true;
  const auto refuse = [&](SourceRange range, std::string_view why) {
    diagnostics.report<diag::SufRenumber>(range, sources.textUtf8(range), why);
    good = false;
  };
  std::uint64_t next = how.start;
  for (const Line& line : program.lines) {
    if (line.unread) return std::nullopt; // the reader has said why
    const bool block = !line.words.empty() || line.assignment;
    if (!line.number && !(how.all && block)) continue;
    if (next > kLast) {
      refuse(line.range, "would get a number of more than nine digits; take a smaller `--start` or `--step`");
      return std::nullopt;
    }
    if (line.number) {
      const auto [at, isNew] = numbers.emplace(*line.number, next);
      if (!isNew) at->second = 0;
      changes.push_back({line.numberRange.begin, line.numberRange.end, fmt::format("N{}", next)});
    } else {
      const SourceRange first = line.assignment ? line.assignment->range : line.words.front().range;
      changes.push_back({first.begin, first.begin, fmt::format("N{} ", next)});
    }
    next += how.step;
  }
  for (const Line& line : program.lines) {
    if (line.find('@') != nullptr) continue;
    for (const Word& word : line.words) {
      if (word.address != 'L') continue;
      const bool whole = word.value.number && *word.value.number >= 0 &&
                         *word.value.number <= double(kLast) &&
                         double(std::uint64_t(*word.value.number)) == *word.value.number;
      const auto at = whole ? numbers.find(std::uint64_t(*word.value.number)) : numbers.end();
      if (at == numbers.end())
        refuse(word.range, whole ? "names no block of the program; write the number of one"
                                 : "names a block by a parameter, which nobody can follow; write its number");
      else if (at->second == 0)
        refuse(word.range, "names several blocks; give them different numbers first");
      else
        changes.push_back({word.range.begin, word.range.end, fmt::format("L{}", at->second)});
    }
  }
  if (!good) return std::nullopt;
  std::sort(changes.begin(), changes.end(),
            [](const Change& a, const Change& b) { return a.begin < b.begin; });
  const std::string_view bytes = sources.file(program.file).bytes();
  std::string out;
  std::size_t from = 0;
  for (const Change& change : changes) {
    out.append(bytes.substr(from, change.begin - from)).append(change.text);
    from = change.end;
  }
  return out.append(bytes.substr(from));
}

} // namespace dotek::frontend::mikroprog
