#include "posts/PostRun.h"

#include "frontend/fusion/Lower.h"
#include "frontend/fusion/Parse.h"
#include "frontend/fusion/Units.h"
#include "posts/Json.h"
#include "posts/KernelFiles.h"
#include "project/Inputs.h"
#include "stdlib/FusionNames.h"
#include "stdlib/Toml.h"
#include "support/NearestName.h"
#include "support/messages/Commands.h"
#include "support/messages/Posts.h"
#include "support/messages/Verify.h"

#include <charconv>
#include <filesystem>
#include <fmt/format.h>

namespace dotek::posts {

namespace fs = std::filesystem;
namespace fusion = frontend::fusion;

namespace {

std::string kernelText() {
  std::string out;
  for (const KernelFile& file : kernelFiles())
    if (file.name.front() >= '0' && file.name.front() <= '9') out += file.text;
  return out;
}

std::string es6Text() {
  std::string out;
  for (const KernelFile& file : kernelFiles()) // in the order of their names
    if (file.name.starts_with("es6")) out += file.text;
  return out;
}

std::map<std::string, double> settingsOf(const stdlib::DataFiles& data) {
  std::map<std::string, double> out;
  const stdlib::DataFile* const file = data.find("fusion", "kernel");
  if (file == nullptr) throw stdlib::DataError("fusion/kernel.toml is not there");
  const auto document = stdlib::TomlDocument::parse(*file);
  for (const stdlib::TomlTable& table : document.root().value("setting").tables()) {
    static_cast<void>(table.value("grade").text());
    static_cast<void>(table.value("source").text());
    out[table.value("name").text()] = table.value("value").number();
  }
  static_cast<void>(document.finish());
  return out;
}

std::vector<std::string> linesOf(std::string_view text) {
  std::vector<std::string> out;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    out.emplace_back(text.substr(at, end - at));
    at = end + 1;
  }
  return out;
}

// "post\t12\tonSection"; places of the kernel are none.
PostStack stackOf(const std::vector<std::string>& lines, std::size_t from) {
  PostStack out;
  for (std::size_t i = from; i < lines.size(); ++i) {
    const std::string& line = lines[i];
    const std::size_t first = line.find('\t');
    const std::size_t second = first == std::string::npos ? first : line.find('\t', first + 1);
    if (second == std::string::npos || line.substr(0, first) != "post") continue;
    PostPlace place;
    std::from_chars(line.data() + first + 1, line.data() + second, place.line);
    place.function = line.substr(second + 1);
    out.push_back(std::move(place));
  }
  return out;
}

PostProbe probeOf(const std::vector<std::string>& lines) {
  PostProbe out;
  const auto read = [&](std::size_t i, auto& value) {
    if (i < lines.size()) std::from_chars(lines[i].data(), lines[i].data() + lines[i].size(), value);
  };
  read(0, out.tool);
  read(1, out.diameter);
  for (std::size_t i = 2; i < lines.size(); ++i)
    read(i, out.offsets.emplace_back());
  return out;
}

PostFault::Kind kindOf(std::string_view name) {
  if (name == "error") return PostFault::Kind::Refusal;
  if (name == "expand") return PostFault::Kind::Expand;
  if (name == "output") return PostFault::Kind::Output;
  if (name == "property") return PostFault::Kind::Property;
  if (name == "value") return PostFault::Kind::PropertyValue;
  return PostFault::Kind::Thrown;
}

// "identifier 'TextFile' undefined" of what the engine has and the kernel lacks.
void nameAbsent(PostFault& fault, const stdlib::DataFiles& data) {
  constexpr std::string_view kUndefined = "ReferenceError: identifier '";
  if (fault.kind != PostFault::Kind::Thrown || !fault.text.starts_with(kUndefined)) return;
  const std::string name =
      fault.text.substr(kUndefined.size(), fault.text.find('\'', kUndefined.size()) - kUndefined.size());
  if (stdlib::FusionNames::load(data).absent.contains(name))
    fault.text = fmt::format("`{}` of Fusion is not carried out by Dotek's kernel", name);
}

PostFault faultOf(const script::Fault& fault) {
  PostFault out;
  out.kind = fault.kind == script::Fault::Kind::Script    ? PostFault::Kind::Thrown
             : fault.kind == script::Fault::Kind::Stopped ? PostFault::Kind::Stopped
                                                          : PostFault::Kind::NoWorker;
  out.text = fault.text;
  constexpr std::string_view kStop = "dotek-stop "; // of the kernel: kind and text
  if (out.kind == PostFault::Kind::Thrown && out.text.starts_with(kStop)) {
    const std::size_t end = std::min(out.text.find(' ', kStop.size()), out.text.size());
    out.kind = kindOf(std::string_view(out.text).substr(kStop.size(), end - kStop.size()));
    out.text.erase(0, std::min(end + 1, out.text.size()));
  }
  if (fault.source == "post" && fault.line != 0) out.stack.push_back({fault.line, ""});
  return out;
}

// "in operation 2 `Web`, cycle probing-x-wall, called from onCyclePoint"
std::string circumstances(const PostFault& fault) {
  std::string out;
  const auto add = [&](const std::string& text) { out += (out.empty() ? "" : ", ") + text; };
  if (!fault.section.empty())
    add("in section " + fault.section + (fault.operation.empty() ? "" : " `" + fault.operation + "`"));
  if (!fault.cycle.empty()) add("cycle `" + fault.cycle + "`");
  if (!fault.stack.empty() && !fault.stack.back().function.empty() && fault.stack.back().function != "global")
    add("in " + fault.stack.back().function);
  return out.empty() ? "" : " (" + out + ")";
}

} // namespace

