// Words that may come next in programs of Macro B and Mikroprog.
#include "lsp/Complete.h"
#include "lsp/Controls.h"
#include "project/Lowering.h"
#include "project/Settings.h"
#include "stdlib/MikroprogControl.h"
#include "support/Ascii.h"

#include <charconv>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <set>

namespace dotek::lsp {

namespace {

// The number that the key ends with; nullopt: it ends with none.
std::optional<std::uint64_t> numberAfter(const std::string& key, std::size_t begin) {
  std::uint64_t number = 0;
  const char* const end = key.data() + key.size();
  if (begin >= key.size() || std::from_chars(key.data() + begin, end, number).ptr != end) return std::nullopt;
  return number;
}

// Numbers that the keys with this beginning end with, in ascending order.
std::set<std::uint64_t> numbersAfter(const Index& index, const std::string& kind, bool defined) {
  std::set<std::uint64_t> out;
  for (const Occurrence& one : index.occurrences)
    if (one.key.starts_with(kind) && (!defined || one.role == Occurrence::Role::Definition))
      if (const auto number = numberAfter(one.key, kind.size())) out.insert(*number);
  return out;
}

// The block without the digits that are being typed.
std::string_view stemOf(std::string_view block) {
  while (!block.empty() && isDigit(block.back()))
    block.remove_suffix(1);
  return block;
}

// Blanks do not count.
bool endsWith(std::string_view block, std::string_view word) {
  std::string plain;
  for (const char c : block)
    if (c != ' ' && c != '\t') plain += c;
  return plain.ends_with(word);
}

// The program that the block before the cursor calls; 0: none.
std::uint32_t calledIn(std::string_view block) {
  const std::size_t call = block.find("G65");
  const std::size_t at = call == std::string_view::npos ? call : block.find('P', call);
  if (at == std::string_view::npos) return 0;
  std::uint32_t out = 0;
  for (std::size_t i = at + 1; i < block.size() && (isDigit(block[i]) || (out == 0 && block[i] == ' ')); ++i)
    if (isDigit(block[i]) && out < 100000000) out = out * 10 + static_cast<std::uint32_t>(block[i] - '0');
  return out;
}

// A program of the shop: of the text itself, or of a file beside it.
struct OwnProgram {
  std::string title, file;
  std::string letters; // of locals that it reads before it sets them
};

void ownPrograms(const Index& index, const std::string& file, std::map<std::uint64_t, OwnProgram>& out) {
  for (const Occurrence& one : index.occurrences) {
    if (!one.key.starts_with("O ") || one.role != Occurrence::Role::Definition) continue;
    const auto number = numberAfter(one.key, 2);
    if (!number) continue;
    const auto [at, isNew] = out.try_emplace(*number);
    if (!isNew) continue;
    at->second.file = file;
    for (const Symbol& symbol : index.symbols)
      if (symbol.nameRange == one.range) at->second.title = symbol.detail;
    const std::string locals = fmt::format("# {} ", index.programAt(one.range.begin));
    std::set<std::string> met;
    for (const Occurrence& local : index.occurrences)
      if (local.key.starts_with(locals) && met.insert(local.key).second &&
          local.role == Occurrence::Role::Read)
        if (const auto value = numberAfter(local.key, locals.size()); value && *value < 100)
          if (const char letter = stdlib::letterOfLocal(static_cast<std::uint32_t>(*value)))
            at->second.letters += letter;
  }
}

std::map<std::uint64_t, OwnProgram> ownPrograms(const Typing& typing) {
  std::map<std::uint64_t, OwnProgram> out;
  ownPrograms(typing.index, "this file", out);
  for (const std::string& path : typing.workspace.beside(typing.document, project::InputKind::Nc))
    ownPrograms(typing.workspace.indexOf(path), std::filesystem::path(path).filename().string(), out);
  return out;
}

void programs(const Typing& typing, bool macros, std::vector<Proposal>& out) {
  std::set<std::uint64_t> seen;
  const std::size_t here = typing.index.programAt(typing.offset);
  for (const auto& [number, own] : ownPrograms(typing)) {
    const bool itself = own.file == "this file" && here < typing.index.programs.size() &&
                        typing.index.at(typing.index.programs[here]) != nullptr &&
                        typing.index.at(typing.index.programs[here])->key == fmt::format("O {}", number);
    if (!itself && seen.insert(number).second)
      out.push_back({fmt::format("P{}", number), own.title.empty() ? own.file : own.title,
                     fmt::format("O{} in {}", number, own.file), kFunction});
  }
  if (!macros) return;
  for (const stdlib::MacroSet& set : typing.session.macroSets())
    for (const stdlib::MacroSignature& signature : set.signatures)
      if (seen.insert(signature.program).second)
        out.push_back({fmt::format("P{}", signature.program), signature.title,
                       programFact(set, signature.program), kFunction});
}

void letters(const Typing& typing, const std::string& block, std::uint32_t called,
             std::vector<Proposal>& out) {
  std::set<char> given;
  const std::size_t after = block.find('P', block.find("G65"));
  const bool isTyping = isLetter(block.back()); // the letter may still become another
  for (std::size_t i = after + 1; i + (isTyping ? 1 : 0) < block.size(); ++i)
    if (isLetter(block[i])) given.insert(block[i]);
  if (const auto own = ownPrograms(typing); own.contains(called)) {
    for (const char letter : own.at(called).letters)
      if (given.insert(letter).second)
        out.push_back({std::string(1, letter), fmt::format("argument of O{}", called), "", kField});
    return;
  }
  for (const stdlib::MacroSet& set : typing.session.macroSets())
    for (const stdlib::MacroSignature* signature : set.of(called))
      for (const stdlib::MacroArgument& argument : signature->arguments)
        if (given.insert(argument.letter).second)
          out.push_back({std::string(1, argument.letter), argumentName(argument),
                         argumentFact(set, *signature, argument), kField});
}

constexpr const char* kMacroWords[] = {"IF",    "THEN",  "GOTO",  "WHILE", "DO1",   "END1", "EQ",   "NE",
                                       "GT",    "GE",    "LT",    "LE",    "AND",   "OR",   "XOR",  "MOD",
                                       "ABS",   "SQRT",  "SIN",   "COS",   "TAN",   "ASIN", "ACOS", "ATAN",
                                       "ROUND", "FIX",   "FUP",   "LN",    "EXP",   "BIN",  "BCD",  "ADP",
                                       "DPRNT", "BPRNT", "POPEN", "PCLOS", "SETVN", "G65 P"};

} // namespace

std::vector<Proposal> completeMacroB(const Typing& typing) {
  std::vector<Proposal> out;
  const std::string block = upperCase(typing.before);
  const std::string_view stem = stemOf(block);
  const std::size_t program = typing.index.programAt(typing.offset);
  if (endsWith(stem, "GOTO")) {
    for (const std::uint64_t number : numbersAfter(typing.index, fmt::format("N {} ", program), true))
      out.push_back({fmt::format("{}", number), fmt::format("N{}", number), "", kValue});
    return out;
  }
  std::string name = project::settingsOf(typing.document.path, typing.session).control;
  if (name.empty()) name = project::kDefaultControl;
  const stdlib::Control* const control = typing.session.control(name);
  const bool macro = endsWith(stem, "G65P") || endsWith(stem, "G66P");
  if (macro || endsWith(stem, "M98P")) {
    programs(typing, macro, out);
    return out;
  }
  if (stem.ends_with('#')) {
    std::set<std::uint64_t> numbers = numbersAfter(typing.index, fmt::format("# {} ", program), false);
    numbers.merge(numbersAfter(typing.index, "# ", false));
    for (const std::uint64_t number : numbers)
      out.push_back({fmt::format("{}", number), fmt::format("#{}", number),
                     control != nullptr ? variableFact(*control, static_cast<std::uint32_t>(number)) : "",
                     kVariable});
    return out;
  }
  if (const std::uint32_t called = calledIn(stem); called != 0) {
    letters(typing, block, called, out);
    return out;
  }
  const std::string word(lastWord(stem));
  const bool code = !word.empty() && (word.back() == 'G' || word.back() == 'M') &&
                    (word.size() == 1 || isDigit(word[word.size() - 2]));
  if (control != nullptr && code) {
    for (const stdlib::CodeInfo& one : control->codes)
      if (one.letter == word.back())
        out.push_back({one.tenths % 10 == 0
                           ? fmt::format("{}{}", one.letter, one.tenths / 10)
                           : fmt::format("{}{}.{}", one.letter, one.tenths / 10, one.tenths % 10),
                       one.title, codeFact(*control, one.letter, one.tenths), kValue});
    return out;
  }
  for (const char* keyword : kMacroWords)
    out.push_back({keyword, "", "", kKeyword});
  return out;
}

std::vector<Proposal> completeMikroprog(const Typing& typing) {
  std::vector<Proposal> out;
  const std::string block = upperCase(typing.before);
  if (block.find(';') != std::string::npos) return out;
  const std::string_view stem = stemOf(block);
  if (stem.ends_with('L')) {
    for (const std::uint64_t number : numbersAfter(typing.index, "N ", true))
      out.push_back({fmt::format("L{}", number), fmt::format("N{}", number), "", kValue});
    return out;
  }
  if (stem.ends_with('P')) {
    for (const std::uint64_t number : numbersAfter(typing.index, "P ", false))
      out.push_back({fmt::format("P{}", number), "parameter", "", kVariable});
    return out;
  }
  const auto control =
      mikroprogControl(typing.index.sources, typing.index.file, typing.document.path, typing.session);
  if (!control) return out;
  const char last = stem.empty() ? ' ' : stem.back();
  if (last != 'G' && last != 'M') {
    // Letters of the codes that the block has.
    std::set<char> given;
    for (std::size_t i = 0; i + 1 < block.size(); ++i) {
      if (block[i] != 'G' && block[i] != 'M') continue;
      std::uint32_t number = 0;
      if (std::from_chars(block.data() + i + 1, block.data() + block.size(), number).ec != std::errc())
        continue;
      const stdlib::MikroprogFunction* const function = control->find(block[i], number);
      if (function == nullptr) continue;
      for (const stdlib::MikroprogAddress& address : function->addresses)
        if (isLetter(address.letter) && given.insert(address.letter).second)
          out.push_back(
              {std::string(1, address.letter),
               fmt::format("{}{}", function->code(), address.unit.empty() ? "" : ", " + address.unit),
               mikroprogFact(*function), kField});
    }
  }
  for (const stdlib::MikroprogFunction& function : control->functions)
    if (last == function.letter || (last != 'G' && last != 'M'))
      out.push_back({function.code(), function.title, mikroprogFact(function), kValue});
  return out;
}

} // namespace dotek::lsp
