// Words that may come next.
#include "lsp/Controls.h"
#include "lsp/Server.h"
#include "project/CycleFolder.h"
#include "project/Lowering.h"
#include "project/Session.h"
#include "project/Settings.h"
#include "stdlib/DataFiles.h"
#include "support/Ascii.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fmt/format.h>
#include <set>

namespace dotek::lsp {

namespace fs = std::filesystem;

namespace {

constexpr int kField = 5, kVariable = 6, kFunction = 3, kValue = 12, kKeyword = 14;

bool isWordCharacter(char c) {
  return isLetter(c) || isDigit(c) || c == '_';
}

// The word that ends at the cursor.
std::string_view lastWord(std::string_view before) {
  std::size_t begin = before.size();
  while (begin > 0 && isWordCharacter(before[begin - 1]))
    --begin;
  return before.substr(begin);
}

// Names of the index with this beginning of their keys, each once.
std::vector<Proposal> named(const Index& index, const std::string& kind, int icon) {
  std::vector<Proposal> out;
  std::set<std::string> seen;
  for (const Occurrence& one : index.occurrences) {
    if (!one.key.starts_with(kind)) continue;
    const std::string text = index.sources.textUtf8(one.range);
    if (seen.insert(text).second) out.push_back({text, "", "", icon});
  }
  return out;
}

void keywords(std::vector<Proposal>& out, std::initializer_list<const char*> words) {
  for (const char* word : words)
    out.push_back({word, "", "", kKeyword});
}

// The program that the block before the cursor calls; 0: none.
std::uint32_t calledIn(const std::string& block) {
  const std::size_t call = block.find("G65");
  const std::size_t at = call == std::string::npos ? call : block.find('P', call);
  if (at == std::string::npos) return 0;
  std::uint32_t out = 0;
  for (std::size_t i = at + 1; i < block.size() && isDigit(block[i]) && out < 100000000; ++i)
    out = out * 10 + static_cast<std::uint32_t>(block[i] - '0');
  return out;
}

// Numbers that the keys with this beginning end with, in ascending order.
std::set<std::uint64_t> numbersAfter(const Index& index, const std::string& kind, bool defined) {
  std::set<std::uint64_t> out;
  for (const Occurrence& one : index.occurrences) {
    if (!one.key.starts_with(kind) || (defined && one.role != Occurrence::Role::Definition)) continue;
    std::uint64_t number = 0;
    const char* const end = one.key.data() + one.key.size();
    if (std::from_chars(one.key.data() + kind.size(), end, number).ptr == end) out.insert(number);
  }
  return out;
}

// The block without the digits that are being typed.
std::string_view stemOf(std::string_view block) {
  while (!block.empty() && isDigit(block.back()))
    block.remove_suffix(1);
  return block;
}

bool endsWith(std::string_view block, std::string_view word) { // blanks between and after do not count
  std::string plain;
  for (const char c : block)
    if (c != ' ' && c != '\t') plain += c;
  return plain.ends_with(word);
}

std::vector<Proposal> macroB(const Index& index, const std::string& path, std::uint32_t offset,
                             std::string_view before, project::Session& session) {
  std::vector<Proposal> out;
  const std::string block = upperCase(before);
  const std::string_view stem = stemOf(block);
  const std::size_t program = index.programAt(offset);
  if (endsWith(stem, "GOTO")) {
    for (const std::uint64_t number : numbersAfter(index, fmt::format("N {} ", program), true))
      out.push_back({fmt::format("{}", number), fmt::format("N{}", number), "", kValue});
    return out;
  }
  std::string name = project::settingsOf(path, session).control;
  if (name.empty()) name = project::kDefaultControl;
  const stdlib::Control* const control = session.control(name);
  const std::string word(lastWord(stem));
  const std::uint32_t called = calledIn(std::string(stem));
  if (control != nullptr && called == 0 && (word == "G" || word == "M")) {
    for (const stdlib::CodeInfo& code : control->codes)
      if (code.letter == word.front())
        out.push_back({code.tenths % 10 == 0
                           ? fmt::format("{}{}", code.letter, code.tenths / 10)
                           : fmt::format("{}{}.{}", code.letter, code.tenths / 10, code.tenths % 10),
                       code.title, codeFact(*control, code.letter, code.tenths), kValue});
    return out;
  }
  if (endsWith(stem, "G65P")) {
    std::set<std::uint32_t> seen;
    for (const stdlib::MacroSet& set : session.macroSets())
      for (const stdlib::MacroSignature& signature : set.signatures)
        if (seen.insert(signature.program).second)
          out.push_back({fmt::format("P{}", signature.program), signature.title,
                         programFact(set, signature.program), kFunction});
    return out;
  }
  if (called != 0 && !stem.ends_with('#')) {
    std::set<char> given;
    const std::size_t after = block.find('P', block.find("G65"));
    const bool typing = isLetter(block.back()); // the letter may still become another
    for (std::size_t i = after + 1; i + (typing ? 1 : 0) < block.size(); ++i)
      if (isLetter(block[i])) given.insert(block[i]);
    for (const stdlib::MacroSet& set : session.macroSets())
      for (const stdlib::MacroSignature* signature : set.of(called))
        for (const stdlib::MacroArgument& argument : signature->arguments)
          if (given.insert(argument.letter).second)
            out.push_back({std::string(1, argument.letter), argumentName(argument),
                           argumentFact(set, *signature, argument), kField});
    return out;
  }
  if (stem.ends_with('#')) {
    std::set<std::uint64_t> numbers = numbersAfter(index, fmt::format("# {} ", program), false);
    numbers.merge(numbersAfter(index, "# ", false));
    for (const std::uint64_t number : numbers)
      out.push_back({fmt::format("{}", number), fmt::format("#{}", number),
                     control != nullptr ? variableFact(*control, static_cast<std::uint32_t>(number)) : "",
                     kVariable});
    return out;
  }
  keywords(out, {"IF",    "THEN", "GOTO", "WHILE", "DO1",   "END1",  "EQ",    "NE",   "GT",  "GE",
                 "LT",    "LE",   "AND",  "OR",    "ABS",   "SQRT",  "SIN",   "COS",  "TAN", "ATAN",
                 "ROUND", "FIX",  "FUP",  "MOD",   "DPRNT", "POPEN", "PCLOS", "G65 P"});
  return out;
}

// Names of the cycle folders beside the file and one folder up.
std::vector<Proposal> foldersNear(const std::string& path) {
  std::vector<Proposal> out;
  const fs::path folder = fs::path(path).parent_path();
  for (const fs::path& where : {folder, folder.parent_path()}) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(where, error))
      if (out.size() < 200 && entry.is_directory(error) && project::isCycleFolder(entry.path()))
        out.push_back({entry.path().filename().string(), "cycle", "", kValue});
  }
  return out;
}

