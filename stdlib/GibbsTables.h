// The tables after GibbsKeywords; private to stdlib.
#pragma once

#include "stdlib/GibbsKeywords.h"
#include "support/Ascii.h"

#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace dotek::stdlib {

// Keys are upper case. Nothing is printed in the order of a hash: nearest names are chosen by name.
struct NameHash {
  using is_transparent = void;
  std::size_t operator()(std::string_view name) const { return std::hash<std::string_view>()(name); }
};
template <class T> using NameMap = std::unordered_map<std::string, T, NameHash, std::equal_to<>>;

struct ParameterFamily {
  bool open = false;
  NameMap<ParameterKind> parameters;
};

struct GibbsKeywords::Tables {
  struct Command {
    std::vector<CommandSignature> signatures;
    bool core = false;
    std::vector<std::string> notes;
  };
  struct Control {
    std::vector<CommandSignature> signatures;
    bool unproved = false;
    std::vector<std::string> notes;
  };
  NameMap<Command> commands;
  std::vector<std::string> coreWords; // THEN, TO, STEP: core, but no statement begins with them
  NameMap<std::string> renamed;
  std::vector<std::string> commandPrefixes;
  NameMap<Control> controls;
  std::vector<std::string> requiredControls;
  std::string firstControl;
  std::string imageSuffix;
  NameMap<FunctionSpec> functions;
  NameMap<ParameterFamily> families;
  NameMap<std::string> hosts;     // FAMILY.PARAMETER
  NameMap<std::string> variables; // upper case to the usual spelling; callbacks and cursor names too
  NameMap<std::string> constants;
  std::vector<std::string> variablePrefixes;
  NameMap<CallbackVariable> callbacks;
  std::vector<CursorNames> cursors;
  NameMap<std::size_t> cursorOf; // index into `cursors`
  NameMap<bool> advances;
  NameMap<std::string> removed; // to the version
  NameMap<std::string> reserved;
  std::vector<SystemMacro> systemMacros;
};

} // namespace dotek::stdlib
