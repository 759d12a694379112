// The page of a rule, docs/rules/<id>.md: its one explanation, embedded at build, and its test.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace dotek::lint {

struct RulePage {
  std::string_view name; // "ID.md"
  std::string_view text;
};

// As they were when the program was built, sorted by name. Generated.
std::span<const RulePage> rulePages();

// The whole page; "": no rule has this id.
std::string_view pageOf(std::string_view id);

// What the page says before its examples: paragraphs of one line each, without the severity that begins it.
std::string proseOf(std::string_view page);

// The first sentence of a text. A point ends one where a blank and a capital, a code or nothing follow.
std::string firstSentence(std::string_view text);

// The page for a terminal: prose at 90 columns, headings, each example below its title with its flags and
// files.
std::string shownPage(std::string_view page);

} // namespace dotek::lint
