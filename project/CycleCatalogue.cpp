#include "project/CycleCatalogue.h"
#include "project/CycleDeeds.h"

#include "frontend/cycle/Link.h"
#include "frontend/cycle/Parse.h"
#include "support/Printable.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::project {

namespace cycle = frontend::cycle;

namespace {

std::string kindOf(const cycle::Type& type) {
  std::string out(typeText(type.name));
  for (std::size_t i = 0; i < type.choices.size(); ++i)
    out += (i == 0 ? " of " : ", ") + type.choices[i].text;
  return out;
}

std::string asked(const std::optional<cycle::Text>& message, const std::string& condition) {
  return message ? fmt::format("`{}` (alarm: {})", condition, message->text) : fmt::format("`{}`", condition);
}

void parameter(const cycle::Parameter& parameter, CyclePage& page) {
  CyclePage::Row row;
  row.kind = kindOf(parameter.type);
  row.initial = parameter.value != nullptr ? layOut(*parameter.value)
                : parameter.optional       ? "may be left out"
                                           : "required";
  if (parameter.title) row.meaning = parameter.title->text;
  for (const cycle::Clause& clause : parameter.clauses) {
    switch (clause.kind) {
    case cycle::Clause::Kind::Require:
      row.condition = layOut(*clause.first);
      page.refusals.push_back(asked(clause.text, row.condition));
      break;
    case cycle::Clause::Kind::Range:
      row.condition = fmt::format("{} to {}", layOut(*clause.first), layOut(*clause.second));
      for (const cycle::Name& name : parameter.names)
        page.refusals.push_back(fmt::format("`{}` is within {}", name.text, row.condition));
      break;
    case cycle::Clause::Kind::Group: row.group = clause.text->text; break;
    case cycle::Clause::Kind::Letter: row.letter = clause.letter->text; break;
    case cycle::Clause::Kind::Picture: break;
    }
  }
  for (const cycle::Name& name : parameter.names) {
    row.name = name.text;
    page.parameters.push_back(row);
  }
}

std::string firstSentence(const std::string& text) {
  const std::size_t end = text.find(". ");
  return end == std::string::npos ? text : text.substr(0, end + 1);
}

} // namespace

std::string fileStem(const std::string& cycle) {
  std::string out = cycle;
  std::replace(out.begin(), out.end(), '_', '-');
  return out;
}

CyclePage cyclePage(const cycle::File& file) {
  CyclePage page;
  if (const cycle::Header* header = file.header()) {
    page.name = header->name.text;
    page.title = header->title ? header->title->text : header->name.text;
    page.options = header->options;
  }
  for (const cycle::Statement& statement : file.body.statements) {
    if (std::holds_alternative<cycle::Header>(statement.node))
      for (const cycle::Comment& comment : statement.before)
        page.description +=
            (page.description.empty() ? "" : " ") +
            comment.text.substr(std::min(comment.text.find_first_not_of(' '), comment.text.size()));
    if (std::holds_alternative<cycle::Needs>(statement.node)) page.helper = true;
  }
  page.helper = page.helper || page.description.find("for other cycles") != std::string::npos;
  for (const cycle::Statement* one : cycle::declarations(file)) {
    if (const auto* declared = std::get_if<cycle::Parameter>(&one->node)) parameter(*declared, page);
    if (const auto* require = std::get_if<cycle::Require>(&one->node))
      page.refusals.push_back(asked(require->message, layOut(*require->condition)));
    if (const auto* result = std::get_if<cycle::Result>(&one->node))
      for (const cycle::Name& name : result->names)
        page.results.push_back(
            {name.text, kindOf(result->type), "", "", result->title ? result->title->text : "", "", ""});
  }
  addDeeds(file, page);
  std::string arguments;
  for (const CyclePage::Row& row : page.parameters)
    if (row.initial == "required") arguments += (arguments.empty() ? " " : ", ") + row.name + " = ..";
  page.example = page.options ? "use " + page.name
                              : "call " + page.name + arguments + (page.results.empty() ? "" : " -> it");
  return page;
}

