#include "lint/Catalog.h"

#include "lint/Page.h"
#include "support/Wrap.h"

#include <algorithm>
#include <array>

namespace dotek::lint {
namespace {

constexpr std::string_view kRepair = "Repair: ";
constexpr std::array<std::string_view, 6> kAreas = {
    "NC programs (macro B)",         "Programs of Mikroprog",  "Posts (ComPost)",
    "Macros and dialogs (GibbsCAM)", "Cycles with their post", "Posts of Fusion",
};

std::string_view takeLine(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

void append(std::string& to, std::string_view line, char between) {
  if (!to.empty()) to += between;
  to += line;
}

// The lines below `## code` of the page of its group.
std::string_view sectionOf(std::string_view code) {
  const std::string heading = "\n## " + std::string(code) + "\n";
  for (const MessagePage& page : messagePages()) {
    const std::size_t at = page.text.find(heading);
    if (at == std::string_view::npos) continue;
    const std::string_view rest = page.text.substr(at + heading.size());
    return rest.substr(0, std::min(rest.find("\n## "), rest.size()));
  }
  return {};
}

Explained ofMessage(const CodeInfo& info) {
  Explained out;
  std::string_view section = sectionOf(info.code);
  std::string paragraph;
  const auto end = [&] {
    if (paragraph.starts_with(kRepair))
      out.repair = paragraph.substr(kRepair.size());
    else if (!paragraph.empty())
      append(out.why, paragraph, '\n');
    paragraph.clear();
  };
  while (!section.empty()) {
    const std::string_view line = takeLine(section);
    if (line.starts_with("    ")) {
      append(out.example, line.substr(4), '\n');
    } else if (line.empty()) {
      end();
    } else {
      append(paragraph, line, ' ');
    }
  }
  end();
  if (out.why.empty()) out.why = info.explanation;
  return out;
}

Explained ofRule(const CodeInfo& info) {
  Explained out;
  const std::string_view page = pageOf(info.code);
  const std::string prose = proseOf(page);
  for (std::string_view left = prose; !left.empty();) {
    const std::string_view line = takeLine(left);
    if (line.starts_with(kRepair))
      out.repair = line.substr(kRepair.size());
    else
      append(out.why, line, '\n');
  }
  std::string_view left = page.substr(std::min(page.find("\n## Reported\n"), page.size()));
  bool inside = false;
  while (!left.empty()) {
    const std::string_view line = takeLine(left);
    if (line.starts_with("```")) {
      if (inside) break;
      inside = true;
    } else if (inside && line.find_first_not_of(" ^") != std::string_view::npos) {
      append(out.example, line, '\n');
    }
  }
  return out;
}

// "error   a-code  .." with the mark of a rule that is off.
std::string described(const NamedRule& rule) {
  const CodeInfo info{rule.id, rule.rule->severity, rule.rule->byDefault, rule.rule, {}};
  return summaryOf(info);
}

} // namespace

Explained explained(const CodeInfo& info) {
  return info.rule != nullptr ? ofRule(info) : ofMessage(info);
}

std::string helpOf(const CodeInfo& info) {
  if (info.rule != nullptr) return shownPage(pageOf(info.code));
  const Explained parts = explained(info);
  std::string out;
  for (std::string_view left = parts.why; !left.empty();)
    out += (out.empty() ? "" : "\n") + wrapped(takeLine(left));
  if (!parts.example.empty()) {
    out += "\nExample:\n\n";
    for (std::string_view left = parts.example; !left.empty();)
      out += "    " + std::string(takeLine(left)) + "\n";
  }
  if (!parts.repair.empty()) out += "\n" + wrapped(std::string(kRepair) + parts.repair);
  return out;
}

std::string helpMarkdownOf(const CodeInfo& info) {
  const Explained parts = explained(info);
  std::string out;
  for (std::string_view left = parts.why; !left.empty();)
    out += std::string(takeLine(left)) + "\n\n";
  if (!parts.example.empty()) out += "```\n" + parts.example + "\n```\n\n";
  if (!parts.repair.empty()) out += "**Repair:** " + parts.repair + "\n";
  return out;
}

std::span<const std::string_view> areas() {
  return kAreas;
}

std::string_view areaOf(const NamedRule& rule) {
  const std::string_view page = pageOf(rule.id);
  const auto has = [&](std::string_view fence) {
    return page.find("\n```" + std::string(fence)) != std::string_view::npos;
  };
  const bool macros = has("gibbs") || has("text DefineData") || has("text c/") ||
                      page.find("DefineData.txt\n") != std::string_view::npos;
  if (has("js")) return kAreas[5];
  if (has("suf")) return kAreas[1];
  if (has("nc") && !has("compost") && !has("gibbs")) return kAreas[0];
  if (has("compost")) return macros ? kAreas[4] : kAreas[2];
  return kAreas[3];
}

namespace {

// The page of a rule whose finding carries a safe repair says so.
bool repairs(const NamedRule& rule) {
  return pageOf(rule.id).find("`--fix`") != std::string_view::npos;
}

} // namespace

std::string ruleList() {
  std::size_t width = 0;
  for (const NamedRule& rule : rules())
    width = std::max(width, rule.id.size());
  std::string out;
  for (const std::string_view area : areas()) {
    out += (out.empty() ? "" : "\n") + std::string(area) + "\n";
    for (const NamedRule& rule : rules())
      if (areaOf(rule) == area)
        out += fmt::format("  {:<{}}  {:<7}  {}{}{}\n", rule.id, width, severityName(rule.rule->severity),
                           rule.rule->byDefault ? "" : "(off unless it is selected) ", described(rule),
                           repairs(rule) ? " --fix repairs it." : "");
  }
  return out;
}

std::string rulesReadme() {
  std::string out = "# Rules of `dotek lint`\n\nGenerated from the pages beside this file: `./dev test "
                    "--update` writes it anew. "
                    "[../lint.md](../lint.md) says how\nrules are chosen and suppressed; `dotek explain "
                    "CODE` prints a page.\n";
  for (const std::string_view area : areas()) {
    out += fmt::format("\n## {}\n\n| rule | severity | what it reports |\n|---|---|---|\n", area);
    for (const NamedRule& rule : rules()) {
      if (areaOf(rule) != area) continue;
      std::string text = described(rule);
      for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
        text.insert(at, 1, '\\');
      out += fmt::format("| [{0}]({0}.md) | {1}{2} | {3} |\n", rule.id, severityName(rule.rule->severity),
                         rule.rule->byDefault ? "" : ", off by default", text);
    }
  }
  return out;
}

} // namespace dotek::lint
