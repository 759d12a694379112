// Writes a cycle as the files of a custom drill cycle of GibbsCAM: fields, dialog, checks and path.
#pragma once

#include "backends/common/EmittedLine.h"
#include "ir/Cycle.h"
#include "support/Diagnostics.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::backends::gibbs {

// A value that a field may have, and what the dialog says of it (UTF-8).
struct Choice {
  double value = 0;
  std::string title;
};

// A field of DefineData.txt, which the post prints by its name.
struct Field {
  ir::VariableId variable = 0;
  std::string name;            // in the CAM's files and in the Prog
  double initial = 0;          // mm, degrees, mm/min
  bool asked = true;           // has an input in the dialog; else the checks compute it
  std::string unit;            // "mm"; "" for none
  std::string meaning;         // UTF-8
  std::string group;           // heading in the dialog; "": none
  std::vector<Choice> choices; // of a list; empty: a number
};

struct TakenNames {
  std::set<std::string> names;     // in small letters
  std::map<std::string, int> next; // the number to try next, by the name that was wanted
};

// Names in the CAM's files of all variables of a cycle.
class Names {
public:
  // Keeps names that the language takes; others are changed, those of parameters with a note.
  Names(const ir::Cycle& cycle, Diagnostics& diagnostics);
  const std::string& of(ir::VariableId id) const { return names_.at(id); }
  // The next variable of the cycle, which Dotek adds.
  ir::VariableId add(std::string_view wanted);
  // A name that nothing else bears: "plane", "plane_2".
  std::string fresh(std::string_view wanted);

private:
  std::vector<std::string> names_;
  TakenNames taken_;
};

struct Folder {
  std::string name;        // of the cycle in the CAM and in the Prog
  std::string title;       // of the dialog, UTF-8
  std::string description; // first line of DefineData.txt, UTF-8; "": none
  std::vector<Field> fields;
  // First numbers of variables of the control that hold its place along X, Y and Z, active work offset.
  std::vector<std::uint32_t> places;
  std::optional<double> clearance; // beside a surface of calls of the source that state none
};

struct FolderText {
  std::vector<EmittedLine> define, dialog, checks, path;
};

// The files. Host inputs of the checks are the tool's radius alone, which a field holds where the body needs
// it. `cycle` is folded, and none of its optional parameters may be null. nullopt where the CAM cannot say
// something: reported.
std::optional<FolderText> emit(const ir::Cycle& cycle, const Folder& folder, const Names& names,
                               Diagnostics& diagnostics);

// A text as a macro or a dialog holds it, without quotes around it: ASCII, no double quote. Changes are
// noted.
std::string plain(std::string_view utf8, SourceRange range, Diagnostics& diagnostics);

// What stands for the number of a field, and for the clearance plane, in blocks that progBranch() turns into
// text.
std::string hole(std::string_view field);
std::string clearanceHole();

// A block of the branch.
struct Block {
  EmittedLine out;
  bool numbered = false; // it has an N number of its own
  bool comment = false;
};
// The branch of the Prog that prints the blocks for the cycle of this name, with the routine and the formats
// that it needs. `decimals`: of a printed number. nullopt: the clearance plane is where no command prints it.
std::optional<std::vector<EmittedLine>> progBranch(const Folder& folder, const std::vector<Block>& blocks,
                                                   int decimals, const std::vector<std::string>& remarks);

// Of emit(), each one file.
std::vector<EmittedLine> defineLines(const Folder& folder, Diagnostics& diagnostics);
std::vector<EmittedLine> dialogLines(const Folder& folder, Diagnostics& diagnostics);

} // namespace dotek::backends::gibbs
