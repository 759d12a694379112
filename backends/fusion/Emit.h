// Writes a cycle as a part of a Fusion post: ES5, one function that checks the fields and prints the blocks.
#pragma once

#include "backends/common/EmittedLine.h"
#include "ir/Cycle.h"
#include "ir/PrintedText.h"
#include "stdlib/Control.h"
#include "stdlib/MacroSet.h"
#include "support/Diagnostics.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dotek::backends::fusion {

// In the error of a fragment whose macro sets the right offset only where start and travel lead to the
// nominal.
inline constexpr std::string_view kMissedNominal = "the start and the travel do not lead to the nominal in ";

// The remark of a fragment that leaves the checks of a cycle to the program that it calls.
inline constexpr std::string_view kChecksOfProgram =
    "The checks are left to the program: a post cannot compute all that they compare.";

// A value that a field may have, and what the dialog says of it.
struct Choice {
  double value = 0;
  std::string title; // UTF-8
};

// A macro program that the fragment calls and carries, in place of printed blocks.
struct ProgramCall {
  struct Argument {
    ir::VariableId variable = 0;
    char letter = 0;
  };
  std::uint32_t number = 0;
  std::vector<Argument> arguments; // in the order of the call
  std::vector<EmittedLine> lines;  // of the program, without `%`
};

struct EmitOptions {
  const stdlib::Control& control; // of the machine that the post writes for: codes, digits
  const stdlib::MacroSet& macros;
  // The source calls another set: blocks that move or measure are written anew, the others as the Prog prints
  // them. Else all are printed as the Prog prints them.
  bool foreignMacros = false;
  std::vector<ir::PrintedBlock> printed;     // of the source, as Origin::block counts them
  std::map<ir::VariableId, double> fixed;    // by --set, --host, the job: printed as they are
  std::map<std::string, double> fixedByName; // named in the head; a start point that is here is checked
  std::map<ir::VariableId, std::vector<Choice>> choices; // of a field that the dialog offers as a list
  std::map<ir::VariableId, double> defaults; // values of the source, those its checks reject included
  // The functions of sharedHelpers() are in the post: the fragment calls them and holds none of them.
  bool helpersApart = false;
  std::optional<ProgramCall> call = std::nullopt;    // then nothing is `printed`
  std::map<ir::VariableId, std::string> groups = {}; // of fields, as the source calls them (UTF-8)
  const stdlib::MacroSet* source = nullptr;          // that the source calls; nullptr: none is known
};

// "surfaceX" of "surface-x": what each name of the fragment begins with. Letters and digits of ASCII alone; a
// name without any, or one that begins with a digit, gets "cycle" before it.
std::string prefixOf(const std::string& cycleName);

// "surfaceX_G": the property of a field.
std::string propertyOf(std::string_view prefix, std::string_view field);
// "surfaceX_give_G": 1 where an operation gives a field that may be left out, else 0.
std::string givingPropertyOf(std::string_view prefix, std::string_view field);

// The fragment: head, properties, functions PREFIX_dispatch(x, y, z) and PREFIX_write(x, y, z) with what they
// need. nullopt where something cannot be said: reported. `cycle` is folded; its body is straight.
std::optional<std::vector<EmittedLine>> emit(const ir::Cycle& cycle, const EmitOptions& options,
                                             Diagnostics& diagnostics);

// The private functions of fragments under one name for all, whatever cycles a post holds.
std::string sharedHelpers(const stdlib::Control& control);

// What is around fragments in the post of postAround(): before the first, after the last.
std::vector<EmittedLine> postHead();
// `closing`: of those that carry a program, which is written after the end.
std::vector<EmittedLine> postTail(const std::vector<std::string>& prefixes,
                                  const std::vector<std::string>& closing = {});

// The smallest post around fragments: header, formats, writeBlock, entry functions. `prefixes` of the
// fragments, in the order in which their dispatch functions are asked.
std::vector<EmittedLine> postAround(const std::vector<std::vector<EmittedLine>>& fragments,
                                    const std::vector<std::string>& prefixes,
                                    const std::vector<std::string>& closing = {});

} // namespace dotek::backends::fusion
