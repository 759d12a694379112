// Commands of Dotek on what is open: their results, which an editor shows beside the text, and the lenses
// that start them.
#include "driver/Preview.h"
#include "driver/RunPost.h"
#include "lsp/Server.h"
#include "project/Settings.h"
#include "support/Ascii.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <set>

namespace dotek::lsp {

namespace fs = std::filesystem;
using project::InputKind;

namespace {

constexpr std::size_t kMostTrace = 1u << 20; // bytes of a run that an editor shows

struct Shown { // a result that the editor opens beside the text
  std::string title, language, text;
};

// A value that a command refuses to do without.
struct Missing {
  std::string option, name, title;
};

// What is asked of a command.
struct Asked {
  const Document* document = nullptr;
  bool post = false;
  std::string input; // the document, or the folder of its cycle
  std::string target;
  bool page = false; // HTML; else text
  bool cycleFolder() const { return input != document->path; }
  driver::CommonOptions common;
  driver::SourceOptions source;
  project::NamedTexts variables;
  std::string call;
};

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text)
    switch (c) {
    case '&': out += "&amp;"; break;
    case '<': out += "&lt;"; break;
    case '>': out += "&gt;"; break;
    default: out += c;
    }
  return out;
}

std::string pageOf(const std::string& title, const std::string& text) {
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + escaped(title) +
         "</title></head>\n<body><pre>" + escaped(text) + "</pre></body></html>\n";
}

// "diameter" of "`--set diameter=VALUE`", and the like: messages name what has to be given.
void missingIn(const std::string& message, const std::string& title, std::vector<Missing>& out) {
  const auto add = [&](std::string option, std::string name, std::string what) {
    const bool isNew = std::none_of(
        out.begin(), out.end(), [&](const Missing& one) { return one.option == option && one.name == name; });
    if (isNew) out.push_back({std::move(option), std::move(name), std::move(what)});
  };
  for (const std::string option : {"set", "host", "var"}) {
    const std::string mark = "--" + option + " ";
    for (std::size_t at = message.find(mark); at != std::string::npos; at = message.find(mark, at + 1)) {
      const std::size_t begin = at + mark.size(), end = message.find("=VALUE", begin);
      if (end == std::string::npos) break;
      const std::string name = message.substr(begin, end - begin);
      if (!name.empty() &&
          std::all_of(name.begin(), name.end(),
                      [](char c) { return isLetter(c) || isDigit(c) || c == '_' || c == '-'; }) &&
          name != "NAME" && name != "FIELD")
        add(option, name, title);
    }
  }
  if (message.find("`--clearance Z`") != std::string::npos) add("host", "clearance", title);
  if (const std::size_t call = message.find("--call \""); call != std::string::npos)
    if (const std::size_t end = message.find('"', call + 8); end != std::string::npos)
      add("call", message.substr(call + 8, end - call - 8), "arguments of the call");
}

std::vector<Missing> missingOf(const driver::Outcome& outcome) {
  std::vector<Missing> out;
  const bool fails = outcome.status != 0;
  for (const Diagnostic& one : outcome.diagnostics.all()) {
    if (!fails || (one.severity != Severity::Error && one.range.hasPlace())) continue;
    missingIn(one.message, one.message, out);
    for (const DiagnosticNote& note : one.notes)
      missingIn(note.message, one.message, out);
  }
  return out;
}

Json shown(const Asked& asked, const driver::Outcome& outcome, Shown result) {
  const std::string findings = renderText(outcome.diagnostics, outcome.sources, 50);
  if (outcome.status != 0 && result.text.empty()) result = {result.title, "plaintext", findings};
  if (asked.page && result.language != "html")
    result = {result.title, "html", pageOf(result.title, result.text)};
  Json missing = Json::array();
  for (const Missing& one : missingOf(outcome))
    missing.push_back({{"option", one.option}, {"name", one.name}, {"title", one.title}});
  return {{"title", result.title}, {"language", result.language}, {"text", result.text},
          {"messages", findings},  {"status", outcome.status},    {"missing", missing}};
}

