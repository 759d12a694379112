// A vendor's pack of probing macros, as data: what each call means (stdlib/macros/<name>.toml).
#pragma once

#include "ir/Expression.h"
#include "ir/Kind.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::stdlib {

class DataFiles;

// What a call does. X(id, name in the data)
#define DOTEK_INTENTS(X)                                                                                     \
  X(ProtectedMove, "protected-move")                                                                         \
  X(Surface, "surface")                                                                                      \
  X(Bore, "bore")                                                                                            \
  X(ProbeOn, "probe-on")                                                                                     \
  X(ProbeOff, "probe-off")

enum class Intent : std::uint8_t {
#define DOTEK_INTENT(id, name) id,
  DOTEK_INTENTS(DOTEK_INTENT)
#undef DOTEK_INTENT
};
std::string_view intentName(Intent intent);

enum class ArgumentRole : std::uint8_t {
  Target,     // "target": coordinate to reach or to find, along `axis`
  Feed,       // "feed"
  Diameter,   // "diameter"
  Nominal,    // "nominal": coordinate that the feature gets along `axis` in the system that the call sets
  System,     // "system": work offset to set
  Overtravel, // "overtravel": how far the measuring move goes on behind the expected surface
};

// How a work system is written in a System argument.
enum class SystemCode : std::uint8_t {
  GNumber, // "g-number": 56 is G56
  Index,   // "index": 1 to 6 are G54 to G59
};
// What a System argument does with the offset.
enum class SystemRule : std::uint8_t {
  Nominal, // "nominal": the feature gets the coordinate of the Nominal argument
  Error,   // "error": the offset changes by measured minus target; the target is the nominal
};

struct MacroArgument {
  char letter = 0;
  ArgumentRole role = ArgumentRole::Target;
  ir::Axis axis = ir::Axis::X;       // of Target, Nominal
  ir::Frame frame = ir::Frame::Work; // of Target: Work (absolute, active system) or Here (signed travel)
  ir::Kind kind = ir::Kind::Length;
  bool selector = false; // chooses, does not measure: its digits are no length
  bool point = true;     // written with a decimal point
  bool required = false;
  SystemCode systemCode = SystemCode::GNumber;
  SystemRule systemRule = SystemRule::Nominal;
};

struct MacroResult {
  ir::ResultName name = ir::ResultName::Main;
  std::uint32_t variable = 0;
  bool documented = true; // what it holds is known; never with Main
};

// One reading of a call. A program that measures in several ways has one signature for each.
struct MacroSignature {
  std::uint32_t program = 0; // P
  std::string title;         // "single surface along X"
  Intent intent = Intent::ProtectedMove;
  std::vector<MacroArgument> arguments; // in the order in which they are written
  // At least one of these letters stands in the call; empty: no such rule.
  std::string anyOf;
  std::vector<MacroResult> results;
  std::string grade;
  std::string source;

  const MacroArgument* find(char letter) const;
  const MacroArgument* find(ArgumentRole role, ir::Axis axis) const; // axis aside for Feed, Diameter, System
};

struct MacroSet {
  std::string name; // of the file
  std::string title;
  std::string origin;
  std::vector<MacroSignature> signatures; // in the order of the file
  // Variables that the macros overwrite: nothing of the caller is kept there across a call.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> scratch;

  bool calls(std::uint32_t program) const;
  // Signatures of the program.
  std::vector<const MacroSignature*> of(std::uint32_t program) const;
  // The signature for an intent; of a surface the one along `axis`. nullptr: the set has none.
  const MacroSignature* find(Intent intent, ir::Axis axis = ir::Axis::X) const;

  static std::optional<MacroSet> load(const DataFiles& files, std::string_view name);
};

// How the letters of a call fit the signatures of its program. All empty: the set does not have the program.
struct SignatureMatch {
  const MacroSignature* signature = nullptr; // the only one that fits; nullptr: see the rest
  char unknown = 0;                          // letter that no signature of the program has
  std::string missing;    // letters that the nearest signatures need: "S", "X or Y or Z", "S and I"
  bool ambiguous = false; // every letter is known, and they belong to different readings: XY of one surface
};
SignatureMatch match(const MacroSet& set, std::uint32_t program, std::string_view letters);

} // namespace dotek::stdlib
