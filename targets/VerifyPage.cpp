// The report of verify as a page.
#include "sim/picture/PictureText.h"
#include "support/Decimal.h"
#include "targets/VerifyDocument.h"
#include "targets/VerifyStyle.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace dotek::targets {

namespace {

constexpr std::size_t kMost = 100'000; // characters of one text

std::string text(std::string_view value) {
  return sim::xmlText(value, kMost);
}

// A message, with what is between backticks as code.
std::string prose(std::string_view message) {
  std::string out;
  bool code = false;
  for (std::size_t at = 0;;) {
    const std::size_t end = message.find('`', at);
    const bool opens =
        end != std::string_view::npos && (code || message.find('`', end + 1) != std::string_view::npos);
    out += text(message.substr(at, opens ? end - at : std::string_view::npos));
    if (!opens) return out;
    out += code ? "</code>" : "<code>";
    code = !code;
    at = end + 1;
  }
}

class Page {
public:
  explicit Page(const VerifyDocument& document) : d_(document) {}

  std::string run() {
    const std::string title = "Verification of " + d_.title;
    out_ = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
           text(title) + "</title>\n<style>\n" + std::string(verifyStyle()) +
           "</style>\n</head>\n<body>\n<main>\n";
    out_ += "<header><h1>" + text(title) + "</h1><p>Verification report<br>Dotek " + text(d_.version);
    if (!d_.date.empty()) out_ += "<br>" + text(d_.date);
    out_ += "</p></header>\n";
    if (!d_.remark.empty()) out_ += "<p class=\"remark\">" + text(d_.remark) + "</p>\n";
    verdict();
    facts();
    findings("form", "What the form assumes");
    findings("translation", "What the translation changes or leaves open");
    files();
    cases();
    differences();
    undecided();
    findings("cases", "Findings");
    picture();
    out_ +=
        "<p class=\"limits\">Agreement of drawn cases is evidence, no proof: what no case reached was not "
        "compared. The cases are drawn from the seed alone: the same Dotek, files and flags give the same "
        "report. A file is the one that was looked at if its SHA-256 is the same.</p>\n";
    out_ += "<section class=\"sign\"><div>Checked by</div><div>Date</div><div>Signature</div></section>\n";
    out_ += "</main>\n</body>\n</html>\n";
    return std::move(out_);
  }

private:
  void verdict() {
    const std::string kind = d_.verdict == "AGREES" ? " agrees" : d_.verdict == "DIFFERS" ? " differs" : "";
    const std::size_t colon = d_.summary.find(": ");
    const std::string rest = colon == std::string::npos ? "" : d_.summary.substr(colon + 2);
    out_ += fmt::format("<section class=\"verdict{}\"><strong>{}</strong>{}</section>\n", kind,
                        text(d_.verdict), text(rest));
    out_ += "<p>" + text(meaning()) + "</p>\n";
  }

  std::string meaning() const {
    if (d_.verdict == "AGREES")
      return "In every drawn case that could be decided, both sides did the same: " + d_.pair + "." +
             (d_.translation && d_.pair.find("drawn path") != std::string::npos
                  ? " Moves of the drawn path are compared by `dotek verify` without `--to`."
                  : "");
    if (d_.verdict == "DIFFERS")
      return "The two sides do not do the same: " + d_.pair +
             ". Each difference is below, with the lines that lead to it where they are known.";
    return "Too little could be decided to say that the two sides do the same: " + d_.pair +
           ". The reasons are below.";
  }

  void row(std::string_view name, const std::string& value) {
    if (!value.empty())
      out_ += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", text(name), text(value));
  }

  void facts() {
    out_ += "<h2>What was compared</h2>\n<table class=\"facts\">\n";
    row("Pair", d_.pair);
    row("Control of the source", d_.sourceControl);
    row("Form of the post", d_.form);
    row("Probing macros of the source", d_.sourceMacros);
    row("Target", d_.target);
    row("Control of the translation", d_.targetControl);
    row("Probing macros of the translation", d_.targetMacros);
    std::string aspects;
    for (const std::string& one : d_.aspects)
      aspects += (aspects.empty() ? "" : ", ") + one;
    row("Compared", aspects);
    row("Equal within", toleranceText(d_));
    std::string fixed;
    for (const auto& [name, value] : d_.fixed)
      fixed += fmt::format("{}{} = {}", fixed.empty() ? "" : ", ", name, value);
    row("Fixed values", fixed.empty() ? "none: all are drawn" : fixed);
    std::string assumed;
    for (const std::string& one : d_.assumed)
      assumed += (assumed.empty() ? "" : ", ") + one;
    row("Assumed", assumed);
    out_ += "</table>\n";
  }

  void file(const VerifyDocument::File& file, std::string_view what) {
    out_ += fmt::format("<tr><td>{}</td><td class=\"file\">{}</td><td class=\"number\">{}</td><td "
                        "class=\"hash\">{}</td></tr>\n",
                        what, text(file.name), file.bytes, text(file.sha256));
  }

  void files() {
    out_ += "<h2>Files</h2>\n<table class=\"files\">\n<thead><tr><th>Side</th><th>File</th><th "
            "class=\"number\">Bytes</th>"
            "<th>SHA-256</th></tr></thead>\n";
    for (const VerifyDocument::File& one : d_.inputs)
      file(one, "source");
    if (d_.translation) file(*d_.translation, d_.edited ? "translation, edited" : "translation");
    out_ += "</table>\n";
  }