// ---- Markdown --------------------------------------------------------------------------------------------

namespace {

std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.insert(at, 1, '\\');
  return text;
}

std::string code(const std::string& text) {
  return text.empty() ? "" : "`" + cell(text) + "`";
}

void list(std::string& out, const char* head, const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  out += fmt::format("\n## {}\n\n", head);
  for (const std::string& line : lines)
    out += "- " + line + "\n";
}

bool isElsewhere(const CyclePage& page, const std::string& name) {
  return std::find(page.elsewhere.begin(), page.elsewhere.end(), name) != page.elsewhere.end();
}

std::vector<std::string> alarmLines(const CyclePage& page) {
  std::vector<std::string> out = page.alarms;
  if (page.meetStops) out.insert(out.begin(), "A protected move that meets something");
  if (page.missStops) out.insert(out.begin(), "A touch that finds nothing within the overtravel");
  return out;
}

} // namespace

std::string markdown(const CyclePage& page) {
  std::string out = fmt::format("# {}\n\n{}\n\n    {}\n", page.title, page.description, page.example);
  if (!page.parameters.empty()) {
    out += "\n## Parameters\n\n| name | kind | default | letter | meaning | condition "
           "|\n|---|---|---|---|---|---|\n";
    for (const CyclePage::Row& row : page.parameters)
      out += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", row.name, row.kind, cell(row.initial),
                         row.letter, cell(row.meaning), code(row.condition));
  }
  if (!page.results.empty()) {
    out += "\n## Results\n\n| name | kind | meaning |\n|---|---|---|\n";
    for (const CyclePage::Row& row : page.results)
      out += fmt::format("| `{}` | {} | {} |\n", row.name, row.kind, cell(row.meaning));
  }
  list(out, "Sets", page.sets);
  list(out, "Refused before anything moves, unless", page.refusals);
  list(out, "Alarms while it runs", alarmLines(page));
  std::vector<std::string> calls;
  for (const std::string& name : page.calls)
    calls.push_back(isElsewhere(page, name) ? fmt::format("`{}` (no page here)", name)
                                            : fmt::format("[{}]({}.md)", name, fileStem(name)));
  list(out, "Calls", calls);
  return printableLines(out);
}

std::string markdownIndex(const std::vector<CyclePage>& pages) {
  std::string out = "# Cycles\n";
  const auto part = [&](const char* head, auto wanted) {
    std::string rows;
    for (const CyclePage& page : pages)
      if (wanted(page))
        rows += fmt::format("| [{}]({}.md) | {} | {} |\n", page.name, fileStem(page.name), cell(page.title),
                            cell(firstSentence(page.description)));
    if (!rows.empty())
      out += fmt::format("\n{}| name | title | what it does |\n|---|---|---|\n{}", head, rows);
  };
  part("", [](const CyclePage& page) { return !page.options && !page.helper; });
  part("## Parts of other cycles\n\n", [](const CyclePage& page) { return !page.options && page.helper; });
  part("## Options that cycles share\n\n", [](const CyclePage& page) { return page.options; });
  return printableLines(out);
}

// ---- HTML ------------------------------------------------------------------------------------------------

