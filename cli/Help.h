// Pages of docs/ in the program, and what the help of a command adds to its flags.
#pragma once

#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::cli {

struct HelpPage {
  std::string_view name; // "cycles.md", "tutorials/my-first-cycle.md"
  std::string_view text;
};

// As they were when the program was built, sorted by name; without those of rules and messages. Generated.
std::span<const HelpPage> helpPages();

// What `dotek help TOPIC` prints: the page of that name, one that the program makes, else the section of a
// command in cli.md; "": there is neither, or it is that of commands.
std::string helpOn(std::string_view topic);

// The topic whose page is the help of each command.
constexpr std::string_view kCommandsTopic = "commands";
struct CommandFlagsText {
  std::string name, text;
};
std::string commandsPage(std::string_view overview, std::span<const CommandFlagsText> commands);

// Each page with its title, a line each.
std::string helpTopics();

// Examples of a command, which run where examples/ is, and where its page is; "": no command of this name.
std::string helpFooter(std::string_view command);

// Topics for a proposal where one is misspelt.
std::vector<std::string> helpTopicNames();

} // namespace dotek::cli
