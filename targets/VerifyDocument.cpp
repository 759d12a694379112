#include "targets/VerifyDocument.h"

#include "support/Decimal.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace dotek::targets {

namespace {

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

// A message: what it has between two backticks stays a span of code.
std::string message(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t open = text.find('`');
    const std::size_t close = open == std::string_view::npos ? open : text.find('`', open + 1);
    if (close == std::string_view::npos || close == open + 1) return out + plain(text);
    out += plain(text.substr(0, open)) + code(text.substr(open + 1, close - open - 1));
    text.remove_prefix(close + 1);
  }
  return out;
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

std::string lineOf(const VerifyDocument::Excerpt& excerpt) {
  const std::size_t at = excerpt.line - excerpt.first;
  return excerpt.line != 0 && at < excerpt.lines.size() ? excerpt.lines[at] : "";
}

std::string_view leadOf(std::string_view about) {
  return about == "form" ? "What the post prints is read through its form. The report holds as far as these "
                           "entries are right; compare them with a program that the post has written."
                         : "";
}

std::string toleranceText(const VerifyDocument& document) {
  std::string out = numberText(document.tolerance) + " mm";
  if (document.wordSteps > 0)
    out += fmt::format("; what the program rounds to words of the control: {} of their last digit",
                       numberText(document.wordSteps));
  return out;
}

std::string markdownOf(const VerifyDocument& d) {
  std::string out = fmt::format("# Verification of {}\n\n**{}**\n\n", plain(d.title), plain(d.summary));
  if (!d.remark.empty()) out += plain(d.remark) + "\n\n";
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
  row("tolerance", toleranceText(d));
  row("seed", std::to_string(d.seed));
  row("share that has to agree", numberText(d.minAgreed) + " %");
  row("Dotek", d.version);
  row("date", d.date);
  row("command", d.command);
  for (const auto& [name, value] : d.fixed)
    row("fixed: " + plain(name), value);
  for (const std::string& one : d.assumed)
    row("assumed", one);
  const auto findings = [&](std::string_view about, std::string_view title) {
    bool any = false;
    for (const VerifyDocument::Finding& one : d.findings) {
      if (one.about != about) continue;
      if (!std::exchange(any, true)) {
        out += fmt::format("\n## {}\n\n", title);
        if (const std::string_view lead = leadOf(about); !lead.empty()) out += fmt::format("{}\n\n", lead);
      }
      out += fmt::format("- {}{}: {} [{}]\n",
                         one.line == 0 ? "" : fmt::format("{}:{}: ", plain(one.file), one.line), one.severity,
                         message(one.message), one.code);
    }
  };
  findings("form", "What the form assumes");
  findings("translation", "What the translation changes or leaves open");
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
    out += fmt::format("- {} {}cases: {}", one.cases, one.edge ? "edge " : "", plain(one.why));
    if (one.at.line != 0)
      out += fmt::format(" ({}:{}: {})", plain(one.at.file), one.at.line, code(lineOf(one.at)));
    if (!one.remedy.empty()) out += "; fixed by " + one.remedy;
    out += "\n";
  }
  findings("cases", "Findings");
  out += "\nAgreement of drawn cases is evidence, no proof: what no case reached was not compared.\n"
         "\nChecked by: ____________________    Date: ____________    Signature: ____________________\n";
  return out;
}

} // namespace dotek::targets