SourceRange PostRunner::lineRange(std::uint32_t line) const {
  if (file_ == kNoFile || line == 0) return {};
  const SourceFile& file = session_.sources().file(file_);
  if (line > file.lineCount()) return {};
  const std::string_view text = file.line(line);
  const std::size_t first = std::min(text.find_first_not_of(" \t"), text.size());
  const std::size_t last = text.find_last_not_of(" \t\r;");
  const std::uint32_t start = file.lineStart(line);
  return {file_, start + static_cast<std::uint32_t>(first),
          start + static_cast<std::uint32_t>(last == std::string_view::npos ? first : last + 1)};
}

// ES5 in UTF-8; nullopt: reported.
std::optional<std::string> PostRunner::lowered(FileId file) {
  Diagnostics& diagnostics = session_.diagnostics();
  const fusion::Tree tree = fusion::parse(file, session_.sources());
  for (const fusion::Unread& one : tree.unread)
    diagnostics.report<diag::PostUnread>(one.range, one.message);
  if (!tree.unread.empty()) return std::nullopt;
  const fusion::Scopes scopes = fusion::resolve(tree);
  const std::vector<fusion::Unread> twice = fusion::declaredTwice(tree, scopes);
  for (const fusion::Unread& one : twice)
    diagnostics.report<diag::PostUnread>(one.range, one.message);
  if (!twice.empty()) return std::nullopt;
  if (file == file_) {
    functions_ = fusion::givenFunctions(tree);
    for (fusion::GivenFunction& one : functions_) {
      one.begin = session_.sources().file(file).lineOf(one.begin);
      one.end = session_.sources().file(file).lineOf(one.end);
    }
  }
  fusion::Lowered out = fusion::lower(tree, scopes);
  for (const fusion::Unread& one : out.refused)
    diagnostics.report<diag::PostConstruct>(one.range, one.message);
  if (!out.refused.empty()) return std::nullopt;
  const auto settings = settingsOf(session_.data());
  for (const fusion::Node* one : fusion::unitsAsNumbers(tree, scopes))
    diagnostics.report<diag::PostUnitCompared>(tree.range(*one), jsonNumber(settings.at("mm")),
                                               jsonNumber(settings.at("in")));
  return toUtf8(out.text, session_.sources().file(file).encoding());
}

// The engine calls a function without a name `[anon]`; a post knows it by what it was given to.
void PostRunner::nameFunctions(PostStack& stack) const {
  for (PostPlace& place : stack) {
    if (place.function != "[anon]") continue;
    const fusion::GivenFunction* inner = nullptr;
    bool several = false;
    for (const fusion::GivenFunction& one : functions_) {
      if (place.line < one.begin || place.line > one.end) continue;
      const bool same = inner != nullptr && inner->begin == one.begin && inner->end == one.end;
      if (inner != nullptr && !same && one.end - one.begin > inner->end - inner->begin) continue;
      several = same;
      inner = &one;
    }
    if (inner != nullptr && !several && !inner->name.empty()) place.function = inner->name;
  }
}

