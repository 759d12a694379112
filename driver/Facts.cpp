#include "driver/Facts.h"

#include "driver/Command.h"
#include "project/Lowering.h"
#include "stdlib/ControlFacts.h"

#include <algorithm>
#include <fmt/format.h>

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
                       fact.file, file, fact.key, joint, fact.text, fact.source.empty() ? "" : "  // ",
                       fact.source);
  }
  return outcomeOf(session, out);
}

} // namespace

Outcome listFacts(const std::string& control, const CommonOptions& options) {
  return guarded(options, [&](Session& session) { return factsOf(control, session); });
}

} // namespace dotek::driver