// The object of texts or numbers below a name.
project::NamedTexts textsOf(const Json& params, const char* name) {
  project::NamedTexts out;
  const auto at = params.find(name);
  if (at == params.end() || at->is_null()) return out;
  if (!at->is_object())
    throw Refusal{kInvalidParams, fmt::format("`{}` is an object of names and values", name)};
  for (const auto& [key, value] : at->items()) {
    if (!value.is_string() && !value.is_number())
      throw Refusal{kInvalidParams, fmt::format("`{}` of `{}` is no number and no text", key, name)};
    out.emplace_back(key, value.is_string() ? value.get<std::string>() : value.dump());
  }
  return out;
}

std::string wordOf(const Json& params, const char* name, const std::string& otherwise) {
  const auto at = params.find(name);
  if (at == params.end() || at->is_null()) return otherwise;
  if (!at->is_string()) throw Refusal{kInvalidParams, fmt::format("`{}` is a text", name)};
  return at->get<std::string>();
}

Json post(Asked& asked) {
  const driver::Outcome outcome = driver::post({{asked.input}, asked.common, asked.source, std::nullopt});
  return shown(asked, outcome, {"posted blocks", "dotek-macrob", outcome.output});
}

// By the name of a result, as editors/vscode/package.json has them.
std::string languageOf(const std::string& name) {
  const std::string ending = lowerCase(fs::path(name).extension().string());
  if (ending == ".js") return "javascript";
  if (ending == ".suf") return "dotek-mikroprog";
  return ending == ".cycle" ? "dotek-cycle" : "dotek-macrob";
}

Json convert(Asked& asked) {
  driver::ConvertOptions options;
  options.inputs = {asked.input};
  options.common = asked.common;
  options.source = asked.source;
  options.to = asked.target.empty() ? "fanuc" : asked.target;
  const driver::Outcome outcome = driver::convert(options);
  const std::string name = outcome.files.empty() ? "" : outcome.files.front().name;
  return shown(asked, outcome, {options.to + " program", languageOf(name), outcome.output});
}

// A post of Fusion on the operations that `run-post --matrix` has.
Json runPost(Asked& asked) {
  driver::RunPostOptions options;
  options.post = asked.document->path;
  options.matrix = asked.target.empty() ? "drilling" : asked.target;
  options.common = asked.common;
  const driver::Outcome outcome = driver::runPost(options);
  return shown(asked, outcome, {"program of the post", "dotek-macrob", outcome.output});
}

Json run(Asked& asked) {
  if (asked.post) return runPost(asked);
  driver::SimOptions options;
  options.program = asked.document->path;
  options.common = asked.common;
  options.variables = asked.variables;
  options.setup.call = asked.call;
  options.html = asked.page;
  std::string text;
  bool cut = false;
  if (!asked.page)
    options.trace = [&](std::string_view piece) {
      cut = cut || text.size() + piece.size() > kMostTrace;
      if (!cut) text += piece;
    };
  const driver::Outcome outcome = driver::sim(options);
  if (!asked.page)
    return shown(
        asked, outcome,
        {"run", "plaintext",
         text + (cut ? "... the run goes on; `dotek sim` prints all of it\n" : "") + outcome.output});
  for (const driver::OutputFile& file : outcome.files)
    if (file.name == "html") text = file.text;
  return shown(asked, outcome, {"run", "html", text});
}

Json verify(Asked& asked) {
  driver::VerifyOptions options;
  options.inputs = {asked.input};
  options.common = asked.common;
  options.source = asked.source;
  options.variables = asked.variables;
  options.to = asked.target.empty() ? "fanuc" : asked.target;
  options.cases = 100; // an editor waits
  options.format = asked.page ? targets::ReportFormat::Html : targets::ReportFormat::Markdown;
  const driver::Outcome outcome = driver::verify(options);
  const bool document = !outcome.files.empty();
  return shown(asked, outcome,
               {"verify",
                !document    ? "plaintext"
                : asked.page ? "html"
                             : "markdown",
                document ? outcome.files.front().text : outcome.output});
}

