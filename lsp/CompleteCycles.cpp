// Words that may come next in cycles: of the cycle language, of GibbsCAM, of the posts that print them.
#include "frontend/cycle/Parse.h"
#include "frontend/cycle/Words.h"
#include "lsp/Complete.h"
#include "project/CycleFiles.h"
#include "stdlib/FusionNames.h"
#include "stdlib/KeywordLists.h"
#include "support/Ascii.h"

#include <algorithm>
#include <filesystem>
#include <set>

namespace dotek::lsp {

namespace fs = std::filesystem;
namespace cycle = frontend::cycle;

namespace {

// The cycle that a call of this name means: beside the caller, else in the library.
const cycle::File* calledCycle(project::CycleFiles& files, const std::string& caller, std::string name) {
  const std::string called = name;
  std::replace(name.begin(), name.end(), '_', '-');
  const std::string path = (fs::path(caller).parent_path() / (name + ".cycle")).generic_string();
  std::error_code error;
  return fs::is_regular_file(path, error) ? files.load(path) : files.library(called);
}

std::string typeText(const cycle::Type& type) {
  std::string out(cycle::typeText(type.name));
  for (std::size_t i = 0; i < type.choices.size(); ++i)
    out += (i == 0 ? " " : ", ") + type.choices[i].text;
  return out;
}

void parameters(const cycle::File& file, std::string_view line, std::vector<Proposal>& out) {
  std::set<std::string> given; // with `=` after them
  for (std::size_t at = line.find('='); at != std::string_view::npos; at = line.find('=', at + 1)) {
    std::string_view before = line.substr(0, at);
    while (before.ends_with(' '))
      before.remove_suffix(1);
    given.insert(std::string(lastWord(before)));
  }
  for (const cycle::Statement& one : file.body.statements)
    if (const auto* parameter = std::get_if<cycle::Parameter>(&one.node))
      for (const cycle::Name& name : parameter->names)
        if (!given.contains(name.text))
          out.push_back({name.text,
                         typeText(parameter->type) + (parameter->optional           ? ", optional"
                                                      : parameter->value == nullptr ? ", needed"
                                                                                    : ""),
                         parameter->title ? parameter->title->text : "", kField});
}

void results(const cycle::File& file, std::vector<Proposal>& out) {
  for (const cycle::Statement& one : file.body.statements)
    if (const auto* result = std::get_if<cycle::Result>(&one.node))
      for (const cycle::Name& name : result->names)
        out.push_back({name.text, typeText(result->type), result->title ? result->title->text : "", kField});
}

// What may follow `first.`.
std::vector<Proposal> members(const Typing& typing, const std::string& object) {
  std::vector<Proposal> out;
  if (object == "start" || object == "here") {
    for (const char* axis : {"x", "y", "z"})
      out.push_back({axis, "coordinate", "", kField});
    return out;
  }
  for (const Symbol& symbol : typing.index.symbols) {
    if (symbol.name != object) continue;
    if (symbol.detail == "touch") {
      out.push_back({"at", "where the surface is", "", kField});
      out.push_back({"error", "measured less expected", "", kField});
    } else if (symbol.detail == "touch along a direction") {
      for (const char* name : {"at_x", "at_y", "at_z"})
        out.push_back({name, "where the surface is", "", kField});
      out.push_back({"error", "measured less expected", "", kField});
    } else if (!symbol.detail.empty()) {
      project::CycleFiles files(typing.session);
      if (const cycle::File* file = calledCycle(files, typing.document.path, symbol.detail))
        results(*file, out);
    }
    break;
  }
  return out;
}

// Definitions of a folder's DefineData.txt.
void fieldsOf(Workspace& workspace, const std::string& folder, std::vector<Proposal>& out) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (lowerCase(entry.path().filename().string()) != "definedata.txt") continue;
    for (const Symbol& symbol : workspace.indexOf(entry.path().generic_string()).symbols)
      out.push_back(
          {symbol.name, symbol.detail, "of `" + fs::path(folder).filename().string() + "`", kField});
  }
}

void addNew(std::vector<Proposal>& out, std::vector<Proposal> more) {
  std::set<std::string> known;
  for (const Proposal& one : out)
    known.insert(upperCase(one.label));
  for (Proposal& one : more)
    if (known.insert(upperCase(one.label)).second) out.push_back(std::move(one));
}