// Files that the text names in include("..").
bool PostRunner::include(const std::string& path, std::map<std::string, std::string>& into, int depth) {
  const FileId file = *session_.read(path, Encoding::Cp1250);
  const fusion::Tree tree = fusion::parse(file, session_.sources());
  const fs::path folder = fs::path(path).parent_path();
  const ReadBounds bounds = session_.bounds(folder.generic_string());
  for (const fusion::Node& node : tree.nodes) {
    if (!node.is(fusion::Kind::Call) || node.kids.size() < 2 || !node.kids[0]->isName("include")) continue;
    const fusion::Node* const name = fusion::bare(node.kids[1]);
    if (!name->is(fusion::Kind::String)) continue;
    const std::string text(fusion::stringText(*name));
    if (into.contains(text)) continue;
    std::string local = text;
    std::replace(local.begin(), local.end(), '\\', '/');
    const std::string other = (folder / local).generic_string();
    if (!bounds.allow(other)) {
      session_.diagnostics().report<diag::IncludeOutside>(tree.range(node), other, bounds.text(),
                                                          folderName(other));
      return false;
    }
    if (depth >= static_cast<int>(session_.limits().includeDepth)) {
      session_.diagnostics().report<diag::IncludeTooDeep>(tree.range(node), session_.limits().includeDepth);
      return false;
    }
    if (project::refusesStream(other, tree.range(node), session_)) return false;
    const std::optional<FileId> read = session_.read(other, Encoding::Cp1250);
    if (!read) return false;
    std::optional<std::string> one = lowered(*read);
    if (!one) return false;
    into[text] = std::move(*one);
    if (!include(other, into, depth + 1)) return false;
  }
  return true;
}

std::string PostRunner::setup(bool inch, const std::map<std::string, std::string>& includes) const {
  const stdlib::FusionNames names = stdlib::FusionNames::load(session_.data());
  JsonObject values;
  for (const stdlib::FusionNames::Family& family : names.families)
    for (std::size_t i = 0; i < family.names.size(); ++i)
      values.add(family.names[i], std::to_string(family.values[i]));
  JsonObject settings;
  for (const auto& [name, value] : settingsOf(session_.data()))
    settings.add(name, jsonNumber(value));
  JsonObject files;
  for (const auto& [name, text] : includes)
    files.add(name, jsonText(text));
  std::vector<std::string> missing;
  for (const std::string& name : names.functions)
    missing.push_back(jsonText(name));
  std::vector<std::string> entries;
  for (const std::string& name : names.entries)
    entries.push_back(jsonText(name));
  JsonObject all;
  all.add("entries", jsonList(entries));
  all.add("settings", settings.text());
  all.add("values", values.text());
  all.add("missing", jsonList(missing));
  all.add("inch", inch ? "true" : "false");
  all.add("includes", files.text());
  return "dotekPrepare(" + all.text() + ");\n";
}

bool PostRunner::load(const std::string& path, bool inch) {
  const std::optional<FileId> file = session_.read(path, Encoding::Cp1250);
  if (!file) return false;
  file_ = *file;
  const std::optional<std::string> text = lowered(file_);
  if (!text) return false;
  std::map<std::string, std::string> includes;
  if (!include(path, includes, 0)) return false;
  const std::string kernel = kernelText();
  const std::string es6 = es6Text();
  const std::string setupText = setup(inch, includes);
  // The kernel's value is what runs.
  const auto fault = runner_.load({{"kernel", kernel}, {"es6", es6}, {"setup", setupText}, {"post", *text}});
  if (!fault) return true;
  PostResult result;
  result.fault = faultOf(*fault);
  nameAbsent(*result.fault, session_.data());
  report(result);
  return false;
}

PostResult PostRunner::run(const std::string& job) {
  PostResult out;
  auto answer = runner_.run(job);
  if (const script::Fault* fault = std::get_if<script::Fault>(&answer)) {
    out.fault = faultOf(*fault);
    nameAbsent(*out.fault, session_.data());
    return out;
  }
  for (const std::string& text : std::get<script::Texts>(answer)) {
    if (text.empty()) continue;
    const std::string_view rest = std::string_view(text).substr(1);
    const std::vector<std::string> lines =
        text.front() == 'N' || text.front() == 'L' ? std::vector<std::string>() : linesOf(rest);
    switch (text.front()) {
    case 'N': out.nc = rest; break;
    case 'M': out.lines.push_back(stackOf(lines, 0)); break;
    case 'L': out.log.emplace_back(rest); break;
    case 'F': out.files[lines.front()] = rest.substr(std::min(lines.front().size() + 1, rest.size())); break;
    case 'W': out.warnings.push_back({lines.front(), stackOf(lines, 1)}); break;
    case 'T': out.probe = probeOf(lines); break;
    case 'E':
      if (lines.size() >= 5)
        out.fault = PostFault{kindOf(lines[0]), lines[1], lines[2], lines[3], lines[4], stackOf(lines, 5)};
      break;
    default: break;
    }
  }
  for (PostStack& stack : out.lines)
    nameFunctions(stack);
  for (PostWarning& one : out.warnings)
    nameFunctions(one.stack);
  if (out.fault) {
    nameFunctions(out.fault->stack);
    nameAbsent(*out.fault, session_.data());
  }
  return out;
}

