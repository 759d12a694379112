// Typing errors and careless edits, one at a time: the operators of docs/lint-mutation.md.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::tests {

// Kinds of files, by the letters of docs/lint-mutation.md.
constexpr std::string_view kAllKinds = "mdlpns";

struct InputFile {
  std::string name; // below the folder of the bundle
  std::string text;
  std::string code; // the text with blanks for comments, of the same length
  char kind = 0;

  bool is(std::string_view kinds) const { return kinds.find(kind) != std::string_view::npos; }
  // "web-x" of "web-x/ToolPath.mac"; "" of a file that is in no folder.
  std::string folder() const;
};

// Inputs that are linted together and give no finding.
struct Bundle {
  std::string name;
  std::vector<InputFile> files;

  const InputFile* find(const std::string& name) const; // nullptr: there is none
};

// Takes `length` bytes at `offset` out and puts `text` there.
struct Change {
  std::size_t offset = 0, length = 0;
  std::string text;
  bool operator==(const Change&) const = default;
};
using Sites = std::vector<Change>;

struct Operator {
  std::string_view id;
  std::string_view kinds;
  std::function<void(const InputFile&, const Bundle&, Sites&)> fit;
};

struct Mutant {
  const Operator* by = nullptr;
  std::size_t bundle = 0, file = 0;
  Change edit;
};

// Each list is one file of tests/unit.
std::vector<Operator> generalOperators();
std::vector<Operator> macroOperators();
std::vector<Operator> postOperators();
std::vector<Operator> programOperators();
std::vector<Operator> allOperators();

// The text with blanks for comments of this kind of file.
std::string withoutComments(const std::string& text, char kind);
std::string mutated(const InputFile& file, const Change& edit);

// `count` different mutants, one operator after the other as long as it has sites left. `unfit` gets the
// operators that fit nowhere. The same for the same seed everywhere.
std::vector<Mutant> drawMutants(const std::vector<Operator>& operators, const std::vector<Bundle>& bundles,
                                std::uint64_t seed, std::size_t count, std::vector<std::string>& unfit);

// ---- for the lists of operators
// -----------------------------------------------------------------------------

struct Line {
  std::size_t offset = 0, length = 0; // the line break is not counted
  std::string code;                   // without comments
};
std::vector<Line> linesOf(const InputFile& file);
bool isBlank(const std::string& text);

using Replace = std::function<std::optional<std::string>(const std::smatch&)>;
// For each match in a line of the code: what is in the group becomes the new text; nullopt: no site.
void eachMatch(const InputFile& file, const std::regex& pattern, std::size_t group, const Replace& replace,
               Sites& sites);
// Takes out each line whose code matches somewhere.
void dropLines(const InputFile& file, const std::regex& pattern, Sites& sites);
Change dropLine(const InputFile& file, const Line& line);

// The operator of one pattern: the group becomes the text.
Operator replacing(std::string_view id, std::string_view kinds, const char* pattern, std::size_t group,
                   Replace replace, bool ignoreCase = false);
Operator taking(std::string_view id, std::string_view kinds, const char* pattern, std::size_t group,
                bool ignoreCase = false);
Operator droppingLines(std::string_view id, std::string_view kinds, const char* pattern,
                       bool ignoreCase = false);

// Two different neighbouring letters change places; one letter alone is doubled.
std::string misspelt(const std::string& name);
// Without a letter of its middle; nullopt: too short.
std::optional<std::string> shortened(const std::string& name);
// Two different digits change places, as far after as possible; nullopt: all are equal.
std::optional<std::string> swapped(const std::string& digits);

} // namespace dotek::tests
