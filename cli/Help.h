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

// Those that users need, as they were when the program was built, sorted by name. Generated.
std::span<const HelpPage> helpPages();

// What `dotek help TOPIC` prints: the page of that name, else the section of a command in cli.md; "": there
// is neither.
std::string helpOn(std::string_view topic);

// Each page with its title, a line each.
std::string helpTopics();

// Examples of a command, which run where examples/ is, and where its page is; "": no command of this name.
std::string helpFooter(std::string_view command);

// Topics for a proposal where one is misspelt.
std::vector<std::string> helpTopicNames();

} // namespace dotek::cli