std::vector<PostProperty> PostRunner::properties() {
  std::vector<PostProperty> out;
  auto answer = runner_.run(R"({"list": "properties"})");
  if (!std::holds_alternative<script::Texts>(answer)) return out;
  for (const std::string& text : std::get<script::Texts>(answer)) {
    const auto lines = linesOf(std::string_view(text).substr(1));
    if (text.front() == 'P' && lines.size() >= 4) out.push_back({lines[0], lines[1], lines[2], lines[3]});
  }
  return out;
}

std::vector<std::string> PostRunner::capabilities() {
  std::vector<std::string> out;
  auto answer = runner_.run(R"({"list": "properties"})");
  if (!std::holds_alternative<script::Texts>(answer)) return out;
  for (const std::string& text : std::get<script::Texts>(answer))
    if (text.starts_with('C')) out.push_back(text.substr(1));
  return out;
}

void PostRunner::report(const PostResult& result) {
  Diagnostics& diagnostics = session_.diagnostics();
  const auto placeOf = [&](const PostStack& stack) {
    return stack.empty() ? SourceRange() : lineRange(stack.front().line);
  };
  for (const PostWarning& one : result.warnings)
    diagnostics.report<diag::PostWarns>(placeOf(one.stack), one.text);
  for (const auto& [name, text] : result.files)
    diagnostics.report<diag::PostFile>({}, text.size(), name);
  if (!result.fault) return;
  const PostFault& fault = *result.fault;
  const std::string text = fault.text + circumstances(fault);
  const SourceRange where = placeOf(fault.stack);
  Diagnostic* out = nullptr;
  switch (fault.kind) {
  case PostFault::Kind::Refusal: out = &diagnostics.report<diag::PostRefuses>(where, text); break;
  case PostFault::Kind::Thrown:
    if (fault.text == "Error: alloc failed") // the engine's own words
      out = &diagnostics.report<diag::PostStopped>(
          where, fmt::format("it needs more than {} MB of memory; `--limit script-memory=MB` gives it more{}",
                             options_.memory, circumstances(fault)));
    else if (fault.text.ends_with(": callstack limit") || fault.text.ends_with(": C stack depth limit"))
      out = &diagnostics.report<diag::PostStopped>(
          where,
          "its calls are nested without end, or deeper than the engine has room for" + circumstances(fault));
    else
      out = &diagnostics.report<diag::PostThrew>(where, text);
    break;
  case PostFault::Kind::Expand: out = &diagnostics.report<diag::PostExpands>(where, text); break;
  case PostFault::Kind::Property: {
    std::vector<std::string> names;
    for (const PostProperty& one : properties())
      names.push_back(one.name);
    const std::string near = nearestName(fault.text, names);
    out = &diagnostics.report<diag::PostProperty>({}, fault.text,
                                                  near.empty() ? "" : "; did you mean `" + near + "`?");
    break;
  }
  case PostFault::Kind::PropertyValue:
    out = &diagnostics.report<diag::PostPropertyValue>({}, fault.text);
    break;
  case PostFault::Kind::Output:
    out = &diagnostics.report<diag::PostStopped>(
        where, fmt::format("it wrote more than {} bytes; `--limit script-output=N` raises the limit",
                           options_.output));
    break;
  case PostFault::Kind::Stopped: out = &diagnostics.report<diag::PostStopped>(where, text); break;
  case PostFault::Kind::NoWorker: out = &diagnostics.report<diag::ScriptNotRun>({}, text); break;
  }
  for (std::size_t i = 1; i < fault.stack.size() && i < 4; ++i)
    out->note(lineRange(fault.stack[i].line), fmt::format("called from {}", fault.stack[i].function));
}

} // namespace dotek::posts
