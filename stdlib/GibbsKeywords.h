// Tables of the GibbsCAM macro language: commands with their arguments, parameter families, functions,
// variables, dialog controls. Data: stdlib/keywords/gibbs-*.toml.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::stdlib {

class DataFiles;

inline constexpr std::uint32_t kNoBound = UINT32_MAX;

// One argument of a command, as the signature language of gibbs-commands.toml gives it.
struct ArgumentSpec {
  enum class Kind : std::uint8_t {
    Value,     // an expression that is read
    Result,    // a variable that is written
    ReadWrite, // a variable that is read and written
    Choice,    // one of `keywords`, recognised by position
    Parameter, // a parameter name of `family`, recognised by position
  };
  enum class Type : std::uint8_t { Number, Text, ByParameter };
  Kind kind = Kind::Value;
  Type type = Type::Number;
  bool array = false;
  bool optional = false;
  std::uint32_t repeat = 1; // how often it may appear; kNoBound: any number
  bool geometry = false;    // takes P1, L8, C25 too
  std::string name;
  std::vector<std::string> keywords; // Choice, upper case
  std::string family;                // Parameter
};

struct CommandSignature {
  std::string name; // upper case
  std::vector<ArgumentSpec> arguments;
  char grade = 'D'; // D documented, O observed, I inferred, U unknown
  std::string source;
  bool unsure = false;       // number or kinds of arguments are not certain: no error for a mismatch
  bool openKeywords = false; // other keywords than those of a Choice may exist
};

struct FunctionSpec {
  std::string name;  // upper case, with $
  std::string types; // one letter an argument: n number, t text
  char result = 'n';
  char grade = 'D';
  std::string source;
  bool open = false; // the arguments are not known: any are accepted
  std::string note;  // "" for none
};

enum class ParameterKind : std::uint8_t { Number, Text, Mixed, Keyword }; // Mixed: the sources do not say

// A variable that GibbsCAM sets before it runs a macro of a custom drill cycle.
struct CallbackVariable {
  std::string name;
  bool read = false;
  bool write = false;
  std::vector<std::string> where; // "CycleData.mac", ...
  std::string note;
  char grade = 'D';
};

// Names that walk a list. One of the commands `snapshot` has to run before any of them is read.
struct CursorNames {
  std::vector<std::string> snapshot; // upper case
  std::string after;                 // a command that runs before the snapshot, "" for none
  std::vector<std::string> names;
  std::vector<std::string> advances; // each read of these moves on: do not repeat, drop or move it
};

// A macro that GibbsCAM starts by itself, by its file name.
struct SystemMacro {
  std::string event;
  std::string when; // "at", "before", "after"
  std::string file; // "" where the name is not known
};

class GibbsKeywords {
public:
  // Loads the tables from the data files; a defect in them throws DataError (stdlib/DataFiles.h).
  static GibbsKeywords load(const DataFiles& files);
  GibbsKeywords(GibbsKeywords&&) noexcept;
  GibbsKeywords& operator=(GibbsKeywords&&) noexcept;
  ~GibbsKeywords();

  // All lookups are without case.
  std::vector<const CommandSignature*> commands(std::string_view name) const; // empty: unknown
  bool isCommand(std::string_view name) const;
  bool isCore(std::string_view name) const; // statement words that the grammar handles (IF, FOR, ...)
  // The correct name where `name` is an old or misprinted spelling.
  std::optional<std::string_view> renamedTo(std::string_view name) const;
  std::vector<const CommandSignature*> dialogControls(std::string_view name) const;
  const FunctionSpec* function(std::string_view name) const;
  bool isParameter(std::string_view family, std::string_view parameter) const;
  bool isTextParameter(std::string_view family, std::string_view parameter) const;
  bool hasFamily(std::string_view family) const;
  // Dotek's host input (`tool_radius`, ...) that a parameter reads, if any.
  std::optional<std::string_view> hostInput(std::string_view family, std::string_view parameter) const;
  bool isSystemVariable(std::string_view name) const; // set by GibbsCAM or by commands; never undefined
  bool isConstant(std::string_view name) const;

  // Commands, controls or variables of which only the beginning of the name is known.
  bool hasCommandPrefix(std::string_view name) const;
  bool hasVariablePrefix(std::string_view name) const;
  // Remarks on a command or a control; empty for most.
  std::vector<std::string_view> commandNotes(std::string_view name) const;
  std::vector<std::string_view> controlNotes(std::string_view name) const;
  // Controls whose shape is only guessed at: arguments are not checked.
  bool isUnprovedControl(std::string_view name) const;
  std::span<const std::string> requiredControls() const; // upper case: OK, CANCEL
  std::string_view firstControl() const;                 // DIALOG
  std::string_view imageSuffix() const;                  // "bmp"
  // Nothing where the family does not know the name (an open family may still have it).
  std::optional<ParameterKind> parameterKind(std::string_view family, std::string_view parameter) const;
  bool isOpenFamily(std::string_view family) const; // its list is known to be incomplete
  const CallbackVariable* callback(std::string_view name) const;
  const CursorNames* cursor(std::string_view name) const;
  bool readAdvances(std::string_view name) const; // a cursor name that moves on when it is read
  // The version in which a system variable vanished.
  std::optional<std::string_view> removedSince(std::string_view name) const;
  // Names of DefineData.txt that switch fields of the standard drill dialog.
  bool isReservedField(std::string_view name) const;
  std::span<const SystemMacro> systemMacros() const;

  // Nearest known name within a third of its length, for messages; empty: none.
  std::string nearestCommand(std::string_view name) const;
  std::string nearestControl(std::string_view name) const;
  std::string nearestVariable(std::string_view name) const; // system variables and constants
  std::string nearestFunction(std::string_view name) const;
  std::string nearestParameter(std::string_view family, std::string_view parameter) const;

  struct Tables; // stdlib/GibbsTables.h, private to the loader

private:
  friend struct TableStore;
  GibbsKeywords();
  std::unique_ptr<Tables> tables_;
};

} // namespace dotek::stdlib