  void counts(std::string_view name, const VerifyDocument::Counts& counts) {
    out_ += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n", name,
                        counts.all, counts.agree, counts.differ, counts.undecided, counts.refused);
  }

  void cases() {
    out_ += "<h2>Cases</h2>\n<table "
            "class=\"counts\">\n<thead><tr><th>Cases</th><th>All</th><th>Agree</th><th>Differ"
            "</th><th>Undecided</th><th>Refused</th></tr></thead>\n";
    counts("drawn", d_.cases);
    if (d_.edges.all > 0) counts("edge", d_.edges);
    out_ += "</table>\n<p class=\"count\">";
    out_ += text(fmt::format("Seed {}. At least {} % of the drawn cases have to agree, and none may differ.",
                             d_.seed, numberText(d_.minAgreed)));
    if (d_.edges.all > 0)
      out_ +=
          " Edge cases have values at and beyond the limits of the checks; one that is refused is stopped by "
          "an alarm of the translation before anything moves.";
    out_ +=
        "</p>\n<p class=\"count\">The same report:</p><pre class=\"replay\">" + text(d_.command) + "</pre>\n";
  }

  void side(std::string_view name, const VerifyDocument::Excerpt& excerpt) {
    if (excerpt.line == 0) return;
    out_ += fmt::format("<div class=\"side\"><h4>{}: {}, line {}</h4><pre>", name, text(excerpt.file),
                        excerpt.line);
    for (std::size_t i = 0; i < excerpt.lines.size(); ++i) {
      const auto number = excerpt.first + static_cast<std::uint32_t>(i);
      out_ += fmt::format("<span{}><i>{}</i>{}</span>", number == excerpt.line ? " class=\"here\"" : "",
                          number, text(excerpt.lines[i]));
    }
    out_ += "</pre></div>\n";
  }

  void differences() {
    if (d_.differences.empty()) return;
    out_ += "<h2>Differences</h2>\n";
    std::size_t number = 0;
    for (const VerifyDocument::Difference& one : d_.differences) {
      out_ += fmt::format("<section class=\"difference{}\"><h3>{}. {}: {}</h3>\n", one.edge ? " edge" : "",
                          ++number, text(one.pair), text(one.aspect));
      out_ += fmt::format("<p>{}. <span class=\"count\">In {} of {} {} cases.</span></p>\n", prose(one.text),
                          one.cases, one.of, one.edge ? "edge" : "drawn");
      out_ += "<div class=\"sides\">";
      side("Source", one.source);
      side("Post", one.post);
      side("Translation", one.translation);
      out_ += "</div>\n<p class=\"count\">The smallest case that shows it:</p><pre class=\"replay\">" +
              text(one.replay) + "</pre>\n</section>\n";
    }
  }

  void undecided() {
    if (d_.undecided.empty()) return;
    out_ += "<h2>Undecided cases</h2>\n<table class=\"reasons\">\n<thead><tr><th "
            "class=\"number\">Cases</th><th>Why</th><th>Where</th></tr>"
            "</thead>\n";
    for (const VerifyDocument::Reason& one : d_.undecided) {
      std::string why = (one.edge ? "at an edge: " : "") + prose(one.why);
      if (!one.remedy.empty()) why += prose("; " + one.remedy + " fixes what this check reads");
      std::string where;
      if (one.at.line != 0) {
        const std::size_t at = one.at.line - one.at.first;
        where = fmt::format("{}, line {}<br><code>{}</code>", text(one.at.file), one.at.line,
                            at < one.at.lines.size() ? text(one.at.lines[at]) : "");
      }
      out_ +=
          fmt::format("<tr><td class=\"number\">{}</td><td>{}</td><td>{}</td></tr>\n", one.cases, why, where);
    }
    out_ += "</table>\n";
  }

  void findings(std::string_view about, std::string_view title) {
    bool any = false;
    for (const VerifyDocument::Finding& one : d_.findings) {
      if (one.about != about) continue;
      if (!std::exchange(any, true)) {
        out_ += fmt::format("<h2>{}</h2>\n", title);
        if (const std::string_view lead = leadOf(about); !lead.empty())
          out_ += fmt::format("<p>{}</p>\n", lead);
        out_ += "<ul>\n";
      }
      out_ += fmt::format("<li>{}{}: {} <span class=\"count\">[{}]</span></li>\n",
                          one.line == 0 ? "" : text(fmt::format("{}, line {}: ", one.file, one.line)),
                          text(one.severity), prose(one.message), text(one.code));
    }
    if (any) out_ += "</ul>\n";
  }

  void picture() {
    if (!d_.pictures.empty()) out_ += "<h2>One case</h2>\n";
    for (std::size_t i = 0; i < d_.pictures.size(); ++i) {
      std::string svg = sim::pictureSvg(d_.pictures[i].picture);
      if (const std::size_t at = svg.find("<svg"); at != std::string::npos) svg.erase(0, at);
      if (i > 0) svg = withOwnNames(std::move(svg));
      out_ += "<figure>" + svg + "<figcaption>" + text(d_.pictures[i].caption) + "</figcaption></figure>\n";
    }
  }

  // A page has each name once.
  static std::string withOwnNames(std::string svg) {
    for (const std::string_view before : {" id=\"", "url(#"})
      for (std::size_t at = 0; (at = svg.find(before, at)) != std::string::npos;) {
        at += before.size();
        svg.insert(at, "other-");
      }
    return svg;
  }

  const VerifyDocument& d_;
  std::string out_;
};

} // namespace

std::string htmlOf(const VerifyDocument& document) {
  return Page(document).run();
}

} // namespace dotek::targets