// The cycle that is posted at the cursor: the last that the text names before it.
std::string cycleBefore(const Typing& typing) {
  std::string out;
  for (const Occurrence& one : typing.index.occurrences)
    if (one.range.begin < typing.offset && one.key.starts_with("cycle ")) out = one.key.substr(6);
  return out;
}

// Words at the place of the argument that is being written, where its command knows them; empty: any value.
std::vector<Proposal> argumentWords(const Typing& typing) {
  std::vector<Proposal> out;
  std::string line = upperCase(typing.before);
  if (const std::size_t then = line.rfind(" THEN "); then != std::string::npos) line.erase(0, then + 6);
  std::size_t begin = 0, end = 0;
  while (begin < line.size() && (line[begin] == ' ' || line[begin] == '\t'))
    ++begin;
  for (end = begin; end < line.size() && (isLetter(line[end]) || line[end] == '_'); ++end) {
  }
  if (end == line.size()) return out;
  std::size_t index = 0;
  int depth = 0;
  bool quoted = false;
  for (const char c : line.substr(end)) {
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (c == ',' && depth == 0) ++index;
  }
  if (quoted) return out;
  const stdlib::GibbsKeywords& keywords = typing.session.gibbsKeywords();
  std::set<std::string> known;
  for (const stdlib::CommandSignature* one : keywords.commands(line.substr(begin, end - begin))) {
    if (index >= one->arguments.size()) continue;
    const stdlib::ArgumentSpec& argument = one->arguments[index];
    for (const std::string& word : argument.keywords)
      if (known.insert(word).second) out.push_back({word, "", "", kValue});
    if (argument.kind != stdlib::ArgumentSpec::Kind::Parameter) continue;
    for (const stdlib::ListedWord& word : stdlib::parametersOf(keywords, argument.family))
      if (known.insert(word.name).second) out.push_back({word.name, word.detail, "", kValue});
  }
  return out;
}

} // namespace

std::vector<Proposal> completeCycle(const Typing& typing) {
  const std::string& before = typing.before;
  const std::string_view line =
      std::string_view(before).substr(std::min(before.find_first_not_of(' '), before.size()));
  std::vector<Proposal> out;
  const std::string_view word = lastWord(line);
  const std::string_view ahead = line.substr(0, line.size() - word.size());
  if (ahead.ends_with('.') && !lastWord(ahead.substr(0, ahead.size() - 1)).empty())
    return members(typing, std::string(lastWord(ahead.substr(0, ahead.size() - 1))));
  if (line.starts_with("call ")) {
    const std::size_t end = line.find(' ', 5);
    if (end == std::string_view::npos) {
      for (const std::string& path : typing.workspace.beside(typing.document, project::InputKind::Cycle))
        for (const Symbol& symbol : typing.workspace.indexOf(path).symbols)
          if (symbol.kind == SymbolKind::Function)
            out.push_back(
                {symbol.name, symbol.detail.empty() ? "cycle of this folder" : symbol.detail, "", kFunction});
      std::vector<Proposal> library;
      for (const stdlib::DataFile* file : typing.session.data().list("cycles")) {
        std::string name = file->name;
        std::replace(name.begin(), name.end(), '-', '_');
        library.push_back({name, "cycle of the library", "", kFunction});
      }
      addNew(out, std::move(library));
      return out;
    }
    if (line.find("->") != std::string_view::npos) return out;
    const std::size_t comma = line.rfind(',');
    const std::size_t argument = comma != std::string_view::npos && comma > end ? comma : end;
    if (line.find('=', argument) == std::string_view::npos) {
      project::CycleFiles files(typing.session);
      if (const cycle::File* file =
              calledCycle(files, typing.document.path, std::string(line.substr(5, end - 5)))) {
        parameters(*file, line, out);
        return out;
      }
    }
  }
  out = named(typing.index, "name ", kVariable);
  std::vector<Proposal> words;
  for (const std::string_view one : cycle::statementWords())
    words.push_back({std::string(one), "", std::string(cycle::usageOf(one)), kKeyword});
  for (const std::string_view one : cycle::typeWords())
    words.push_back({std::string(one), "type", "", kKeyword});
  for (const char* one :
       {"optional", "range", "group", "then", "times", "at most", "becomes", "given", "overtravel", "start",
        "here", "is", "not", "and", "or", "ball_radius", "clearance"})
    words.push_back({one, "", "", kKeyword});
  addNew(out, std::move(words));
  return out;
}

