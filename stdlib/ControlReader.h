// Reads the file of a control; private to Control*.cpp.
#pragma once

#include "stdlib/Control.h"
#include "stdlib/ControlFacts.h"
#include "stdlib/ControlSection.h"
#include "stdlib/Toml.h"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dotek::stdlib {

// More than any control has; checks compare each with each.
inline constexpr std::size_t kMostCodes = 2000;
inline constexpr std::size_t kMostRanges = 100;

std::string codeText(char letter, std::uint32_t tenths); // "G54.1"

class ControlReader {
public:
  // `documents`: of the control, then those that it extends, the nearest first. Tables merge key by key.
  // `base`: the control that the first extends; nullptr: none. Its ranges, codes, calls and alarms are those
  // of the new one, too, where the new one says nothing else of them and does not remove them.
  ControlReader(const std::vector<TomlDocument>& documents, const Control* base)
      : document_(documents.front()), base_(base) {
    for (const TomlDocument& document : documents)
      roots_.push_back(document.root());
  }
  Control read();
  // After read(): what is known and where from; `base` is the same of the control that this one extends.
  std::vector<ControlFact> facts(std::vector<ControlFact> base, const std::string& file) const;

private:
  struct Origin {
    std::string grade, source;
  };
  struct Span {
    std::uint32_t first = 0, last = 0;
    bool meets(std::uint32_t from, std::uint32_t to) const { return from <= last && first <= to; }
  };
  static Origin origin(const TomlTable& table);
  static Origin origin(const ControlSection& section) { return origin(section.nearest()); }
  template <class Table>
  static std::uint32_t whole(const Table& table, std::string_view key, std::string_view what,
                             std::int64_t least, std::int64_t most) {
    return static_cast<std::uint32_t>(table.require(key, what).integer(least, least, most));
  }
  ControlSection optional(std::string_view key) const;
  ControlSection section(std::string_view key, std::string_view what) const {
    ControlSection out = optional(key);
    if (!out) roots_.front().require(key, what);
    return out;
  }
  // [[key]] of the control's own file.
  std::vector<TomlTable> own(std::string_view key) const { return roots_.front().value(key).tables(); }
  std::vector<TomlTable> own(std::string_view key, std::string_view what) const {
    return base_ == nullptr ? roots_.front().require(key, what).tables() : own(key);
  }

  // Control.cpp
  void decimal();
  void lengths();
  void words();
  void language();
  void common();
  std::vector<VariableRange> systemRanges(std::string_view key);
  void alarm();
  void programs();
  void motion();
  void dwell();
  void rotation();
  void turning();

  // ControlMerge.cpp
  void removals();
  bool isRemoved(char letter, std::uint32_t tenths) const;
  bool isRemoved(std::uint32_t variable) const;
  void inherit(std::vector<VariableRange>& ranges, const std::vector<VariableRange>& base) const;
  void inheritStates();
  void inheritCodes();
  void inheritCalls();

  // ControlCodes.cpp
  void codes(const TomlTable& table);
  void codeRanges(const TomlTable& table);
  std::optional<CodeInfo> parseCode(const TomlValue& item) const;
  void check(const CodeInfo& code, const TomlValue& item);
  void alarms();

  // ControlCalls.cpp
  std::optional<std::pair<char, std::uint32_t>> parseName(const TomlValue& item) const;
  void calls();
  void readAhead();
  void output();

  // ControlVariables.cpp
  using Taken = std::vector<std::pair<std::string_view, int>>;
  void variables();
  void withToolLength();
  void state(Taken& blocks);
  void window(Taken& blocks);
  void package();
  void overlaps(const ControlSection& table, const Taken& blocks) const;
  void takeAway(const ControlSection& table, std::string_view key, std::optional<int>& member, Taken& blocks);

  const TomlDocument& document_;
  const Control* base_;
  std::vector<TomlTable> roots_; // of the documents
  std::vector<std::pair<char, Span>> removedCodes_;
  std::vector<Span> removedVariables_;
  std::vector<std::string> removedAlarms_; // names, or "all"
  std::vector<std::string> removedKeys_;   // of [variables]
  Control control_;
};

} // namespace dotek::stdlib
