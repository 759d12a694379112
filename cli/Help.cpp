#include "cli/Help.h"

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
     "dotek run-post shop.cps --matrix drilling",
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
    {"init", "dotek init --control fanuc-31i-b", "init"},
    {"explain", "dotek explain open-if-at-return", "diagnostics"},
    {"list", "dotek list controls\ndotek list controls fanuc-31i-b", "explain"},
    {"check", "dotek check examples/cycles/bore.cycle", "cycles"},
    {"fmt", "dotek fmt examples/cycles/bore.cycle --check", "cycles"},
    {"doc", "dotek doc examples/cycles -o pages", "cycles"},
    {"preview", "dotek preview examples/surface-x -o dialog.html", "preview"},
    {"lsp", "", "editor"},
    {"outline", "dotek outline examples/macros/bore.nc", "outline"},
    {"renumber", "dotek renumber examples/macros/bore.nc --start 10 --step 10 -o O9110.nc", "renumber"},
    {"flatten", "", "flatten"},
    {"help", "dotek help cycles\ndotek help tutorials/my-first-cycle", "help"},
};

std::string_view topicOf(const HelpPage& page) {
  return page.name.substr(0, page.name.size() - std::string_view(".md").size());
}

std::string_view lineAt(std::string_view text, std::size_t at) {
  return text.substr(at, text.find('\n', at) - at);
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
  if (topic.ends_with(".md")) topic.remove_suffix(3);
  if (topic.starts_with("docs/")) topic.remove_prefix(5);
  for (const HelpPage& page : helpPages()) {
    const std::string_view name = topicOf(page);
    if (name == topic || name == fmt::format("tutorials/{}", topic)) return std::string(page.text);
  }
  for (const HelpPage& page : helpPages())
    if (topicOf(page) == "cli") return sectionOf(page.text, topic);
  return "";
}

std::string helpTopics() {
  std::string out = "Pages, `dotek help TOPIC`:\n";
  for (const HelpPage& page : helpPages()) {
    const std::string_view title = lineAt(page.text, 0);
    out += fmt::format("  {:<27} {}\n", topicOf(page),
                       title.substr(std::min(title.find(' ') + 1, title.size())));
  }
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
  for (const CommandHelp& one : kCommands)
    out.emplace_back(one.name);
  return out;
}

} // namespace dotek::cli