std::vector<Proposal> completeComPost(const Typing& typing) {
  const std::string& before = typing.before;
  std::vector<Proposal> out;
  const std::size_t quote = before.rfind('\'');
  if (quote != std::string::npos && quote > 0 && before[quote - 1] == '(') {
    const std::string_view word = std::string_view(before).substr(0, quote - 1);
    const std::vector<std::string> folders = Workspace::cycleFolders(typing.document.path);
    if (word.ends_with("CycleType?")) {
      for (const std::string& folder : folders)
        out.push_back({fs::path(folder).filename().string(), "cycle", "", kValue});
      addNew(out, named(typing.index, "cycle ", kValue));
      return out;
    }
    if (!word.ends_with("OpFieldData#")) return named(typing.index, "flag ", kValue);
    const std::string posted = cycleBefore(typing);
    for (const std::string& folder : folders)
      if (fs::path(folder).filename() == posted) fieldsOf(typing.workspace, folder, out);
    if (out.empty())
      for (const std::string& folder : folders) {
        std::vector<Proposal> more;
        fieldsOf(typing.workspace, folder, more);
        addNew(out, std::move(more));
      }
    addNew(out, named(typing.index, "field ", kField));
    return out;
  }
  if (std::count(before.begin(), before.end(), '\'') % 2 != 0) return out; // a text that is printed
  out = named(typing.index, "routine ", kFunction);
  for (const stdlib::ListedWord& one : stdlib::listOf(typing.session.compostKeywords()))
    out.push_back({one.argument ? one.name + "('" : one.name, one.detail, "", kKeyword});
  return out;
}

std::vector<Proposal> completePost(const Typing& typing) {
  std::vector<Proposal> out;
  const std::string& before = typing.before;
  const std::string_view ahead = std::string_view(before).substr(0, before.size() - lastWord(before).size());
  const bool quoted = ahead.ends_with("Property(\"") || ahead.ends_with("Property('");
  if (quoted || ahead.ends_with("properties.")) {
    for (const Symbol& symbol : typing.index.symbols)
      if (symbol.name == "properties")
        for (const Symbol& one : symbol.children)
          out.push_back({one.name, one.detail, "", kField});
    return out;
  }
  if (ahead.ends_with('.') || ahead.ends_with('"')) return out;
  for (const Symbol& symbol : typing.index.symbols)
    out.push_back(
        {symbol.name, symbol.detail, "", symbol.kind == SymbolKind::Function ? kFunction : kVariable});
  addNew(out, named(typing.index, "js ", kVariable));
  const stdlib::FusionNames names = stdlib::FusionNames::load(typing.session.data());
  const auto add = [&](const auto& list, const char* detail, int icon) {
    std::vector<Proposal> more;
    for (const std::string& name : list)
      more.push_back({name, detail, "", icon});
    addNew(out, std::move(more));
  };
  add(names.functions, "function of the engine", kFunction);
  add(names.entries, "called by the engine", kFunction);
  add(names.variables, "known to the engine", kVariable);
  add(names.classes, "class of the engine", kVariable);
  for (const stdlib::FusionNames::Family& family : names.families)
    add(family.names, "constant of the engine", kValue);
  return out;
}

std::vector<Proposal> completeGibbs(const Typing& typing) {
  std::vector<Proposal> out = argumentWords(typing);
  if (!out.empty()) return out;
  std::vector<Proposal> fields;
  fieldsOf(typing.workspace, fs::path(typing.document.path).parent_path().generic_string(), fields);
  addNew(out, std::move(fields));
  addNew(out, named(typing.index, "field ", kVariable));
  for (const std::string& path : typing.workspace.companions(typing.document))
    addNew(out, named(typing.workspace.indexOf(path), "field ", kVariable));
  if (*typing.index.kind == project::InputKind::DefineData) return out;
  const bool dialog = *typing.index.kind == project::InputKind::Dialog;
  if (!dialog)
    for (Proposal& one : named(typing.index, "label ", kValue))
      out.push_back(std::move(one));
  using Kind = stdlib::ListedWord::Kind;
  for (const stdlib::ListedWord& one : stdlib::listOf(typing.session.gibbsKeywords()))
    if ((one.kind == Kind::Control) == dialog || one.kind == Kind::Variable)
      out.push_back({one.kind == Kind::Variable ? one.name : lowerCase(one.name), one.detail, "",
                     one.kind == Kind::Function   ? kFunction
                     : one.kind == Kind::Variable ? kVariable
                                                  : kKeyword});
  return out;
}

} // namespace dotek::lsp
