// Rules and messages as people look them up: the lists, what `explain` prints, the README of docs/rules.
#pragma once

#include "lint/Rule.h"

#include <span>
#include <string>
#include <string_view>

namespace dotek::lint {

// docs/messages/<group>.md: an example and the repair of each message, and why it matters where the table of
// messages does not say it.
struct MessagePage {
  std::string_view name; // "GROUP.md"
  std::string_view text;
};
// As they were when the program was built, sorted by name. Generated.
std::span<const MessagePage> messagePages();

// The parts of an explanation.
struct Explained {
  std::string why;     // paragraphs of one line each
  std::string example; // lines; of a rule the first one of its page that is reported, without carets
  std::string repair;  // without the word `Repair:`
};
Explained explained(const CodeInfo& info);

// What `explain` prints below the code: of a rule its page, of a message the parts, at 90 columns.
std::string helpOf(const CodeInfo& info);
// The same as Markdown, for SARIF.
std::string helpMarkdownOf(const CodeInfo& info);

// What kind of file a rule judges, by the examples of its page: the headings of lists, in their order.
std::span<const std::string_view> areas();
std::string_view areaOf(const NamedRule& rule);

// `list rules`: by area, a line each.
std::string ruleList();
// docs/rules/README.md.
std::string rulesReadme();

} // namespace dotek::lint