Json preview(Asked& asked) {
  const driver::Outcome outcome = driver::preview({{asked.input}, asked.common});
  return shown(asked, outcome, {"dialog", "html", outcome.output});
}

struct NamedCommand {
  const char* name;
  bool page; // a page where the request names no format
  Json (*call)(Asked& asked);
};
constexpr std::array kCommands = {
    NamedCommand{"post", false, post},      NamedCommand{"convert", false, convert},
    NamedCommand{"run", true, run},         NamedCommand{"verify", true, verify},
    NamedCommand{"preview", true, preview},
};

// The folders of cycles that a Prog prints, with the line that asks for each.
struct Printed {
  std::string name, folder;
  std::uint32_t line = 0; // from 0
};

std::vector<Printed> printedBy(const Document& prog, const Index& index) {
  std::vector<Printed> out;
  const std::vector<std::string> folders = Workspace::cycleFolders(prog.path);
  for (const Occurrence& one : index.occurrences) {
    if (!one.key.starts_with("cycle ")) continue;
    const std::string name = one.key.substr(6);
    const auto folder = std::find_if(folders.begin(), folders.end(), [&](const std::string& path) {
      return fs::path(path).filename() == name;
    });
    if (folder != folders.end()) out.push_back({name, *folder, index.text().lineOf(one.range.begin) - 1});
  }
  return out;
}

// The cycle that a command on a Prog is about: the one that is named, the last one that the text asks for up
// to the line of the cursor, or the only one.
std::string cycleOfProg(const Document& prog, const Index& index, const Json& params) {
  const std::vector<Printed> printed = printedBy(prog, index);
  if (printed.empty())
    throw Refusal{kRequestFailed,
                  "no folder of a cycle that this Prog prints lies beside it; open a file of the "
                  "cycle, whose dotek.toml names the Prog (`prog`)"};
  const std::string named = wordOf(params, "cycle", "");
  std::set<std::string> names;
  for (const Printed& one : printed) {
    names.insert(one.name);
    if (one.name == named) return one.folder;
  }
  const auto position = params.find("position");
  const bool placed = named.empty() && position != params.end() && position->is_object();
  const Printed* last = nullptr;
  for (const Printed& one : printed)
    if (placed && one.line <= position->value("line", 0u) && (last == nullptr || one.line >= last->line))
      last = &one;
  if (last != nullptr) return last->folder;
  if (named.empty() && names.size() == 1) return printed.front().folder;
  std::string all;
  for (const std::string& name : names)
    all += (all.empty() ? "`" : ", `") + name + "`";
  throw Refusal{kRequestFailed, named.empty()
                                    ? "this Prog prints " + all +
                                          "; place the cursor in the branch of one, or name it (`cycle`)"
                                    : "`" + named + "` is no cycle beside this Prog, which prints " + all};
}

Asked askedOf(Workspace& workspace, const Json& params, const NamedCommand& command) {
  Asked out;
  out.document = &documentOf(workspace, params);
  const Index& index = workspace.index(*out.document);
  if (!index.isRead()) throw Refusal{kRequestFailed, "the text is in no language that Dotek reads"};
  out.post = index.post;
  const bool prog = index.kind == std::optional(InputKind::Prog);
  out.input = prog ? cycleOfProg(*out.document, index, params) : Workspace::unitOf(out.document->path);
  out.target = wordOf(params, "target", "");
  const std::string format = wordOf(params, "format", command.page && !index.post ? "html" : "text");
  if (format != "html" && format != "text") throw Refusal{kInvalidParams, "`format` is `html` or `text`"};
  out.page = format == "html";
  out.common = workspace.options({out.input});
  out.common.set = textsOf(params, "set");
  out.common.host = textsOf(params, "host");
  out.variables = textsOf(params, "var");
  out.call = wordOf(params, "call", "");
  if (prog)
    out.source.prog = out.document->path;
  else if (out.cycleFolder())
    out.source.prog = project::flagDefaultsOf({out.input}).prog;
  return out;
}