namespace {

std::string escaped(const std::string& text) {
  std::string out;
  bool inCode = false;
  for (const char c : text) {
    switch (c) {
    case '&': out += "&amp;"; break;
    case '<': out += "&lt;"; break;
    case '>': out += "&gt;"; break;
    case '"': out += "&quot;"; break;
    case '`':
      out += inCode ? "</code>" : "<code>";
      inCode = !inCode;
      break;
    default: out += c;
    }
  }
  return inCode ? out + "</code>" : out;
}

std::string document(const std::string& title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width\">\n<title>" +
         escaped(title) +
         "</title>\n<style>\n"
         "body { font: 16px/1.5 sans-serif; max-width: 60em; margin: 2em auto; padding: 0 1em; color: "
         "#20262d; background: #fff; }\n"
         "table { border-collapse: collapse; width: 100%; } th, td { text-align: left; vertical-align: top;\n"
         "  padding: .3em .8em .3em 0; border-bottom: 1px solid #cfd5dc; } th { color: #4a525c; }\n"
         "code, pre { font-family: monospace; background: #f2f4f6; } pre { padding: .6em; overflow-x: auto; "
         "}\n"
         "a { color: #0a529a; }\n</style>\n" +
         body + "</html>\n";
}

std::string tableRow(const std::vector<std::string>& cells, const char* tag) {
  std::string out = "<tr>";
  for (const std::string& one : cells)
    out += fmt::format("<{0}>{1}</{0}>", tag, escaped(one));
  return out + "</tr>\n";
}

void htmlList(std::string& out, const char* head, const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  out += fmt::format("<h2>{}</h2>\n<ul>\n", head);
  for (const std::string& line : lines)
    out += "<li>" + escaped(line) + "</li>\n";
  out += "</ul>\n";
}

std::string quoted(const std::string& text) {
  return text.empty() ? text : "`" + text + "`";
}

} // namespace

std::string html(const CyclePage& page) {
  std::string out = "<p><a href=\"index.html\">All cycles</a></p>\n";
  out += fmt::format("<h1>{}</h1>\n<p>{}</p>\n<pre>{}</pre>\n", escaped(page.title),
                     escaped(page.description), escaped(page.example));
  if (!page.parameters.empty()) {
    out += "<h2>Parameters</h2>\n<table>\n" +
           tableRow({"name", "kind", "default", "letter", "meaning", "condition"}, "th");
    for (const CyclePage::Row& row : page.parameters)
      out += tableRow(
          {quoted(row.name), row.kind, row.initial, row.letter, row.meaning, quoted(row.condition)}, "td");
    out += "</table>\n";
  }
  if (!page.results.empty()) {
    out += "<h2>Results</h2>\n<table>\n" + tableRow({"name", "kind", "meaning"}, "th");
    for (const CyclePage::Row& row : page.results)
      out += tableRow({quoted(row.name), row.kind, row.meaning}, "td");
    out += "</table>\n";
  }
  htmlList(out, "Sets", page.sets);
  htmlList(out, "Refused before anything moves, unless", page.refusals);
  htmlList(out, "Alarms while it runs", alarmLines(page));
  if (!page.calls.empty()) {
    out += "<h2>Calls</h2>\n<ul>\n";
    for (const std::string& name : page.calls)
      out += isElsewhere(page, name)
                 ? fmt::format("<li><code>{}</code> (no page here)</li>\n", escaped(name))
                 : fmt::format("<li><a href=\"{}.html\">{}</a></li>\n", fileStem(name), escaped(name));
    out += "</ul>\n";
  }
  return document(page.title, out);
}

std::string htmlIndex(const std::vector<CyclePage>& pages) {
  std::string out = "<h1>Cycles</h1>\n";
  const auto part = [&](const char* head, auto wanted) {
    std::string rows;
    for (const CyclePage& page : pages)
      if (wanted(page))
        rows += fmt::format("<tr><td><a href=\"{}.html\">{}</a></td><td>{}</td><td>{}</td></tr>\n",
                            fileStem(page.name), escaped(page.name), escaped(page.title),
                            escaped(firstSentence(page.description)));
    if (!rows.empty())
      out += head + std::string("<table>\n") + tableRow({"name", "title", "what it does"}, "th") + rows +
             "</table>\n";
  };
  part("", [](const CyclePage& page) { return !page.options && !page.helper; });
  part("<h2>Parts of other cycles</h2>\n",
       [](const CyclePage& page) { return !page.options && page.helper; });
  part("<h2>Options that cycles share</h2>\n", [](const CyclePage& page) { return page.options; });
  return document("Cycles", out);
}

} // namespace dotek::project
