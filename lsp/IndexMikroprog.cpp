// Programs of Mikroprog: block numbers and jumps, parameters, codes.
#include "frontend/mikroprog/Parse.h"
#include "frontend/mikroprog/Reading.h"
#include "lsp/Controls.h"
#include "lsp/Index.h"
#include "project/Session.h"
#include "project/Settings.h"

#include <cmath>
#include <fmt/format.h>
#include <set>

namespace dotek::lsp {

namespace mikroprog = frontend::mikroprog;
using Role = Occurrence::Role;

namespace {

constexpr std::size_t kMostShown = 5; // assignments that a hover lists

// What the program gives each parameter.
std::map<std::uint32_t, std::string> parameterFacts(const Index& index, const mikroprog::Program& program,
                                                    const SourceMap& sources) {
  std::map<std::uint32_t, std::string> out;
  std::map<std::uint32_t, std::size_t> shown;
  for (const mikroprog::Line& line : program.lines) {
    if (!line.assignment) continue;
    std::string& fact = out[line.assignment->parameter];
    if (fact.empty()) fact = fmt::format("**P{}** parameter\n", line.assignment->parameter);
    const std::size_t count = ++shown[line.assignment->parameter];
    if (count == kMostShown + 1) fact += "\n- and more";
    if (count > kMostShown) continue;
    std::string text = sources.textUtf8(line.assignment->range);
    while (text.ends_with(' '))
      text.pop_back();
    fact += fmt::format("\n- `{}`", text);
    if (line.number) fact += fmt::format(" in N{}", *line.number);
    if (line.comment) fact += ": " + index.utf8(*line.comment);
  }
  return out;
}

// Blocks that something jumps to or calls.
std::set<std::uint64_t> targetsOf(const mikroprog::Program& program) {
  std::set<std::uint64_t> out;
  for (const mikroprog::Line& line : program.lines)
    for (const mikroprog::Word& word : line.words)
      if (const auto& number = word.value.number;
          word.address == 'L' && number && *number >= 0 && *number < 1e6 && *number == std::floor(*number))
        out.insert(static_cast<std::uint64_t>(*number));
  return out;
}

} // namespace

std::string mikroprogFact(const stdlib::MikroprogFunction& function) {
  std::string out = fmt::format("**{}** {}\n", function.code(), function.title);
  for (const stdlib::MikroprogAddress& address : function.addresses)
    out += fmt::format("\n- `{}`{}{}", address.letter, address.unit.empty() ? "" : " " + address.unit,
                       address.use == stdlib::AddressUse::Needed ? ", needed" : "");
  for (const std::string& note : function.notes)
    out += "\n\n" + note;
  return out + fmt::format("\n\n*{}*", function.grade);
}

std::optional<stdlib::MikroprogControl> mikroprogControl(const SourceMap& sources, FileId file,
                                                         const std::string& path, project::Session& session) {
  std::string name = project::settingsOf(path, session).control;
  if (session.data().find("mikroprog", name) == nullptr) {
    Diagnostics unheard;
    name = std::string(
        mikroprog::profileOf(mikroprog::parse(file, sources, unheard)).value_or(stdlib::kMikroprogLathe));
  }
  return stdlib::MikroprogControl::load(session.data(), name);
}

void indexMikroprog(Index& index, project::Session& session, const std::string& path) {
  Diagnostics unheard;
  const mikroprog::Program program = mikroprog::parse(index.file, session.sources(), unheard);
  const auto control = mikroprogControl(session.sources(), index.file, path, session);
  const auto facts = parameterFacts(index, program, session.sources());
  const auto parameter = [&](std::uint32_t number, Role role, SourceRange range) {
    index.occurrences.push_back({fmt::format("P {}", number), role, range, ""});
    const auto known = facts.find(number);
    index.facts.push_back(
        {range, known != facts.end()
                    ? known->second
                    : fmt::format("**P{}** parameter; nothing here gives it a value", number)});
  };
  const std::set<std::uint64_t> targets = targetsOf(program);
  std::set<std::uint64_t> numbers;
  for (const mikroprog::Line& line : program.lines) {
    if (line.number) {
      const std::string key = fmt::format("N {}", *line.number);
      index.occurrences.push_back({key, Role::Definition, line.numberRange, ""});
      if (numbers.insert(*line.number).second) index.renamable.push_back(key);
      if (line.comment || targets.contains(*line.number))
        index.symbols.push_back({fmt::format("N{}", *line.number),
                                 line.comment ? index.utf8(*line.comment) : "",
                                 SymbolKind::Key,
                                 line.range,
                                 line.numberRange,
                                 {}});
    }
    if (line.assignment) {
      SourceRange name = line.assignment->range; // P and its digits
      const std::string& bytes = session.sources().file(name.file).bytes();
      std::uint32_t end = name.begin + 1;
      while (end < name.end && bytes[end] >= '0' && bytes[end] <= '9')
        ++end;
      name.end = end;
      parameter(line.assignment->parameter, Role::Write, name);
      for (const mikroprog::Term& term : line.assignment->terms)
        if (term.value.parameter) parameter(*term.value.parameter, Role::Read, term.range);
    }
    for (const mikroprog::Word& word : line.words) {
      const auto& number = word.value.number;
      if (word.value.parameter) {
        parameter(*word.value.parameter, Role::Read, word.range);
        if (word.address == 'L') index.computedJumps = true;
      }
      if (!number || !(*number >= 0 && *number < 1e6) || *number != std::floor(*number)) continue;
      const auto whole = static_cast<std::uint32_t>(*number);
      if (word.address == 'L')
        index.occurrences.push_back({fmt::format("N {}", whole), Role::Read, word.range, ""});
      if (control && (word.address == 'G' || word.address == 'M'))
        if (const stdlib::MikroprogFunction* function = control->find(word.address, whole))
          index.facts.push_back({word.range, mikroprogFact(*function)});
    }
  }
}

} // namespace dotek::lsp
