#include "cli/Help.h"

#include "driver/Driver.h"
#include "driver/Facts.h"
#include "lint/Catalog.h"
#include "lint/Page.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace dotek::cli {
namespace {

struct CommandHelp {
  std::string_view name;
  std::string_view examples; // a line each
  std::string_view page;     // topic of `dotek help`
};

constexpr CommandHelp kCommands[] = {
    {"post",
     "dotek post examples/surface-x --prog examples/post.txt --routine probe --clearance 5 --set G=54",
     "post"},
    {"run-post",
     "dotek convert examples/surface-x --prog examples/post.txt --to fusion --whole-post -o shop.cps\n"
     "dotek run-post shop.cps --matrix drilling\n"
     "dotek new post --from examples/s280-post.toml -o s280.cps\n"
     "dotek run-post s280.cps examples/s280-job.toml --check --control mikroprog-s280 \\\n"
     "          --property stopCondition=O20",
     "run-post"},
    {"convert",
     "dotek convert examples/surface-x --prog examples/post.txt --to fanuc --verify -o O8000.nc\n"
     "dotek convert examples/macros/web.nc --to fanuc --from-control fanuc-0i-md --control fanuc-31i-b",
     "convert"},
    {"lint", "dotek lint examples\ndotek lint examples --format sarif --fail-on error", "lint"},
    {"dump", "dotek dump examples/surface-x/ToolPath.mac --stage ast", "dump"},
    {"sim",
     "dotek sim examples/macros/bore.nc --call \"D30. Z-5. S55\" --part examples/macros/plate.toml \\\n"
     "          --machine examples/macros/mill.toml --at 30,40,10 --var 520=5.97 --html bore.html",
     "sim"},
    {"verify", "dotek verify examples/surface-x --prog examples/post.txt --to fanuc --cases 100", "verify"},
    {"new", "dotek new cycle edge -o edge.cycle", "new"},
    {"new form", "dotek new form shop --prog examples/post.txt -o shop.toml", "data-files"},
    {"new control", "dotek new control mill --from fanuc-31i-b --probe-on M31 --probe-off M32 -o mill.toml",
     "data-files"},
    {"new job",
     "dotek convert examples/surface-x --prog examples/post.txt --to fusion --whole-post -o shop.cps\n"
     "dotek new job --from shop.cps -o job.toml",
     "run-post"},
    {"new post", "dotek new post --from examples/s280-post.toml -o s280.cps", "fusion-lathe"},
    {"new cycle", "dotek new cycle edge -o edge.cycle", "tutorials/my-first-cycle"},
    {"new macros", "dotek new macros dotek -o macros.nc", "convert"},
    {"init", "dotek init --control fanuc-31i-b", "init"},
    {"explain", "dotek explain open-if-at-return", "diagnostics"},
    {"list", "dotek list controls\ndotek list controls fanuc-31i-b", "explain"},
    {"check", "dotek check examples/cycles/bore.cycle", "cycles"},
    {"fmt", "dotek fmt examples/cycles/bore.cycle --check", "cycles"},
    {"doc", "dotek doc examples/cycles -o pages", "cycles"},
    {"preview", "dotek preview examples/surface-x -o dialog.html", "preview"},
    {"lsp", "nvim --cmd \"luafile editors/nvim/dotek.lua\" examples/macros/bore.nc", "editor"},
    {"outline", "dotek outline examples/macros/bore.nc", "outline"},
    {"renumber", "dotek renumber examples/macros/bore.nc --start 10 --step 10 -o O9110.nc", "renumber"},
    {"flatten",
     "dotek flatten examples/macros/bore.nc --call \"D30. Z-5. S55\" --part examples/macros/plate.toml \\\n"
     "          --machine examples/macros/mill.toml --at 30,40,10 --var 520=5.97 -o flat.nc",
     "flatten"},
    {"help", "dotek help cycles\ndotek help tutorials/my-first-cycle", "help"},
};

std::string_view withoutSuffix(std::string_view name) {
  constexpr std::string_view kSuffix = ".md";
  return name.ends_with(kSuffix) ? name.substr(0, name.size() - kSuffix.size()) : name;
}

std::string_view topicOf(const HelpPage& page) {
  return withoutSuffix(page.name);
}

std::string_view lineAt(std::string_view text, std::size_t at) {
  return text.substr(at, text.find('\n', at) - at);
}

// "# Title" -> "Title"; a schema's is its member `title`.
std::string_view titleOf(std::string_view text) {
  constexpr std::string_view kMember = "\"title\": \"";
  if (const std::size_t at = text.find(kMember); text.starts_with("{"))
    return at == std::string_view::npos
               ? ""
               : lineAt(text, at + kMember.size())
                     .substr(0, text.find('"', at + kMember.size()) - at - kMember.size());
  const std::string_view line = lineAt(text, 0);
  return line.substr(std::min(line.find(' ') + 1, line.size()));
}

// Pages that docs/ does not hold: what the program says of itself.
struct MadePage {
  std::string_view name, title;
};
constexpr MadePage kMade[] = {
    {kCommandsTopic, "Commands"}, {"controls", "Controls"}, {"cycles-library", "Cycles of the library"},
    {"messages", "Messages"},     {"rules", "Rules"},
};

std::string indented(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::string_view line = lineAt(text, 0);
    out += line.empty() ? "\n" : fmt::format("    {}\n", line);
    text.remove_prefix(std::min(line.size() + 1, text.size()));
  }
  return out;
}

