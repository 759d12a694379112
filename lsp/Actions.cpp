// What the editor offers to do: repairs, suppressions, layout, and the commands of Dotek on what is open.
#include "driver/Preview.h"
#include "lint/Rule.h"
#include "lsp/Server.h"
#include "project/Settings.h"
#include "support/Ascii.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>

namespace dotek::lsp {

namespace fs = std::filesystem;
using project::InputKind;

namespace {

Json editOf(const Workspace& workspace, const std::map<std::string, Json>& edits) {
  Json changes = Json::object();
  for (const auto& [path, list] : edits) {
    std::string uri = uriOf(path);
    for (const auto& [open, document] : workspace.documents())
      if (document.path == path) uri = open;
    changes[uri] = list;
  }
  return {{"changes", changes}};
}

// The comment that suppresses a code in a text of this kind.
std::string suppression(InputKind kind, const std::string& code) {
  switch (kind) {
  case InputKind::Prog: return " { dotek: ignore " + code + " }";
  case InputKind::Nc: {
    std::string capitals = code;
    std::transform(capitals.begin(), capitals.end(), capitals.begin(),
                   [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
    return " (DOTEK: IGNORE " + capitals + ")";
  }
  case InputKind::Suf: return " ;dotek: ignore " + code;
  case InputKind::Cycle: return " // dotek: ignore " + code;
  case InputKind::Macro:
  case InputKind::Dialog:
  case InputKind::DefineData: return " ! dotek: ignore " + code;
  }
  return "";
}

bool wantsKind(const Json& params, std::string_view kind) {
  const auto context = params.find("context");
  if (context == params.end() || !context->is_object() || !context->contains("only")) return true;
  for (const Json& only : (*context)["only"])
    if (only.is_string() &&
        (kind == only.get<std::string>() || kind.starts_with(only.get<std::string>() + ".")))
      return true;
  return false;
}

Json suppressionOf(const Workspace& workspace, const Document& document, const Index& index,
                   const Found& one) {
  const SourceFile& file = index.text();
  const std::uint32_t line = std::min(one.line + 1, file.lineCount());
  const auto end = file.lineStart(line) + static_cast<std::uint32_t>(file.line(line).size());
  const Json place = positionOf(file, end, workspace.units);
  const Json edit = {{"range", {{"start", place}, {"end", place}}},
                     {"newText", suppression(*index.kind, one.code)}};
  return {{"title", "Ignore " + one.code + " in this line"},
          {"kind", "quickfix"},
          {"diagnostics", {one.diagnostic}},
          {"edit", {{"changes", {{document.uri, {edit}}}}}}};
}

} // namespace

Json codeActions(Workspace& workspace, const Json& params) {
  const Document& document = documentOf(workspace, params);
  const Index& index = workspace.index(document);
  Json out = Json::array();
  if (index.file == kNoFile) return out;
  std::uint32_t first = 0, last = UINT32_MAX;
  if (const auto range = params.find("range"); range != params.end() && range->is_object()) {
    first = range->value("/start/line"_json_pointer, 0u);
    last = range->value("/end/line"_json_pointer, UINT32_MAX);
  }
  std::map<std::string, Json> safe; // all that --fix would make
  for (const Found& one : workspace.found(document.path)) {
    const std::uint32_t end = one.diagnostic["range"]["end"]["line"];
    if (one.safe)
      for (const auto& [path, edits] : one.edits)
        for (const Json& edit : edits)
          safe[path].push_back(edit);
    if (one.line > last || end < first || !wantsKind(params, "quickfix")) continue;
    if (!one.edits.empty())
      out.push_back(
          {{"title", one.safe ? one.title : one.title + " (changes what the program does: check it)"},
           {"kind", "quickfix"},
           {"isPreferred", one.safe},
           {"diagnostics", {one.diagnostic}},
           {"edit", editOf(workspace, one.edits)}});
    if (lint::findRule(one.code) != nullptr) // what keeps a text from being read is repaired, not ignored
      out.push_back(suppressionOf(workspace, document, index, one));
    out.push_back(
        {{"title", "Explain " + one.code},
         {"kind", "quickfix"},
         {"diagnostics", {one.diagnostic}},
         {"command", {{"title", "Explain"}, {"command", "dotek.explain"}, {"arguments", {one.code}}}}});
  }
  if (!safe.empty() && wantsKind(params, "source.fixAll.dotek"))
    out.push_back({{"title", "Make all safe repairs"},
                   {"kind", "source.fixAll.dotek"},
                   {"edit", editOf(workspace, safe)}});
  return out;
}

Json formatting(Workspace& workspace, const Json& params) {
  const Document& document = documentOf(workspace, params);
  const driver::Outcome outcome = driver::layOut({{document.path}, workspace.options({document.path})});
  if (outcome.status != 0 || outcome.files.empty())
    throw Refusal{kRequestFailed, outcome.diagnostics.empty() ? "nothing was laid out"
                                                              : outcome.diagnostics.all().front().message};
  if (outcome.inputs.empty()) return Json::array(); // it is laid out
  const Index& index = workspace.index(document);
  const SourceRange all{index.file, 0, static_cast<std::uint32_t>(index.text().bytes().size())};
  return Json::array(
      {{{"range", rangeOf(index.text(), all, workspace.units)}, {"newText", outcome.files.front().text}}});
}

namespace {

struct Shown { // a result that the editor opens beside the text
  std::string title, language, text;
};

Json shown(const driver::Outcome& outcome, Shown result) {
  const std::string findings = renderText(outcome.diagnostics, outcome.sources, 50);
  if (outcome.status != 0 && result.text.empty()) result = {result.title, "plaintext", findings};
  return {{"title", result.title},
          {"language", result.language},
          {"text", result.text},
          {"messages", findings},
          {"status", outcome.status}};
}

// Arguments of a command: a document, then the name of a target.
struct Asked {
  const Document* document = nullptr;
  std::string input; // the document, or the folder of its cycle
  std::string target;
  driver::CommonOptions common;
  driver::SourceOptions source;
};

Asked askedOf(const Workspace& workspace, const Json& arguments) {
  Asked out;
  if (arguments.empty() || !arguments[0].is_string())
    throw Refusal{kInvalidParams, "the command takes the URI of a document"};
  out.document = workspace.find(arguments[0].get<std::string>());
  if (out.document == nullptr) throw Refusal{kRequestFailed, "the document is not open"};
  out.input = Workspace::unitOf(out.document->path);
  if (arguments.size() > 1 && arguments[1].is_string()) out.target = arguments[1].get<std::string>();
  out.common = workspace.options({out.input});
  if (out.input != out.document->path) out.source.prog = project::flagDefaultsOf({out.input}).prog;
  return out;
}

Json post(Workspace& workspace, const Json& arguments) {
  Asked asked = askedOf(workspace, arguments);
  const driver::Outcome outcome = driver::post({{asked.input}, asked.common, asked.source, std::nullopt});
  return shown(outcome, {"posted blocks", "dotek-macrob", outcome.output});
}

// By the name of a result, as editors/vscode/package.json has them.
std::string languageOf(const std::string& name) {
  const std::string ending = lowerCase(fs::path(name).extension().string());
  if (ending == ".js") return "javascript";
  if (ending == ".suf") return "dotek-mikroprog";
  return ending == ".cycle" ? "dotek-cycle" : "dotek-macrob";
}

Json convert(Workspace& workspace, const Json& arguments) {
  Asked asked = askedOf(workspace, arguments);
  driver::ConvertOptions options;
  options.inputs = {asked.input};
  options.common = asked.common;
  options.source = asked.source;
  options.to = asked.target.empty() ? "fanuc" : asked.target;
  const driver::Outcome outcome = driver::convert(options);
  const std::string name = outcome.files.empty() ? "" : outcome.files.front().name;
  return shown(outcome, {options.to + " program", languageOf(name), outcome.output});
}

Json run(Workspace& workspace, const Json& arguments) {
  Asked asked = askedOf(workspace, arguments);
  driver::SimOptions options;
  options.program = asked.document->path;
  options.common = asked.common;
  options.html = true;
  const driver::Outcome outcome = driver::sim(options);
  std::string page;
  for (const driver::OutputFile& file : outcome.files)
    if (file.name == "html") page = file.text;
  return shown(outcome, {"run", "html", page});
}

Json verify(Workspace& workspace, const Json& arguments) {
  Asked asked = askedOf(workspace, arguments);
  driver::VerifyOptions options;
  options.inputs = {asked.input};
  options.common = asked.common;
  options.source = asked.source;
  options.to = asked.target.empty() ? "fanuc" : asked.target;
  options.cases = 100; // an editor waits
  options.format = targets::ReportFormat::Html;
  const driver::Outcome outcome = driver::verify(options);
  const bool page = !outcome.files.empty();
  return shown(outcome,
               {"verify", page ? "html" : "plaintext", page ? outcome.files.front().text : outcome.output});
}

Json preview(Workspace& workspace, const Json& arguments) {
  Asked asked = askedOf(workspace, arguments);
  const driver::Outcome outcome = driver::preview({{asked.input}, asked.common});
  return shown(outcome, {"dialog", "html", outcome.output});
}

Json explain(Workspace&, const Json& arguments) {
  if (arguments.empty() || !arguments[0].is_string())
    throw Refusal{kInvalidParams, "the command takes a code"};
  const driver::Outcome outcome = driver::explain(arguments[0].get<std::string>());
  return shown(outcome, {arguments[0].get<std::string>(), "markdown", outcome.output});
}

struct NamedCommand {
  const char* name;
  Json (*call)(Workspace& workspace, const Json& arguments);
};
constexpr std::array kCommands = {
    NamedCommand{"dotek.post", post},       NamedCommand{"dotek.convert", convert},
    NamedCommand{"dotek.run", run},         NamedCommand{"dotek.verify", verify},
    NamedCommand{"dotek.preview", preview}, NamedCommand{"dotek.explain", explain},
};

} // namespace

Json commandNames() {
  Json out = Json::array();
  for (const NamedCommand& one : kCommands)
    out.push_back(one.name);
  return out;
}

Json execute(Workspace& workspace, const Json& params) {
  const std::string name = params.value("command", "");
  const Json arguments = params.value("arguments", Json::array());
  for (const NamedCommand& one : kCommands)
    if (name == one.name) return one.call(workspace, arguments.is_array() ? arguments : Json::array());
  throw Refusal{kInvalidParams, "no command `" + name + "`"};
}

Json codeLenses(Workspace& workspace, const Json& params) {
  const Document& document = documentOf(workspace, params);
  const Index& index = workspace.index(document);
  Json out = Json::array();
  if (!index.kind || index.file == kNoFile) return out;
  const Json start = {{"line", 0}, {"character", 0}};
  const auto add = [&](const char* title, const char* command) {
    out.push_back({{"range", {{"start", start}, {"end", start}}},
                   {"command", {{"title", title}, {"command", command}, {"arguments", {document.uri}}}}});
  };
  const bool folder = Workspace::unitOf(document.path) != document.path;
  const bool cycle = *index.kind == InputKind::Cycle;
  if (folder && project::flagDefaultsOf({Workspace::unitOf(document.path)}).prog) add("post", "dotek.post");
  if (folder || cycle || *index.kind == InputKind::Nc) add("convert", "dotek.convert");
  if (!folder && (cycle || *index.kind == InputKind::Nc || *index.kind == InputKind::Suf))
    add("run", "dotek.run");
  if (folder || cycle) add("verify", "dotek.verify");
  if (folder) add("preview", "dotek.preview");
  return out;
}

} // namespace dotek::lsp
