// What the editor offers to change: repairs, suppressions, layout.
#include "driver/ProgramTools.h"
#include "lint/Rule.h"
#include "lsp/Server.h"

#include <algorithm>
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
std::string suppression(const Index& index, const std::string& code) {
  if (index.post) return " // dotek: ignore " + code;
  switch (*index.kind) {
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
                     {"newText", suppression(index, one.code)}};
  return {{"title", "Ignore " + one.code + " in this line"},
          {"kind", "quickfix"},
          {"diagnostics", {one.diagnostic}},
          {"edit", {{"changes", {{document.uri, {edit}}}}}}};
}

// Edits of whole lines that make the second text of the first. Both have the same lines.
Json linesChanged(const Index& index, const SourceFile& made, Units units) {
  Json out = Json::array();
  const SourceFile& file = index.text();
  for (std::uint32_t line = 1; line <= file.lineCount() && line <= made.lineCount(); ++line) {
    if (file.line(line) == made.line(line)) continue;
    const std::uint32_t begin = file.lineStart(line);
    const SourceRange range{index.file, begin, begin + static_cast<std::uint32_t>(file.line(line).size())};
    out.push_back({{"range", rangeOf(file, range, units)}, {"newText", index.utf8(made.line(line))}});
  }
  return out;
}

// New numbers for the blocks of a program of Macro B; null where it is not asked for or changes nothing. Not
// while somebody types: it reads the whole file.
Json renumbering(const Workspace& workspace, const Document& document, const Index& index,
                 const Json& params) {
  constexpr const char* kKind = "refactor.rewrite.dotek.renumber";
  const Json context = params.value("context", Json::object());
  const bool automatic = context.is_object() && context.value("triggerKind", 1) == 2;
  if (index.kind != std::optional(InputKind::Nc) || automatic || !wantsKind(params, kKind)) return nullptr;
  driver::RenumberCommandOptions options;
  options.inputs = {document.path};
  options.common = workspace.options(options.inputs);
  const driver::Outcome outcome = driver::renumber(options);
  Json action = {{"title", "Renumber the blocks: N10, N20, .."}, {"kind", kKind}};
  if (outcome.files.empty()) {
    if (!workspace.showsDisabled || outcome.diagnostics.all().empty()) return nullptr;
    action["disabled"] = {{"reason", outcome.diagnostics.all().front().message}};
    return action;
  }
  if (outcome.inputs.empty()) return nullptr; // they are numbered so
  const SourceFile made("", outcome.files.front().text, index.encoding);
  const Json edits = linesChanged(index, made, workspace.units);
  if (edits.empty() || made.lineCount() != index.text().lineCount()) return nullptr;
  action["edit"] = {{"changes", {{document.uri, edits}}}};
  return action;
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
  // What is offered for two findings of a line alike is offered once, for both.
  const auto offer = [&](Json action) {
    const auto same = std::find_if(out.begin(), out.end(), [&](const Json& other) {
      return other["title"] == action["title"] && other.value("edit", Json()) == action.value("edit", Json());
    });
    if (same == out.end())
      out.push_back(std::move(action));
    else
      (*same)["diagnostics"].push_back(action["diagnostics"][0]);
  };
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
      offer(suppressionOf(workspace, document, index, one));
    offer({{"title", "Explain " + one.code},
           {"kind", "quickfix"},
           {"diagnostics", Json::array({one.diagnostic})},
           {"command", {{"title", "Explain"}, {"command", "dotek.explain"}, {"arguments", {one.code}}}}});
  }
  if (Json action = renumbering(workspace, document, index, params); !action.is_null())
    out.push_back(std::move(action));
  if (!safe.empty() && wantsKind(params, "source.fixAll.dotek"))
    out.push_back({{"title", "Make all safe repairs"},
                   {"kind", "source.fixAll.dotek"},
                   {"edit", editOf(workspace, safe)}});
  return out;
}

Json formatting(Workspace& workspace, const Json& params) {
  const Document& document = documentOf(workspace, params);
  const std::optional<project::InputKind> kind = workspace.index(document).kind;
  // An editor that formats whenever it saves asks for all languages.
  if (kind != project::InputKind::Cycle && kind != project::InputKind::Nc) return Json::array();
  const driver::Outcome outcome = driver::layOut({{document.path}, workspace.options({document.path})});
  if (outcome.status != 0 || outcome.files.empty())
    throw Refusal{kRequestFailed, outcome.diagnostics.empty() ? "nothing was laid out"
                                                              : outcome.diagnostics.all().front().message};
  if (outcome.inputs.empty()) return Json::array(); // it is laid out
  const Index& index = workspace.index(document);
  if (index.file == kNoFile) throw Refusal{kRequestFailed, "no text of a language that is laid out"};
  const SourceRange all{index.file, 0, static_cast<std::uint32_t>(index.text().bytes().size())};
  std::string text = outcome.files.front().text;
  // An editor keeps the byte order mark of the file beside its text.
  if (text.starts_with(driver::kByteOrderMark)) text.erase(0, driver::kByteOrderMark.size());
  return Json::array({{{"range", rangeOf(index.text(), all, workspace.units)}, {"newText", text}}});
}

} // namespace dotek::lsp