// The table of all, and what is known of each. Those of Mikroprog have a page of their own.
std::string controlsPage() {
  const std::string all = driver::list("controls", {}).output;
  std::string out = "# Controls\n\n" + indented(all);
  for (std::string_view rest = all; !rest.empty();) {
    const std::string_view line = lineAt(rest, 0);
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    const std::string name(line.substr(0, line.find(' ')));
    if (!name.starts_with("mikroprog"))
      out += fmt::format("\n## {}\n\n{}", name, indented(driver::listFacts("controls", name, {}).output));
  }
  return out;
}

std::string messagesPage() {
  std::string out =
      "# Messages\n\n`dotek help messages/NAME` prints an example and the repair of each message of "
      "a group, `dotek explain CODE` those of one.\n\n";
  for (const lint::MessagePage& page : lint::messagePages())
    out += fmt::format("    {:<20} {}\n", fmt::format("messages/{}", withoutSuffix(page.name)),
                       titleOf(page.text));
  return out;
}

// "": the topic is no such page.
std::string madePage(std::string_view topic) {
  if (topic == "controls") return controlsPage();
  if (topic == "cycles-library") return "# Cycles of the library\n\n" + driver::catalogue({}).output;
  if (topic == "messages") return messagesPage();
  if (topic == "rules" || topic == "rules/README") return lint::rulesReadme();
  constexpr std::string_view kRules = "rules/", kMessages = "messages/";
  if (topic.starts_with(kRules)) return std::string(lint::pageOf(topic.substr(kRules.size())));
  if (topic.starts_with(kMessages))
    for (const lint::MessagePage& page : lint::messagePages())
      if (withoutSuffix(page.name) == topic.substr(kMessages.size())) return std::string(page.text);
  return "";
}

bool titleNames(std::string_view title, std::string_view word) {
  while (!title.empty()) {
    const std::size_t end = std::min(title.find(", "), title.size());
    if (title.substr(0, end) == word) return true;
    title.remove_prefix(std::min(end + 2, title.size()));
  }
  return false;
}

// The section of a command, of `## explain, list` that of both.
std::string sectionOf(std::string_view page, std::string_view command) {
  for (std::size_t at = page.find("\n## "); at != std::string_view::npos; at = page.find("\n## ", at + 1)) {
    if (!titleNames(lineAt(page, at + 4), command)) continue;
    return std::string(page.substr(at + 1, page.find("\n## ", at + 1) - at));
  }
  return "";
}

} // namespace

std::string helpOn(std::string_view topic) {
  topic = withoutSuffix(topic);
  if (topic.starts_with("docs/")) topic.remove_prefix(5);
  for (const HelpPage& page : helpPages()) {
    const std::string_view name = topicOf(page);
    if (name == topic || name == fmt::format("tutorials/{}", topic)) return std::string(page.text);
  }
  if (std::string made = madePage(topic); !made.empty()) return made;
  for (const HelpPage& page : helpPages())
    if (topicOf(page) == "cli") return sectionOf(page.text, topic);
  return "";
}

std::string commandsPage(std::string_view overview, std::span<const CommandFlagsText> commands) {
  std::string out = "# Commands\n\n" + indented(overview);
  for (const CommandFlagsText& one : commands)
    out += fmt::format("\n## {}\n\n{}", one.name, indented(one.text));
  return out;
}

std::string helpTopics() {
  std::string out = "Pages, `dotek help TOPIC`:\n";
  for (const HelpPage& page : helpPages())
    out += fmt::format("  {:<28} {}\n", topicOf(page), titleOf(page.text));
  out += "Made by the program:\n";
  for (const MadePage& page : kMade)
    out += fmt::format("  {:<28} {}\n", page.name, page.title);
  out += "  rules/RULE                   one rule\n"
         "  messages/GROUP               messages of one group\n";
  return out + "`dotek COMMAND --help` prints the flags of a command.\n";
}

std::string helpFooter(std::string_view command) {
  const auto* const found = std::find_if(std::begin(kCommands), std::end(kCommands),
                                         [&](const CommandHelp& one) { return one.name == command; });
  if (found == std::end(kCommands)) return "";
  std::string out;
  if (!found->examples.empty()) {
    out = "Examples:\n";
    for (std::size_t at = 0; at < found->examples.size();) {
      const std::string_view line = lineAt(found->examples, at);
      out += fmt::format("  {}\n", line);
      at += line.size() + 1;
    }
    out += "\n";
  }
  const bool own = std::any_of(helpPages().begin(), helpPages().end(),
                               [&](const HelpPage& page) { return topicOf(page) == found->page; });
  return out + fmt::format("More: `dotek help {}` (docs/{}.md)", found->page, own ? found->page : "cli");
}

std::vector<std::string> helpTopicNames() {
  std::vector<std::string> out;
  for (const HelpPage& page : helpPages())
    out.emplace_back(topicOf(page));
  for (const MadePage& page : kMade)
    out.emplace_back(page.name);
  for (const CommandHelp& one : kCommands)
    out.emplace_back(one.name);
  return out;
}

} // namespace dotek::cli
