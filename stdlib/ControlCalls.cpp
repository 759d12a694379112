// Codes that call programs, what ends reading ahead, and what is printed.
#include "stdlib/ControlReader.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::stdlib {

// "G31", "G5.1", "M30" as letter and code times ten.
std::optional<std::pair<char, std::uint32_t>> ControlReader::parseName(const TomlValue& item) const {
  const std::string name = item.text();
  std::size_t at = 1;
  std::uint32_t tenths = 0;
  const auto digit = [&] { return at < name.size() && name[at] >= '0' && name[at] <= '9'; };
  while (digit() && at < 6)
    tenths = tenths * 10 + static_cast<std::uint32_t>(name[at++] - '0');
  tenths *= 10;
  bool good = at > 1 && (name[0] == 'G' || name[0] == 'M') && (at == 2 || name[1] != '0');
  if (good && at + 2 == name.size() && name[at] == '.') {
    ++at;
    good = digit() && name[at] != '0';
    tenths += static_cast<std::uint32_t>(good ? name[at++] - '0' : 0);
  }
  if (good && at == name.size()) return std::pair(name[0], tenths);
  document_.fail(item.range(), fmt::format("`{}` is no code; `G31` or `M30` is the form", name));
  return std::nullopt;
}

void ControlReader::calls() {
  if (const ControlSection table = optional("nesting")) {
    origin(table);
    control_.callDepth = whole(table, "calls", "how deep calls of all kinds nest", 1, 99);
  }
  for (const TomlTable& table : own("calls")) {
    const Origin origin = ControlReader::origin(table);
    CallCode call;
    const TomlValue code = table.require("code", "G5101, M50, or T");
    if (code.text() == "T") {
      call.letter = 'T';
    } else if (const auto name = parseName(code)) {
      call.letter = name->first;
      call.first = name->second / 10;
      if (name->second % 10 != 0)
        document_.fail(code.range(), "a code that calls a program is a whole number");
    } else {
      continue;
    }
    call.count = static_cast<std::uint32_t>(table.value("count").integer(1, 1, 999));
    if (call.letter == 'T' && call.count != 1)
      document_.fail(table.value("count").range(), "each T calls the same program");
    const TomlValue block = table.value("block");
    if (block) { // M98 Q, M97 P: a part of the program that is running, up to M99
      call.holds = static_cast<std::uint32_t>(block.choice({"P", "Q"}, "Q").front());
      if (call.letter != 'M' || call.count != 1)
        document_.fail(code.range(), "one M code calls a block of its own program");
    } else {
      call.program =
          whole(table, "program", "the program that the first code calls", 1, control_.programLast);
    }
    call.macro =
        table.require("as", "macro or subprogram").choice({"macro", "subprogram"}, "macro") == "macro";
    if (block && call.macro)
      document_.fail(table.value("as").range(), "a block of the same program is called as a subprogram");
    if (const TomlValue holds = block ? TomlValue() : table.value("holds")) {
      call.holds = static_cast<std::uint32_t>(holds.integer(1, 1, 999999));
      if (!control_.isCommon(*call.holds))
        document_.fail(holds.range(), fmt::format("#{} is no common variable", *call.holds));
    }
    call.grade = origin.grade;
    call.source = origin.source;
    if (control_.callCodes.size() == kMostRanges)
      document_.fail(table.range(), fmt::format("more than {} tables of calls", kMostRanges));
    for (const CallCode& other : control_.callCodes) {
      if (other.letter == call.letter && call.first < other.first + other.count &&
          other.first < call.first + call.count)
        document_.fail(code.range(), fmt::format("`{}` is given twice", code.text()));
    }
    for (std::uint32_t i = 0; i < call.count && call.letter != 'T' && !block; ++i) {
      if (control_.find(call.letter, (call.first + i) * 10) != nullptr)
        document_.fail(code.range(), fmt::format("`{}` is among the codes, too",
                                                 codeText(call.letter, (call.first + i) * 10)));
    }
    control_.callCodes.push_back(std::move(call));
  }
  if (base_ != nullptr) inheritCalls();
}

void ControlReader::readAhead() {
  const ControlSection table = optional("read_ahead");
  if (!table) return;
  origin(table);
  for (const TomlValue& item : table.require("stops", "codes that wait for motion to end").items())
    if (const auto name = parseName(item)) control_.readAheadStops.push_back(*name);
  std::sort(control_.readAheadStops.begin(), control_.readAheadStops.end());
}

void ControlReader::output() {
  const ControlSection table = optional("output");
  if (!table) return;
  origin(table);
  control_.printPadding =
      table.require("padding", "blanks or none").choice({"blanks", "none"}, "none") == "blanks";
}

} // namespace dotek::stdlib
