#include "driver/Facts.h"

#include "driver/Command.h"
#include "project/Lowering.h"
#include "project/Settings.h"
#include "stdlib/ControlFacts.h"
#include "stdlib/ControlFiles.h"
#include "stdlib/DataFiles.h"
#include "stdlib/MacroSet.h"
#include "support/Printable.h"
#include "support/messages/Commands.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace dotek::driver {
namespace {

// "words    decimals = 3    inferred    built in: fanuc-31i-b    K: IS-B"
Outcome factsOf(const std::string& name, Session& session) {
  if (!loadControl(name, session)) return outcomeOf(session, "");
  const std::vector<stdlib::ControlFact> facts = stdlib::controlFacts(session.data(), name);
  std::size_t section = 0, grade = 0, file = 0;
  for (const stdlib::ControlFact& fact : facts) {
    section = std::max(section, fact.section.size());
    grade = std::max(grade, fact.grade.size());
    file = std::max(file, fact.file.size());
  }
  std::string out;
  for (const stdlib::ControlFact& fact : facts) {
    const std::string_view joint = fact.key.empty() || fact.text.empty() ? "" : " = ";
    out += fmt::format("{:<{}}  {:<{}}  {:<{}}  {}{}{}{}{}\n", fact.section, section, fact.grade, grade,
                       fact.file, file, fact.key, joint, printable(fact.text),
                       fact.source.empty() ? "" : "  // ", printable(fact.source));
  }
  return outcomeOf(session, out);
}

// What a letter means: "width along X", "work offset to set: 1 to 6 are G54 to G59".
std::string meaningOf(const stdlib::MacroArgument& argument) {
  using Role = stdlib::ArgumentRole;
  const std::string axis(1, "XYZ"[ir::indexOf(argument.axis)]);
  switch (argument.role) {
  case Role::Target:
    return argument.frame == ir::Frame::Here ? "travel along " + axis + ", signed, from where the probe is"
                                             : axis + " to reach or to find, in the active system";
  case Role::Nominal: return axis + " that the feature gets in the system that is set";
  case Role::Point: return axis + " of a further touch";
  case Role::Spacing: return "distance along " + axis + " to the second touch of the face";
  case Role::Feed: return "feed";
  case Role::Diameter: return "expected diameter";
  case Role::Width: return "expected width";
  case Role::Depth: return "Z at which it is probed, in the active system";
  case Role::Clearance: return "clearance beside the surface on the way down; below 0: within the feature";
  case Role::Overtravel: return "how far beyond the expected surface is searched";
  case Role::FlagOnly: return "1: a flag is set instead of an alarm";
  case Role::Tool: return "number of the tool offset to correct";
  case Role::SpareTool: return "number of the tool offset that adds up what is averaged";
  case Role::Experience: return "number of the tool offset whose value is added to the size";
  case Role::SizeTolerance: return "tolerance of the size";
  case Role::PositionTolerance: return "tolerance of the position, as the diameter of the zone";
  case Role::AngleTolerance: return "tolerance of the angle";
  case Role::UpperLimit: return "upper limit of the error; beyond it nothing is set";
  case Role::NullBand: return "error below which no tool is corrected";
  case Role::Feedback: return "share of the error that corrects the tool";
  case Role::Print: return "print the result; 1: next feature, 2: next part";
  case Role::FaceAngle: return "expected angle of the face, from +X";
  case Role::Direction: return "direction of the touch, from +X";
  case Role::Distance: return "distance from the start to the expected surface";
  case Role::FirstAngle: return "direction of the first touch, from +X";
  case Role::SecondAngle: return "direction of the second touch, from +X";
  case Role::ThirdAngle: return "direction of the third touch, from +X";
  case Role::PitchDiameter: return "diameter of the circle of the holes";
  case Role::StartAngle: return "angle of the first hole";
  case Role::Number: return "how many";
  case Role::Task: return "what is calibrated";
  case Role::Unstated: return "no source says what it is";
  case Role::System: break;
  }
  std::string out = "work offset to set: ";
  out += argument.systemCode == stdlib::SystemCode::Index ? "1 to 6 are G54 to G59" : "54 is G54";
  if (argument.extendedFirst != 0)
    out += fmt::format(", {} to {} are G54.1 P1 and following", numberText(argument.extendedFirst),
                       numberText(argument.extendedLast));
  return out;
}

std::string callsOf(const stdlib::MacroSet& set) {
  std::string out = set.title + "\n";
  for (const stdlib::MacroSignature& one : set.signatures) {
    out += fmt::format("\nP{} {}  ({})\n", one.program, one.title, one.grade);
    for (const stdlib::MacroArgument& argument : one.arguments)
      out += fmt::format("  {}  {}{}{}\n", argument.letter, meaningOf(argument),
                         argument.required ? "; always given" : "",
                         argument.unknown.empty() ? "" : "; not known: " + argument.unknown);
    if (!one.anyOf.empty()) out += fmt::format("  one or more of: {}\n", fmt::join(one.anyOf, ", "));
    for (const stdlib::RefusedLetters& pair : set.refused) {
      if (std::find(pair.programs.begin(), pair.programs.end(), one.program) == pair.programs.end()) continue;
      const bool taken = std::all_of(pair.letters.begin(), pair.letters.end(),
                                     [&](char letter) { return one.find(letter) != nullptr; });
      if (taken) out += fmt::format("  not together: {}\n", fmt::join(pair.letters, ", "));
    }
    if (!one.unknown.empty()) out += "  not known: " + one.unknown + "\n";
  }
  return out;
}

Outcome macrosOf(const std::string& name, Session& session) {
  try {
    if (const auto set = stdlib::MacroSet::load(session.data(), name))
      return outcomeOf(session, callsOf(*set));
  } catch (const stdlib::DataError& error) {
    session.diagnostics().report<diag::DataFileDefect>({}, error.what());
    return outcomeOf(session, "");
  }
  std::vector<std::string> known;
  for (const stdlib::DataFile* file : session.data().list("macros"))
    known.push_back(file->name);
  session.diagnostics().report<diag::UnknownMacroSet>({}, name, fmt::format("{}", fmt::join(known, ", ")));
  return outcomeOf(session, "");
}

} // namespace

Outcome listFacts(const std::string& what, const std::string& name, const CommonOptions& options) {
  CommonOptions withFile = options; // `list controls ./mine.toml`
  if (what == "controls" && stdlib::isDataPath(name)) withFile.data.push_back(name);
  Outcome outcome = guarded(withFile, [&](Session& session) {
    checkSettings({}, session);
    if (what == "controls") return factsOf(name, session);
    if (what == "macros") return macrosOf(name, session);
    session.diagnostics().report<diag::UnknownList>({}, what + " " + name);
    return outcomeOf(session, "");
  });
  outcome.output = printableLines(outcome.output); // texts of data files
  return outcome;
}

} // namespace dotek::driver
