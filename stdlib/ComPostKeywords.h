// Known words of ComPost. Data: stdlib/keywords/compost.toml. A word outside the table is a note, never an
// error: the vendor's list is not public.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace dotek::stdlib {

class DataFiles;

enum class KeywordKind : std::uint8_t { Flow, Command, Numeric, Boolean, Directive, Sequence };
enum class Prints : std::uint8_t { Yes, No, Maybe };

struct ComPostKeyword {
  std::string name; // without suffix
  KeywordKind kind = KeywordKind::Command;
  bool argument = false; // takes ('x')
  Prints prints = Prints::Maybe;
  char grade = 'D';
  std::string source;
  std::string summary;
};

class ComPostKeywords {
public:
  static ComPostKeywords load(const DataFiles& files); // throws DataError

  // Exactly as spelt; whether case matters to the compiler is not known.
  const ComPostKeyword* find(std::string_view name) const;
  // The keyword that differs in case only; "" for none.
  std::string caseVariant(std::string_view name) const;
  std::string nearest(std::string_view name) const;
  // Routines that the engine itself calls.
  bool isEntryPoint(std::string_view name) const;

private:
  friend struct TableStore;
  std::map<std::string, ComPostKeyword, std::less<>> keywords_;
  std::set<std::string, std::less<>> entryPoints_;
};

} // namespace dotek::stdlib
