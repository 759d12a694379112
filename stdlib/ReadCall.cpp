#include "stdlib/ReadCall.h"

#include "stdlib/RefusedLetters.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace dotek::stdlib {
namespace {

bool has(std::string_view letters, char letter) {
  return letters.find(letter) != std::string_view::npos;
}

// "X or Y or Z"
std::string alternatives(std::string_view letters) {
  return fmt::format("{}", fmt::join(letters, " or "));
}

// What the letters lack for the signature, in the words of CallReading::missing.
std::string lack(const MacroSignature& signature, std::string_view letters, std::size_t& count) {
  std::vector<std::string> parts;
  for (const MacroArgument& argument : signature.arguments)
    if (argument.required && !has(letters, argument.letter)) parts.emplace_back(1, argument.letter);
  if (!signature.anyOf.empty() && letters.find_first_of(signature.anyOf) == std::string_view::npos) {
    const bool alone = parts.empty();
    parts.push_back(alone ? alternatives(signature.anyOf)
                          : fmt::format("({})", alternatives(signature.anyOf)));
  }
  count = parts.size();
  return fmt::format("{}", fmt::join(parts, " and "));
}

// Chooses the signature, or says what the nearest ones lack.
void choose(CallReading& out) {
  std::size_t least = SIZE_MAX;
  for (const MacroSignature& signature : out.set->signatures) {
    if (signature.program != out.program) continue;
    if (signature.fits(out.letters)) {
      if (out.signature != nullptr) {
        out.signature = nullptr;
        out.refusal = CallRefusal::Ambiguous;
        return;
      }
      out.signature = &signature;
      continue;
    }
    const bool takesAll = std::all_of(out.letters.begin(), out.letters.end(),
                                      [&](char letter) { return signature.find(letter) != nullptr; });
    if (!takesAll) continue;
    std::size_t count = 0;
    const std::string missing = lack(signature, out.letters, count);
    if (count > least) continue;
    out.missing = count < least ? missing : out.missing + " or " + missing;
    least = count;
  }
  if (out.signature != nullptr)
    out.missing.clear();
  else // no reading that takes them all: the letters of two readings are together
    out.refusal = least == SIZE_MAX ? CallRefusal::Ambiguous : CallRefusal::Missing;
}

} // namespace

const RefusedLetters* lettersRefused(const MacroSet& set, std::uint32_t program, std::string_view letters,
                                     char about) {
  const auto at = std::find_if(set.refused.begin(), set.refused.end(), [&](const RefusedLetters& rule) {
    return std::find(rule.programs.begin(), rule.programs.end(), program) != rule.programs.end() &&
           (about == '\0' || has(rule.letters, about)) &&
           std::all_of(rule.letters.begin(), rule.letters.end(),
                       [&](char letter) { return has(letters, letter); });
  });
  return at == set.refused.end() ? nullptr : &*at;
}

const ReadArgument* CallReading::find(ArgumentRole role, ir::Axis axis) const {
  const MacroArgument* meaning = signature == nullptr ? nullptr : signature->find(role, axis);
  const auto found = std::find_if(arguments.begin(), arguments.end(),
                                  [&](const ReadArgument& one) { return one.meaning == meaning; });
  return found == arguments.end() ? nullptr : &*found;
}

CallReading readCall(const MacroSet& set, std::uint32_t program, std::string_view letters) {
  CallReading out;
  out.set = &set;
  out.program = program;
  out.letters = letters;
  if (!set.calls(program)) {
    out.refusal = CallRefusal::UnknownProgram;
    return out;
  }
  for (std::size_t i = 0; i < letters.size(); ++i) {
    if (has(letters.substr(0, i), letters[i]))
      out.refusal = CallRefusal::RepeatedLetter;
    else if (!takesLetter(set, program, letters[i]))
      out.refusal = CallRefusal::UnknownLetter;
    if (out.refusal == CallRefusal::None) continue;
    out.at = i;
    return out;
  }
  out.excluded = lettersRefused(set, program, letters);
  if (out.excluded != nullptr) {
    out.refusal = CallRefusal::Excluded;
    return out;
  }
  choose(out);
  if (out.signature == nullptr) return out;
  out.arguments.reserve(letters.size());
  for (std::size_t i = 0; i < letters.size(); ++i)
    out.arguments.push_back({out.signature->find(letters[i]), i});
  return out;
}

std::string refusalText(const CallReading& reading) {
  const std::string called = fmt::format("program `{}` of `{}`", reading.program, reading.set->name);
  switch (reading.refusal) {
  case CallRefusal::None: return "";
  case CallRefusal::UnknownProgram:
    return fmt::format("`{}` has no macro P{}", reading.set->name, reading.program);
  case CallRefusal::RepeatedLetter:
    return fmt::format("the call of {} has `{}` more than once", called, reading.letter());
  case CallRefusal::UnknownLetter:
    return fmt::format("{} has no argument `{}` that Dotek knows", called, reading.letter());
  case CallRefusal::Excluded:
    return fmt::format("{} does not take {} together", called, fmt::join(reading.excluded->letters, " and "));
  case CallRefusal::Missing: return lacks(reading, reading.missing);
  case CallRefusal::Ambiguous:
    return fmt::format("the call of {} with `{}` has more than one meaning", called, reading.letters);
  }
  return "";
}

std::string lacks(const CallReading& reading, std::string_view missing) {
  return fmt::format("the call of program `{}` of `{}` lacks {}", reading.program, reading.set->name,
                     missing);
}

bool takesLetter(const MacroSet& set, std::uint32_t program, char letter) {
  return std::any_of(set.signatures.begin(), set.signatures.end(), [&](const MacroSignature& signature) {
    return signature.program == program && signature.find(letter) != nullptr;
  });
}

} // namespace dotek::stdlib
