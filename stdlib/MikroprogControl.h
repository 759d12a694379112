// A control by Mikronex: every G and M function that a source describes, conditions, files, open questions.
// Data: stdlib/mikroprog/<name>.toml (docs/data-files.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::stdlib {

class DataFiles;

// Profiles that are taken where nobody names one.
inline constexpr std::string_view kMikroprogMill = "mikroprog-mill";
inline constexpr std::string_view kMikroprogLathe = "mikroprog-s280";

enum class AddressUse : std::uint8_t {
  Needed,   // the function means nothing without it
  Given,    // in its notation; whether it may be left out is not said
  Optional, // stated to be optional
};

struct MikroprogAddress {
  char letter = 0; // '@': a file, ';': the text of the comment
  AddressUse use = AddressUse::Given;
  std::string unit;                  // "mm", "s", "block", "count", ...
  std::optional<double> least, most; // range of its value, both ends in it
};

struct MikroprogFunction {
  char letter = 'G';
  std::uint32_t number = 0;
  std::string title;
  std::string function; // what programs look it up by ("probe-move"); "" for one that none writes
  std::string group;    // modal group; "" for a function of one block
  bool start = false;   // in force before the program begins
  bool usable = true;   // false: not described, or the machine cannot run it
  std::string ends;     // what ends it; "" where only its group does, or for one block
  std::vector<MikroprogAddress> addresses;
  std::vector<std::string> either;      // letters; of at least one text one has to appear there
  std::vector<std::string> notTogether; // letters that no block may hold together
  std::string forbids;                  // letters that the function must not appear with
  std::vector<std::string> notes;
  std::string grade, source;

  const MikroprogAddress* find(char address) const; // nullptr: not in its notation
  std::string code() const;                         // "G31"
};

struct MikroprogCondition {
  std::uint32_t number = 0;
  std::string title, grade, source;
};

// What a program relies on although no source states it; the numbers are those of docs/mikroprog.md.
struct MikroprogQuestion {
  std::uint32_t number = 0;
  std::string title;    // what is taken to hold
  bool assumed = false; // without --assume
};

struct MikroprogControl {
  std::string name;     // of the file
  std::string title;    // what lists print
  std::string origin;   // "built in", or the file
  std::string axes;     // "XZ"
  std::string diameter; // axes that are written as diameters
  int decimals = 3;     // most digits after the point
  int integerDigits = 5;
  std::string programEnding, dataEnding; // of file names, without the point
  // What the panel shows; {} is the axis and the coordinate.
  std::string notFound, collision, enterShift, enterCentre;
  std::vector<MikroprogFunction> functions; // in the order of the file; each once
  std::vector<MikroprogFunction> named;     // codes that a source names and does not describe
  std::vector<MikroprogCondition> conditions;
  std::vector<MikroprogQuestion> questions;

  const MikroprogFunction* find(char letter, std::uint32_t number) const; // nullptr: not in the table
  // The first function that does this: "jump", "probe-move". load() makes sure of those that back ends write.
  const MikroprogFunction& function(std::string_view what) const;
  const MikroprogCondition* condition(std::uint32_t number) const; // nullptr: none
  const MikroprogQuestion* question(std::uint32_t number) const;   // nullptr: does not arise
  bool hasAxis(char letter) const { return axes.find(letter) != std::string::npos; }
  bool isDiameter(char letter) const { return diameter.find(letter) != std::string::npos; }

  // Throws DataError where the file has a defect. nullopt: no such control.
  static std::optional<MikroprogControl> load(const DataFiles& files, std::string_view name);
};

} // namespace dotek::stdlib
