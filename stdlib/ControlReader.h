// Reads the file of a control; private to Control*.cpp.
#pragma once

#include "stdlib/Control.h"
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
  // `documents`: of the control, then those that it extends, the nearest first. A section is taken from the
  // first that has it. `base`: the control that the first extends; nullptr: none. Its codes are those of the
  // new one, too, unless the new one gives them another meaning.
  ControlReader(const std::vector<TomlDocument>& documents, const Control* base)
      : document_(documents.front()), base_(base) {
    for (const TomlDocument& document : documents)
      roots_.push_back(document.root());
  }
  Control read();

private:
  struct Origin {
    std::string grade, source;
  };
  static Origin origin(const TomlTable& table);
  static std::uint32_t whole(const TomlTable& table, std::string_view key, std::string_view what,
                             std::int64_t least, std::int64_t most);
  TomlValue find(std::string_view key) const {
    for (const TomlTable& root : roots_)
      if (const TomlValue found = root.value(key)) return found;
    return {};
  }
  TomlValue require(std::string_view key, std::string_view what) const {
    const TomlValue found = find(key);
    return found ? found : roots_.front().require(key, what);
  }
  TomlTable section(std::string_view key, std::string_view what) const { return require(key, what).table(); }
  TomlTable optional(std::string_view key) const { return find(key).table(); }

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
  void rotation();

  // ControlCodes.cpp
  void codes(const TomlTable& table);
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
  void overlaps(const TomlTable& table, const Taken& blocks) const;

  const TomlDocument& document_;
  const Control* base_;
  std::vector<TomlTable> roots_; // of the documents
  Control control_;
};

} // namespace dotek::stdlib
