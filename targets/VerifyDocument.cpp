#include "targets/VerifyDocument.h"

#include "sim/picture/PictureText.h"
#include "support/Decimal.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::targets {

namespace {

constexpr std::size_t kMost = 1'000'000; // characters of one text

std::string quoted(std::string_view text) {
  return sim::jsonText(text, kMost);
}

// Names, numbers and texts between braces or brackets, one a line.
class Json {
public:
  std::string finish() { return std::move(out_) + "\n"; }
  void open(std::string_view name, char bracket) {
    begin(name);
    out_ += bracket;
    fresh_ = true;
    ++depth_;
  }
  void close(char bracket) {
    --depth_;
    if (!fresh_) out_ += '\n' + std::string(2 * depth_, ' ');
    out_ += bracket;
    fresh_ = false;
  }
  void text(std::string_view name, std::string_view value) { begin(name), out_ += quoted(value); }
  // null where it is empty.
  void maybe(std::string_view name, std::string_view value) {
    begin(name);
    out_ += value.empty() ? "null" : quoted(value);
  }
  void number(std::string_view name, std::uint64_t value) { begin(name), out_ += std::to_string(value); }
  void number(std::string_view name, double value) { begin(name), out_ += numberText(value); }
  void flag(std::string_view name, bool value) { begin(name), out_ += value ? "true" : "false"; }

private:
  void begin(std::string_view name) {
    if (depth_ > 0) out_ += fresh_ ? "\n" : ",\n";
    out_ += std::string(2 * depth_, ' ');
    if (!name.empty()) out_ += quoted(name) + ": ";
    fresh_ = false;
  }
  std::string out_;
  std::size_t depth_ = 0;
  bool fresh_ = true;
};

void add(Json& json, std::string_view name, const VerifyDocument::Counts& counts, bool edges) {
  json.open(name, '{');
  json.number("all", counts.all);
  json.number("agree", counts.agree);
  json.number("differ", counts.differ);
  json.number("undecided", counts.undecided);
  if (edges) json.number("refused", counts.refused);
  json.close('}');
}

void add(Json& json, std::string_view name, const VerifyDocument::File& file) {
  json.open(name, '{');
  json.text("file", file.name);
  json.number("bytes", file.bytes);
  json.text("sha256", file.sha256);
  json.close('}');
}

std::string lineOf(const VerifyDocument::Excerpt& excerpt) {
  const std::size_t at = excerpt.line - excerpt.first;
  return excerpt.line != 0 && at < excerpt.lines.size() ? excerpt.lines[at] : "";
}

void add(Json& json, std::string_view name, const VerifyDocument::Excerpt& excerpt) {
  if (excerpt.line == 0) return;
  json.open(name, '{');
  json.text("file", excerpt.file);
  json.number("line", std::uint64_t{excerpt.line});
  json.text("text", lineOf(excerpt));
  json.close('}');
}

// Text of a table's cell or a paragraph.
std::string plain(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\n' || c == '\r') {
      out += ' ';
      continue;
    }
    if (std::string_view("\\`*_{}[]<>#|&~").find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

// A span of code: a run of backticks longer than those within.
std::string code(std::string_view text) {
  std::string line(text);
  std::replace(line.begin(), line.end(), '\n', ' ');
  std::size_t most = 0, run = 0;
  for (const char c : line)
    most = std::max(most, run = c == '`' ? run + 1 : 0);
  const std::string fence(most + 1, '`');
  return fence + (most > 0 ? " " + line + " " : line) + fence;
}

// A block of code whatever it holds: indented.
std::string block(const VerifyDocument::Excerpt& excerpt) {
  std::string out;
  for (std::size_t i = 0; i < excerpt.lines.size(); ++i) {
    const auto number = excerpt.first + static_cast<std::uint32_t>(i);
    out += fmt::format("    {} {:>5}  {}\n", number == excerpt.line ? '>' : ' ', number, excerpt.lines[i]);
  }
  return out;
}

std::string countsText(const VerifyDocument::Counts& counts) {
  return fmt::format("{} | {} | {} | {} | {}", counts.all, counts.agree, counts.differ, counts.undecided,
                     counts.refused);
}

} // namespace

std::string jsonOf(const VerifyDocument& d) {
  Json json;
  json.open("", '{');
  json.number("schema", std::uint64_t{1});
  json.open("tool", '{');
  json.text("name", "dotek");
  json.text("version", d.version);
  json.close('}');
  json.maybe("date", d.date);
  json.text("verdict", d.verdict);
  json.text("summary", d.summary);
  json.open("cases", '{');
  add(json, "drawn", d.cases, false);
  add(json, "edge", d.edges, true);
  json.close('}');
  json.open("compared", '{');
  json.text("pair", d.pair);
  json.open("aspects", '[');
  for (const std::string& one : d.aspects)
    json.text("", one);
  json.close(']');
  json.number("tolerance_mm", d.tolerance);
  json.close('}');
  json.open("source", '{');
  json.text("name", d.title);
  json.maybe("control", d.sourceControl);
  json.maybe("form", d.form);
  json.maybe("macros", d.sourceMacros);
  json.open("files", '[');
  for (const VerifyDocument::File& one : d.inputs)
    add(json, "", one);
  json.close(']');
  json.close('}');
  if (!d.target.empty()) {
    json.open("translation", '{');
    json.text("target", d.target);
    json.maybe("control", d.targetControl);
    json.maybe("macros", d.targetMacros);
    json.flag("edited", d.edited);
    if (d.translation) add(json, "text", *d.translation);
    json.close('}');
  }
  json.open("settings", '{');
  json.number("seed", d.seed);
  json.number("min_agreed_percent", d.minAgreed);
  json.open("fixed", '[');
  for (const auto& [name, value] : d.fixed) {
    json.open("", '{');
    json.text("name", name);
    json.text("value", value);
    json.close('}');
  }
  json.close(']');
  json.open("assumed", '[');
  for (const std::string& one : d.assumed)
    json.text("", one);
  json.close(']');
  json.close('}');
  json.open("differences", '[');
  for (const VerifyDocument::Difference& one : d.differences) {
    json.open("", '{');
    json.text("pair", one.pair);
    json.text("aspect", one.aspect);
    json.text("text", one.text);
    json.number("cases", one.cases);
    json.number("of", one.of);
    json.flag("edge", one.edge);
    add(json, "source", one.source);
    add(json, "post", one.post);
    add(json, "translation", one.translation);
    json.text("replay", one.replay);
    json.close('}');
  }
  json.close(']');
  json.open("undecided", '[');
  for (const VerifyDocument::Reason& one : d.undecided) {
    json.open("", '{');
    json.number("cases", one.cases);
    json.text("why", one.why);
    add(json, "at", one.at);
    json.number("rejected", one.rejected);
    json.maybe("remedy", one.remedy);
    json.text("replay", one.replay);
    json.close('}');
  }
  json.close(']');
  json.open("findings", '[');
  for (const VerifyDocument::Finding& one : d.findings) {
    json.open("", '{');
    json.text("severity", one.severity);
    json.text("code", one.code);
    json.text("message", one.message);
    if (one.line != 0) {
      json.text("file", one.file);
      json.number("line", std::uint64_t{one.line});
    }
    json.close('}');
  }
  json.close(']');
  json.close('}');
  return json.finish();
}

std::string markdownOf(const VerifyDocument& d) {
  std::string out = fmt::format("# Verification of {}\n\n**{}**\n\n", plain(d.title), plain(d.summary));
  const auto row = [&](std::string_view name, const std::string& value) {
    if (!value.empty()) out += fmt::format("| {} | {} |\n", name, plain(value));
  };
  out += "| | |\n|---|---|\n";
  row("compared", d.pair);
  row("control of the source", d.sourceControl);
  row("form of the post", d.form);
  row("probing macros of the source", d.sourceMacros);
  row("target", d.target);
  row("control of the translation", d.targetControl);
  row("probing macros of the translation", d.targetMacros);
  row("tolerance", numberText(d.tolerance) + " mm");
  row("seed", std::to_string(d.seed));
  row("share that has to agree", numberText(d.minAgreed) + " %");
  row("Dotek", d.version);
  row("date", d.date);
  for (const auto& [name, value] : d.fixed)
    row("fixed: " + plain(name), value);
  for (const std::string& one : d.assumed)
    row("assumed", one);
  out += "\n## Files\n\n| file | bytes | SHA-256 |\n|---|---|---|\n";
  const auto file = [&](const VerifyDocument::File& one, std::string_view what) {
    out += fmt::format("| {}{} | {} | `{}` |\n", plain(one.name), what, one.bytes, one.sha256);
  };
  for (const VerifyDocument::File& one : d.inputs)
    file(one, "");
  if (d.translation) file(*d.translation, d.edited ? " (translation, edited)" : " (translation)");
  out += "\n## Cases\n\n| | all | agree | differ | undecided | refused |\n|---|---|---|---|---|---|\n";
  out += fmt::format("| drawn | {} |\n", countsText(d.cases));
  if (d.edges.all > 0) out += fmt::format("| edge | {} |\n", countsText(d.edges));
  out += "\nCompared: ";
  for (std::size_t i = 0; i < d.aspects.size(); ++i)
    out += (i == 0 ? "" : ", ") + d.aspects[i];
  out += ".\n";
  if (!d.differences.empty()) out += "\n## Differences\n";
  for (std::size_t i = 0; i < d.differences.size(); ++i) {
    const VerifyDocument::Difference& one = d.differences[i];
    out += fmt::format("\n### {}. {}: {}\n\n{} In {} of {} {} cases.\n", i + 1, one.pair, one.aspect,
                       plain(one.text) + ".", one.cases, one.of, one.edge ? "edge" : "drawn");
    const auto side = [&](std::string_view name, const VerifyDocument::Excerpt& excerpt) {
      if (excerpt.line != 0) out += fmt::format("\n{}, {}:\n\n{}", name, plain(excerpt.file), block(excerpt));
    };
    side("Source", one.source);
    side("Post", one.post);
    side("Translation", one.translation);
    out += "\nIt is shown by " + code(one.replay) + "\n";
  }
  if (!d.undecided.empty()) out += "\n## Undecided cases\n\n";
  for (const VerifyDocument::Reason& one : d.undecided) {
    out += fmt::format("- {} cases: {}", one.cases, plain(one.why));
    if (one.at.line != 0)
      out += fmt::format(" ({}:{}: {})", plain(one.at.file), one.at.line, code(lineOf(one.at)));
    if (!one.remedy.empty()) out += "; fixed by " + one.remedy;
    out += "\n";
  }
  if (!d.findings.empty()) out += "\n## Findings\n\n";
  for (const VerifyDocument::Finding& one : d.findings)
    out += fmt::format("- {}{}: {} [{}]\n",
                       one.line == 0 ? "" : fmt::format("{}:{}: ", plain(one.file), one.line), one.severity,
                       plain(one.message), one.code);
  out += "\nAgreement of drawn cases is evidence, no proof: what no case reached was not compared.\n"
         "\nChecked by: ____________________    Date: ____________    Signature: ____________________\n";
  return out;
}

} // namespace dotek::targets
