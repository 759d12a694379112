// Arguments of programs of the shop: what the comments of the called program say of them.
#include "lsp/Uses.h"
#include "support/Ascii.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::lsp {

namespace {

constexpr std::uint32_t kMostLines = 60; // of comments that a program begins with
constexpr std::size_t kMostOfName = 24;

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") + 1 - first);
}

// What follows the letter in the comment, without the local and signs between; "": it is of another letter.
std::string_view saidOf(std::string_view comment, char letter) {
  comment = trimmed(comment);
  if (comment.size() < 3 || comment.front() != letter) return {};
  comment.remove_prefix(1);
  if (comment.front() != ' ' && comment.front() != '\t' && comment.front() != '#' && comment.front() != '=' &&
      comment.front() != ':')
    return {};
  comment = trimmed(comment);
  if (comment.starts_with('#')) {
    comment.remove_prefix(1);
    while (!comment.empty() && isDigit(comment.front()))
      comment.remove_prefix(1);
  }
  while (!comment.empty() && std::string_view(" \t=:-").find(comment.front()) != std::string_view::npos)
    comment.remove_prefix(1);
  return trimmed(comment);
}

// UTF-8; "": the program is not there, or says nothing.
std::string saidIn(Workspace& workspace, const Document& document, const OwnArgument& argument) {
  const Occurrence called{fmt::format("O {}", argument.program), Occurrence::Role::Read, argument.range};
  for (const Use& use : usesOf(workspace, document, called)) {
    if (use.occurrence->role != Occurrence::Role::Definition) continue;
    const SourceFile& file = use.index->text();
    const std::uint32_t first = file.lineOf(use.occurrence->range.begin);
    for (std::uint32_t line = first; line < first + kMostLines && line <= file.lineCount(); ++line) {
      const std::string_view text = file.line(line);
      const std::size_t open = text.find('('), close = text.find(')', open);
      if (open == std::string_view::npos || close == std::string_view::npos) {
        if (line > first && !trimmed(text).empty()) break;
        continue;
      }
      if (line > first && trimmed(text).front() != '(') break;
      const std::string_view said = saidOf(text.substr(open + 1, close - open - 1), argument.letter);
      if (!said.empty()) return use.index->utf8(said);
    }
    break;
  }
  return "";
}

} // namespace

std::string ownArgumentText(Workspace& workspace, const Document& document, const OwnArgument& argument) {
  const std::string said = saidIn(workspace, document, argument);
  return fmt::format("**{}** argument of O{}, `#{}` in it{}{}", argument.letter, argument.program,
                     argument.local, said.empty() ? "" : "\n\n", said);
}

std::string ownArgumentHint(Workspace& workspace, const Document& document, const OwnArgument& argument) {
  const std::string said = saidIn(workspace, document, argument);
  // A table that convert writes has the name first, a sentence ends at a comma.
  const std::size_t end = std::min(said.find("  "), said.find_first_of(",;.("));
  std::string name = lowerCase(said.substr(0, std::min(end, said.size())));
  if (name.size() > kMostOfName) name = name.substr(0, name.rfind(' ', kMostOfName));
  return name.empty() || name.size() > kMostOfName ? "" : name + ":";
}

} // namespace dotek::lsp
