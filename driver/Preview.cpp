#include "driver/Preview.h"

#include "driver/Command.h"
#include "frontend/gibbs/Labels.h"
#include "frontend/gibbs/Run.h"
#include "project/Compilation.h"
#include "project/CycleChecks.h"
#include "project/Fields.h"
#include "project/Hosts.h"
#include "project/Prog.h"
#include "sim/picture/PictureText.h"
#include "support/Decimal.h"
#include "support/Temporary.h"
#include "support/messages/Common.h"
#include "targets/Target.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <map>

namespace dotek::driver {

namespace gibbs = frontend::gibbs;
using sim::shortNumber;
using sim::xmlText;

namespace {

constexpr std::string_view kStyle = R"(
:root { color-scheme: light dark; --paper: #fff; --ink: #20262d; --edge: #8b939e; --note: #7a4d00; --bad: #a80b22; --path: #0a529a; }
@media (prefers-color-scheme: dark) {
  :root { --paper: #12161b; --ink: #e9edf2; --edge: #7d8794; --note: #f0b95a; --bad: #ffa39b; --path: #8fc4ff; }
}
* { box-sizing: border-box; }
body { margin: 12px; font: 14px/1.4 "Segoe UI", Helvetica, Arial, sans-serif; color: var(--ink); background: var(--paper); overflow-wrap: anywhere; }
h1 { font-size: 18px; } h2 { font-size: 15px; }
.note { color: var(--note); } .bad { color: var(--bad); }
#scroll { overflow-x: auto; max-width: 100%; }
#window { position: relative; border: 1px solid var(--edge); overflow: hidden; overflow-wrap: normal; }
#window > * { position: absolute; margin: 0; font: 13px/1.2 inherit; overflow: hidden; }
#window > .frame { border: 1px solid var(--edge); }
#paths { display: flex; flex-wrap: wrap; gap: 12px; }
figure { margin: 0; }
#paths svg { width: 360px; max-width: 100%; max-height: 420px; border: 1px solid var(--edge); }
polyline { fill: none; stroke: var(--path); stroke-width: 2; vector-effect: non-scaling-stroke; }
)";

std::optional<double> constant(const gibbs::Expression& expression) {
  const auto* unary = std::get_if<gibbs::Unary>(&expression.node);
  const auto* number =
      std::get_if<gibbs::NumberLiteral>(unary != nullptr ? &unary->operand->node : &expression.node);
  if (number == nullptr) return std::nullopt;
  return unary != nullptr && unary->op == gibbs::UnaryOperator::Minus ? -number->value : number->value;
}

class Form {
public:
  Form(const CycleFolder& folder, const Session& session, const std::map<std::string, double>& values)
      : dialog_(*folder.cycle->dialog), session_(session), values_(values),
        encoding_(session.sources().file(dialog_.file).encoding()) {
    for (const gibbs::InputLabel& label : gibbs::inputLabels(dialog_))
      labels_.emplace(label.input, label);
  }

  // The window; fills `notes`, which are HTML.
  std::string make(std::vector<std::string>& notes) {
    int width = 0, height = 0;
    std::string out;
    readLists();
    for (const gibbs::Control& control : dialog_.controls) {
      const std::string kind = gibbs::foldCase(control.kind.text);
      if (kind == "DIALOG" && control.text) title_ = utf8(*control.text);
      const std::string shape = kind == "DIALOG" ? "" : element(control, kind);
      if (control.box) {
        const gibbs::Box& box = *control.box;
        const bool window = kind == "DIALOG";
        width = std::max(width, box.width + (window ? 0 : box.left));
        height = std::max(height, box.height + (window ? 0 : box.top));
        out += shape;
      }
      // Entries and value of a list are in the list.
      const bool shown = kind == "DIALOG" || kind == "DROPDOWN_ADD" || kind == "DROPDOWN_VAL" ||
                         (control.box && !shape.empty());
      if (!shown) {
        const SourceFile& file = session_.sources().file(control.range.file);
        notes.push_back(fmt::format(
            "not shown: <code>{}</code>",
            xmlText(utf8(file.bytes().substr(control.range.begin, control.range.end - control.range.begin)),
                    200)));
      }
    }
    if (dialog_.hasErrorNodes) notes.emplace_back("lines of the dialog that could not be read are not shown");
    return fmt::format(
        "<div id=\"scroll\"><div id=\"window\" style=\"width:{}px;height:{}px\">\n{}</div></div>\n",
        std::clamp(width, 0, 10000), std::clamp(height, 0, 10000), out);
  }
  const std::string& title() const { return title_; }

private:
  std::string utf8(std::string_view bytes) const { return toUtf8(bytes, encoding_); }

  // The choices of each DROPDOWN_NEW; lists are numbered in their order, from 1.
  void readLists() {
    std::vector<const gibbs::Control*> lists;
    for (const gibbs::Control& control : dialog_.controls) {
      const std::string kind = gibbs::foldCase(control.kind.text);
      if (kind == "DROPDOWN_NEW") lists.push_back(&control);
      if (kind != "DROPDOWN_ADD" || control.arguments.size() != 3) continue;
      const auto list = constant(*control.arguments[0]);
      const auto value = constant(*control.arguments[2]);
      const auto* text = std::get_if<gibbs::TextLiteral>(&control.arguments[1]->node);
      if (list && value && text != nullptr && *list >= 1 && *list <= static_cast<double>(lists.size()))
        choices_[lists[static_cast<std::size_t>(*list) - 1]].emplace_back(*value, utf8(text->text));
    }
  }

  std::optional<double> valueOf(const gibbs::Control& control) const {
    if (control.variable)
      if (const auto found = values_.find(gibbs::foldCase(control.variable->text)); found != values_.end())
        return found->second;
    return control.initial != nullptr ? constant(*control.initial) : std::nullopt;
  }

  // What a pointer that rests on an input shows: its name, unit and meaning.
  std::string hint(const gibbs::Control& control) const {
    const auto found = labels_.find(&control);
    if (found == labels_.end()) return "";
    const gibbs::InputLabel& label = found->second;
    std::string text = utf8(label.name.empty() ? label.variable.text : label.name);
    if (!label.unit.empty()) text += " [" + utf8(label.unit) + "]";
    if (!label.meaning.empty()) text += ": " + utf8(label.meaning);
    return fmt::format(" title=\"{0}\" aria-label=\"{0}\"", xmlText(text, 300));
  }

  // "": the page does not show this kind.
  std::string element(const gibbs::Control& control, const std::string& kind) const {
    if (!control.box) return "";
    const gibbs::Box& box = *control.box;
    const std::string place = fmt::format("style=\"left:{}px;top:{}px;width:{}px;height:{}px\"", box.left,
                                          box.top, box.width, box.height);
    const std::string text = xmlText(control.text ? utf8(*control.text) : "", 300);
    const auto value = valueOf(control);
    if (kind == "LABEL") return fmt::format("<span {}>{}</span>\n", place, text);
    if (kind == "FRAME") return fmt::format("<div class=\"frame\" {}>{}</div>\n", place, text);
    if (kind == "OK" || kind == "CANCEL" || kind == "BUTTON")
      return fmt::format("<button type=\"button\" disabled {}>{}</button>\n", place,
                         text.empty() && kind != "BUTTON" ? (kind == "OK" ? "OK" : "Cancel") : text);
    if (kind == "INPUT")
      return fmt::format("<input readonly {}{} value=\"{}\">\n", place, hint(control),
                         value ? shortNumber(*value, 6) : "");
    if (kind == "CHECK")
      return fmt::format("<label {}{}><input type=\"checkbox\" disabled{}> {}</label>\n", place,
                         hint(control), value && *value != 0 ? " checked" : "", text);
    if (kind == "DROPDOWN_NEW") {
      std::string options;
      if (const auto found = choices_.find(&control); found != choices_.end())
        for (const auto& [number, caption] : found->second)
          options +=
              fmt::format("<option{}>{}</option>", value == number ? " selected" : "", xmlText(caption, 300));
      // Without a choice of this value the browser would show the first one.
      if (options.find(" selected>") == std::string::npos)
        options = fmt::format("<option selected>{}</option>", value ? shortNumber(*value, 6) : "") + options;
      return fmt::format("<select disabled {}{}>{}</select>\n", place, hint(control), options);
    }
    return "";
  }

  const gibbs::Dialog& dialog_;
  const Session& session_;
  const std::map<std::string, double>& values_;
  Encoding encoding_;
  std::string title_;
  std::map<const gibbs::Control*, gibbs::InputLabel> labels_;
  std::map<const gibbs::Control*, std::vector<std::pair<double, std::string>>> choices_;
};

std::string view(const std::vector<gibbs::PathMove>& path, bool side) {
  std::string points = "0,0";
  double left = 0, right = 0, low = 0, high = 0;
  for (const gibbs::PathMove& move : path) {
    const double x = move.x, y = side ? -move.z : -move.y;
    left = std::min(left, x), right = std::max(right, x), low = std::min(low, y), high = std::max(high, y);
    points += fmt::format(" {},{}", shortNumber(x, 4), shortNumber(y, 4));
  }
  const double edge = std::max({right - left, high - low, 1.0}) * 0.08;
  return fmt::format("<figure><svg viewBox=\"{} {} {} {}\" role=\"img\"><polyline points=\"{}\"/></svg>"
                     "<figcaption>{}, {} mm wide, {} mm high</figcaption></figure>\n",
                     shortNumber(left - edge, 4), shortNumber(low - edge, 4),
                     shortNumber(right - left + 2 * edge, 4), shortNumber(high - low + 2 * edge, 4), points,
                     side ? "XZ" : "XY", shortNumber(right - left, 3), shortNumber(high - low, 3));
}

// xmlText makes one line of a text.
std::string lines(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    out += xmlText(text.substr(0, end), 300) + "\n";
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

std::string note(const std::string& html, const char* kind = "note") {
  return fmt::format("<p class=\"{}\">{}</p>\n", kind, html);
}

std::string reasons(const Diagnostics& found) {
  std::string out;
  for (const Diagnostic& one : found.all())
    if (one.severity == Severity::Error) out += (out.empty() ? "" : "; ") + one.message;
  return xmlText(out);
}

std::string checked(const gibbs::ChecksResult& result, const Diagnostics& found) {
  std::string out;
  for (const gibbs::Rejection& one : result.rejections)
    out += note(one.text.empty() ? "rejected without a message" : xmlText(one.text), "bad");
  for (const gibbs::Rejection& one : result.shown)
    out += note(xmlText(one.text));
  std::string changed;
  for (const auto& [name, value] : result.changed)
    changed += fmt::format("{}{} = {}", changed.empty() ? "" : ", ", name, shortNumber(value, 6));
  if (!changed.empty())
    out += note(
        "The macro changes values after the dialog, which the inputs show as they were; the path is drawn "
        "with those that no input holds: " +
        xmlText(changed));
  using Verdict = gibbs::ChecksResult::Verdict;
  if (result.verdict == Verdict::Passes) return out + "<p>The values pass.</p>\n";
  if (result.verdict == Verdict::Rejected) return out + note("The values are rejected.", "bad");
  if (result.verdict == Verdict::NotRun) return out + note("The checks were not run: " + reasons(found));
  std::string needed;
  for (const std::string& host : result.neededHosts)
    needed += (needed.empty() ? "" : ", ") + host;
  return out + note("What the checks say depends on what only the CAM knows; give it by --host: " +
                    xmlText(needed));
}

std::string page(const CycleFolder& folder, const FieldTable& fields, Session& session) {
  const std::map<std::string, double> values = fields.macroValues();
  std::map<std::string, double> stored = values;
  std::vector<std::string> notes;
  Form form(folder, session, values);
  const std::string window = form.make(notes);
  Diagnostics ofChecks, ofPath;
  const auto context = [&](Diagnostics& into) {
    return gibbs::RunContext{
        session.sources(),
        session.gibbsKeywords(),
        session.limits(),
        into,
        values,
        parseHosts(session.options().host, into),
        session.options().assume,
        [&](const std::string& name, SourceRange where) { return folder.loader->macro(name, where); },
        [&](const std::string& name, SourceRange where) { return folder.loader->dialog(name, where); }};
  };
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
      "form-action 'none'; base-uri 'none'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n",
      xmlText(folder.name + (form.title().empty() ? "" : ": " + form.title()), 300), kStyle);
  out += note("Checks and path are those of the values shown, which are the defaults or given by --set; this "
              "page computes nothing, so its inputs cannot be changed.");
  out += window;
  for (const std::string& one : notes)
    out += note(one);
  gibbs::RunContext forChecks = context(ofChecks);
  const gibbs::ChecksResult result = gibbs::runChecks(*folder.cycle->cycleData, forChecks);
  out += "<h2>Checks</h2>\n" + checked(result, ofChecks);
  out += "<h2>Path</h2>\n";
  project::takeComputed(result, folder, session, stored);
  gibbs::RunContext forPath = context(ofPath);
  forPath.fields = stored;
  const auto path = gibbs::runToolPath(*folder.cycle->toolPath, forPath);
  if (!path)
    out += note("The path is not drawn: " + reasons(ofPath));
  else
    out += "<div id=\"paths\">\n" + view(*path, false) + view(*path, true) + "</div>\n<pre>" +
           lines(gibbs::pathText(*path)) + "</pre>\n";
  return out + "</body>\n</html>\n";
}

bool isCycleFile(const PreviewOptions& options) {
  std::error_code error;
  return options.folders.size() == 1 && options.folders.front().ends_with(".cycle") &&
         !std::filesystem::is_directory(options.folders.front(), error);
}

Outcome previewFolder(const PreviewOptions& options) {
  return guarded(options.common, options.folders, [&](Session& session) {
    const std::string folderName = options.folders.size() == 1 ? options.folders.front() : "";
    if (folderName.empty())
      session.diagnostics().report<diag::MissingOption>({}, "preview", "FOLDER", "the folder of one cycle");
    else if (!isCycleFolder(folderName))
      session.diagnostics().report<diag::FileNotReadable>(
          {}, folderName, "it is neither a folder of a GibbsCAM cycle nor a file of the cycle language");
    if (session.diagnostics().hasErrors()) return outcomeOf(session, "");
    Compilation compilation(session);
    const CycleFolder& folder = compilation.addFolder(folderName);
    if (!folder.complete || session.diagnostics().hasErrors()) return outcomeOf(session, "");
    leaveFindingsToLint(session);
    FieldTable fields(folder, {}, session);
    for (const auto& [name, text] : options.common.set) {
      const std::optional<double> value = parseNumber(text);
      if (!value)
        session.diagnostics().report<diag::NotANumber>({}, "--set", name, text);
      else if (!fields.set(name, *value, {}))
        session.diagnostics().report<diag::NoSuchField>({}, name, folder.name, fields.hint(name));
    }
    parseHosts(options.common.host, session.diagnostics());
    if (session.diagnostics().hasErrors()) return outcomeOf(session, "");
    return outcomeOf(session, page(folder, fields, session));
  });
}

// The dialog that `convert --to gibbs` writes of it. Values of --set are the first ones of the dialog.
Outcome previewCycle(const PreviewOptions& options) {
  ConvertOptions convert;
  convert.inputs = options.folders;
  const auto targets = allTargets();
  const auto folders = std::find_if(targets.begin(), targets.end(),
                                    [](const NamedTarget& one) { return one.target->writesFolder; });
  if (folders != targets.end()) convert.to = folders->name;
  convert.probeMacros = "inspection-plus"; // the branch alone depends on it, which the page does not show
  convert.common = options.common;
  convert.common.set.clear();
  convert.common.host.clear();
  convert.defaults = options.common.set;
  std::map<std::string, std::string> hosts = {{"approach_feed", "1000"}}; // of the branch, too
  for (const auto& [name, text] : options.common.host)
    if (name == "approach_feed" || name == "measuring_feed" || name == "overtravel") hosts[name] = text;
  for (const auto& [name, text] : hosts)
    convert.common.host.emplace_back(name, text);
  Outcome made = driver::convert(convert);
  if (made.status != 0 || made.diagnostics.hasErrors()) {
    made.files.clear();
    for (Diagnostic& one : made.diagnostics.all())
      if (const std::size_t flag = one.message.find("--default "); flag != std::string::npos)
        one.message.replace(flag, std::string_view("--default ").size(), "--set ");
    return made;
  }
  TemporaryFolder scratch;
  bool good = scratch.create();
  std::string name;
  for (const OutputFile& file : made.files) {
    good = good && scratch.write(file.name, file.text);
    name = file.name.substr(0, file.name.find('/'));
  }
  if (!good || name.empty())
    return guarded(options.common, [&](Session& session) {
      session.diagnostics().report<diag::FileNotReadable>({}, options.folders.front(),
                                                          "no temporary folder can be written");
      return outcomeOf(session, "");
    });
  PreviewOptions folder = options;
  folder.folders = {(std::filesystem::path(scratch.path()) / name).string()};
  folder.common.set.clear();
  return previewFolder(folder);
}

} // namespace

Outcome preview(const PreviewOptions& options) {
  return isCycleFile(options) ? previewCycle(options) : previewFolder(options);
}

} // namespace dotek::driver
