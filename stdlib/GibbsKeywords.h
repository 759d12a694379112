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
  std::uint32_t repeat = 1; // how often it may stand
  std::string name;
  std::vector<std::string> keywords; // Choice, upper case
  std::string family;                // Parameter
};

struct CommandSignature {
  std::string name; // upper case
  std::vector<ArgumentSpec> arguments;
  char grade = 'D'; // D documented, O observed, I inferred, U unknown
  std::string source;
};

struct FunctionSpec {
  std::string name;  // upper case, with $
  std::string types; // one letter an argument: n number, t text
  char result = 'n';
  char grade = 'D';
  std::string source;
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

  // Nearest known name within a third of its length, for messages; empty: none.
  std::string nearestCommand(std::string_view name) const;
  std::string nearestControl(std::string_view name) const;
  std::string nearestFunction(std::string_view name) const;
  std::string nearestParameter(std::string_view family, std::string_view parameter) const;

private:
  GibbsKeywords();
  struct Tables;
  std::unique_ptr<Tables> tables_;
};

} // namespace dotek::stdlib