Json explain(const Json& arguments) {
  if (arguments.empty() || !arguments[0].is_string())
    throw Refusal{kInvalidParams, "the command takes a code"};
  const std::string code = arguments[0].get<std::string>();
  const driver::Outcome outcome = driver::explain(code);
  return shown({}, outcome, {code, "markdown", outcome.output});
}

const NamedCommand* commandOf(std::string_view name) {
  const auto at = std::find_if(kCommands.begin(), kCommands.end(),
                               [&](const NamedCommand& one) { return name == one.name; });
  return at == kCommands.end() ? nullptr : &*at;
}

} // namespace

Json commandNames() {
  Json out = Json::array();
  for (const NamedCommand& one : kCommands)
    out.push_back(std::string("dotek.") + one.name);
  out.push_back("dotek.explain");
  return out;
}

Json runCommand(Workspace& workspace, const Json& params) {
  const std::string name = wordOf(params, "command", "run");
  const NamedCommand* const command = commandOf(name);
  if (command == nullptr) throw Refusal{kInvalidParams, "no command `" + name + "`"};
  Asked asked = askedOf(workspace, params, *command);
  return command->call(asked);
}

// The same with the URI of a document and the name of a target as arguments.
Json execute(Workspace& workspace, const Json& params) {
  const std::string name = params.value("command", "");
  const Json given = params.value("arguments", Json::array());
  const Json arguments = given.is_array() ? given : Json::array();
  if (name == "dotek.explain") return explain(arguments);
  if (!name.starts_with("dotek.") || commandOf(std::string_view(name).substr(6)) == nullptr)
    throw Refusal{kInvalidParams, "no command `" + name + "`"};
  if (arguments.empty() || !arguments[0].is_string())
    throw Refusal{kInvalidParams, "the command takes the URI of a document"};
  Json asked = {{"command", name.substr(6)}, {"textDocument", {{"uri", arguments[0]}}}};
  if (arguments.size() > 1) asked["target"] = arguments[1];
  if (arguments.size() > 2) asked["cycle"] = arguments[2];
  return runCommand(workspace, asked);
}

Json codeLenses(Workspace& workspace, const Json& params) {
  const Document& document = documentOf(workspace, params);
  const Index& index = workspace.index(document);
  Json out = Json::array();
  if (!index.isRead()) return out;
  const Json start = {{"line", 0}, {"character", 0}};
  std::string values; // that a run does not go without
  for (const std::string& name : index.needed)
    values += (values.empty() ? " (asks for " : ", ") + name;
  if (!values.empty()) values += ")";
  const auto add = [&](const std::string& title, const char* command) {
    out.push_back({{"range", {{"start", start}, {"end", start}}},
                   {"command", {{"title", title}, {"command", command}, {"arguments", {document.uri}}}}});
  };
  if (index.post) {
    add("run", "dotek.run");
    return out;
  }
  if (*index.kind == InputKind::Prog) {
    std::set<std::string> seen;
    for (const Printed& one : printedBy(document, index)) {
      if (!seen.insert(one.name).second) continue;
      const Json place = {{"line", one.line}, {"character", 0}};
      for (const char* command : {"post", "convert", "verify", "preview"})
        out.push_back({{"range", {{"start", place}, {"end", place}}},
                       {"command",
                        {{"title", fmt::format("{} {}", command, one.name)},
                         {"command", std::string("dotek.") + command},
                         {"arguments", {document.uri, nullptr, one.name}}}}});
    }
    return out;
  }
  const bool folder = Workspace::unitOf(document.path) != document.path;
  const bool cycle = *index.kind == InputKind::Cycle, program = *index.kind == InputKind::Nc;
  if (folder && project::flagDefaultsOf({Workspace::unitOf(document.path)}).prog) add("post", "dotek.post");
  if (folder || cycle || program) add("convert", "dotek.convert");
  if (!folder && (cycle || program || *index.kind == InputKind::Suf)) add("run" + values, "dotek.run");
  if (folder || cycle || program) add("verify", "dotek.verify");
  if (folder) add("preview", "dotek.preview");
  return out;
}

} // namespace dotek::lsp