std::vector<Proposal> post(const Index& index, const std::string& path, std::string_view before) {
  if (before.find("CycleType?('") != std::string_view::npos && before.rfind('\'') == before.rfind("('") + 1)
    return foldersNear(path);
  if (before.rfind('\'') != std::string_view::npos && before.rfind('\'') == before.rfind("('") + 1)
    return named(index, "field ", kField);
  std::vector<Proposal> out = named(index, "routine ", kFunction);
  keywords(out, {"IF", "ELSE", "END", "AND", "NOT", "RETURN", "EOL", "SeqC", "SeqNo", "OpFieldData#('",
                 "CycleType?('", "Flag?('"});
  return out;
}

std::vector<Proposal> gibbs(const Index& index) {
  std::vector<Proposal> out = named(index, "field ", kVariable);
  for (Proposal& one : named(index, "label ", kValue))
    out.push_back(std::move(one));
  keywords(out, {"if", "then", "goto", "for", "next", "call", "message", "dialog", "local", "global"});
  return out;
}

std::vector<Proposal> cycle(const Index& index, std::string_view before, project::Session& session) {
  const std::string_view line = before.substr(std::min(before.find_first_not_of(' '), before.size()));
  std::vector<Proposal> out;
  if (line.starts_with("call ") && line.find(' ', 5) == std::string_view::npos) {
    for (const stdlib::DataFile* file : session.data().list("cycles"))
      out.push_back({file->name, "cycle of the library", "", kFunction});
    return out;
  }
  out = named(index, "name ", kVariable);
  keywords(
      out,
      {"parameter",   "result",     "require",     "needs probe",    "probe on", "probe off",  "spindle off",
       "coolant off", "rapid move", "feed move",   "protected move", "touch",    "overtravel", "set",
       "becomes",     "alarm",      "stop",        "report",         "if",       "then",       "else",
       "end",         "for",        "while",       "at most",        "repeat",   "times",      "call",
       "use",         "given",      "length",      "angle",          "feed",     "count",      "ratio",
       "flag",        "choice",     "work_offset", "tool_offset",    "optional", "range",      "group",
       "set tool",    "radius",     "length_wear", "radius_wear"});
  return out;
}

} // namespace

std::vector<Proposal> proposals(const Index& index, const std::string& path, std::uint32_t offset,
                                const project::CommonOptions& options) {
  if (!index.kind || index.file == kNoFile) return {};
  const SourceFile& file = index.text();
  const std::uint32_t start = file.lineStart(file.lineOf(offset));
  const std::string before =
      toUtf8(std::string_view(file.bytes()).substr(start, offset - start), file.encoding());
  project::Session session(options);
  switch (*index.kind) {
  case project::InputKind::Nc: return macroB(index, path, offset, before, session);
  case project::InputKind::Prog: return post(index, path, before);
  case project::InputKind::Macro:
  case project::InputKind::Dialog:
  case project::InputKind::DefineData: return gibbs(index);
  case project::InputKind::Cycle: return cycle(index, before, session);
  case project::InputKind::Suf: return named(index, "P ", kVariable);
  }
  return {};
}

Json completion(Workspace& workspace, const Json& params) {
  const Document& document = documentOf(workspace, params);
  const Index& index = workspace.index(document);
  Json items = Json::array();
  if (index.file != kNoFile)
    for (const Proposal& one : proposals(index, document.path, placeOf(workspace, index, params),
                                         workspace.options({document.path}))) {
      Json item = {{"label", one.label}, {"kind", one.kind}};
      if (!one.detail.empty()) item["detail"] = one.detail;
      if (!one.documentation.empty())
        item["documentation"] = {{"kind", "markdown"}, {"value", one.documentation}};
      items.push_back(std::move(item));
    }
  return {{"isIncomplete", false}, {"items", items}};
}

} // namespace dotek::lsp
