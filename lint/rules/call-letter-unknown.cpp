#include "frontend/macrob/Calls.h"
#include "lint/Probing.h"
#include "lint/ProgBlocks.h"

#include <algorithm>
#include <set>

namespace dotek::lint::rule {
namespace {

struct Call {
  macrob::Call call;
  std::uint32_t program = 0;
  std::string letters;
};

// Letters of a move: axes, feed, the flag instead of the alarm. Measuring macros take many more.
constexpr std::string_view kMove = "XYZABCFMEUVW";

std::set<char> lettersOf(const stdlib::MacroSet& set, std::uint32_t program) {
  std::set<char> out;
  for (const stdlib::MacroSignature* signature : set.of(program))
    for (const stdlib::MacroArgument& argument : signature->arguments)
      out.insert(argument.letter);
  return out;
}

std::string listed(const std::set<char>& letters) {
  std::string out;
  for (const char c : letters)
    out += out.empty() ? std::string(1, c) : fmt::format(" {}", c);
  return out;
}

// `own`: programs of the files, whose text says what they take.
void checkFile(const macrob::File& file, const std::set<std::uint64_t>& own, const Project& project,
               Report& report) {
  std::vector<Call> calls;
  for (const macrob::Program& program : file.programs) {
    for (const macrob::Block& block : program.blocks) {
      const auto* words = std::get_if<macrob::Words>(&block.body);
      auto call = words == nullptr ? std::nullopt : macrob::callOf(*words);
      const auto number = call ? macrob::calledProgram(*call) : std::nullopt;
      if (!number || call->kind != macrob::CallKind::Simple || own.contains(*number)) continue;
      std::string letters;
      for (const macrob::CallArgument& argument : call->arguments)
        letters += argument.word->address;
      calls.push_back({std::move(*call), *number, letters});
    }
  }
  for (const stdlib::MacroSet& set : project.macroSets) {
    // The file is one for this pack: another call fits.
    const auto fits = [&](const Call& call) {
      const std::set<char> known = lettersOf(set, call.program);
      return !known.empty() && !call.letters.empty() &&
             std::all_of(call.letters.begin(), call.letters.end(), [&](char c) { return known.contains(c); });
    };
    if (std::none_of(calls.begin(), calls.end(), fits)) continue;
    for (const Call& call : calls) {
      const std::set<char> known = lettersOf(set, call.program);
      if (known.empty()) continue;
      const bool moves = set.of(call.program).front()->intent == stdlib::Intent::ProtectedMove;
      for (const macrob::CallArgument& argument : call.call.arguments) {
        const char letter = argument.word->address;
        if (known.contains(letter)) continue;
        // What the data leave out: optional arguments of the vendor's.
        const bool open =
            moves ? kMove.find(letter) != std::string_view::npos : mayBeOf(set, call.program, {&letter, 1});
        if (open) continue;
        report.at(argument.word->range,
                  "P{} of {} takes no `{}` that is known; it takes {}; the macro leaves the value aside, or "
                  "stops for want of another letter",
                  call.program, set.title, letter, listed(known));
      }
    }
  }
}

void check(const Project& project, Report& report) {
  std::set<std::uint64_t> own;
  for (const NcFile& nc : project.programs)
    for (const macrob::Program& program : nc.file->programs)
      if (program.name) own.insert(program.name->number);
  for (const NcFile& nc : project.programs)
    checkFile(*nc.file, own, project, report);
}

} // namespace

DOTEK_LINT_RULE(call_letter_unknown){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
