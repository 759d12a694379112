// Programs of Mikroprog: block numbers and jumps, parameters, codes.
#include "frontend/mikroprog/Parse.h"
#include "frontend/mikroprog/Reading.h"
#include "lsp/Index.h"
#include "project/Session.h"
#include "project/Settings.h"
#include "stdlib/MikroprogControl.h"

#include <cmath>
#include <fmt/format.h>

namespace dotek::lsp {

namespace mikroprog = frontend::mikroprog;
using Role = Occurrence::Role;

namespace {

std::string factOf(const stdlib::MikroprogFunction& function) {
  std::string out = fmt::format("**{}** {}\n", function.code(), function.title);
  for (const stdlib::MikroprogAddress& address : function.addresses)
    out += fmt::format("\n- `{}`{}{}", address.letter, address.unit.empty() ? "" : " " + address.unit,
                       address.use == stdlib::AddressUse::Needed ? ", needed" : "");
  for (const std::string& note : function.notes)
    out += "\n\n" + note;
  return out + fmt::format("\n\n*{}*: {}", function.grade, function.source);
}

} // namespace

void indexMikroprog(Index& index, project::Session& session, const std::string& path) {
  Diagnostics unheard;
  const mikroprog::Program program = mikroprog::parse(index.file, session.sources(), unheard);
  std::string name = project::settingsOf(path, session).control;
  if (session.data().find("mikroprog", name) == nullptr)
    name = std::string(mikroprog::profileOf(program).value_or(stdlib::kMikroprogLathe));
  const auto control = stdlib::MikroprogControl::load(session.data(), name);
  for (const mikroprog::Line& line : program.lines) {
    if (line.number) {
      index.occurrences.push_back({fmt::format("N {}", *line.number), Role::Definition, line.numberRange});
      if (line.comment)
        index.symbols.push_back({fmt::format("N{}", *line.number),
                                 index.utf8(*line.comment),
                                 SymbolKind::Key,
                                 line.range,
                                 line.numberRange,
                                 {}});
    }
    if (line.assignment)
      index.occurrences.push_back(
          {fmt::format("P {}", line.assignment->parameter), Role::Write, line.assignment->range});
    for (const mikroprog::Word& word : line.words) {
      const auto& number = word.value.number;
      if (word.value.parameter)
        index.occurrences.push_back({fmt::format("P {}", *word.value.parameter), Role::Read, word.range});
      if (!number || !(*number >= 0 && *number < 1e6) || *number != std::floor(*number)) continue;
      const auto whole = static_cast<std::uint32_t>(*number);
      if (word.address == 'L')
        index.occurrences.push_back({fmt::format("N {}", whole), Role::Read, word.range});
      if (control && (word.address == 'G' || word.address == 'M'))
        if (const stdlib::MikroprogFunction* function = control->find(word.address, whole))
          index.facts.push_back({word.range, factOf(*function)});
    }
  }
}

} // namespace dotek::lsp
