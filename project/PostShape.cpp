#include "project/PostShape.h"

#include "support/LineEnds.h"

#include <algorithm>
#include <array>

namespace dotek::project {
namespace {

using View = std::string_view;

bool isWord(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '$';
}

View trimmed(View line) {
  while (!line.empty() && (line.back() == ' ' || line.back() == '\t' || line.back() == '\r'))
    line.remove_suffix(1);
  while (!line.empty() && (line.front() == ' ' || line.front() == '\t'))
    line.remove_prefix(1);
  return line;
}

// `function name(`, `class Name`, `const name = (..) =>`
bool isFunction(View line) {
  if (line.starts_with("class ") && line.ends_with('{')) return true;
  for (const View word : {View("const "), View("let "), View("var ")})
    if (line.starts_with(word) && line.find('=') != View::npos &&
        (line.find("=>") != View::npos || line.find("function (") != View::npos ||
         line.find("function(") != View::npos))
      return true;
  if (!line.starts_with("function ")) return false;
  std::size_t at = line.find_first_not_of(' ', 9);
  if (at == View::npos || !isWord(line[at])) return false;
  while (at < line.size() && isWord(line[at]))
    ++at;
  return line.find('(', at) != View::npos;
}

// What only a post calls.
bool isOfPost(View line) {
  constexpr auto kCalls = std::to_array<View>(
      {"createFormat(", "createVariable(", "createModal(", "createOutputVariable(", "createModalGroup(",
       "createReferenceVariable(", "writeBlock(", "writeln(", "getProperty(", "properties = {",
       "expandCyclePoint(", "currentSection.", "getParameter(", "formatWords(",
       "minimumRevision =", "setWordSeparator(", "Output.format(", "Format.format(", "cycleType"});
  return std::any_of(kCalls.begin(), kCalls.end(), [&](View call) { return line.find(call) != View::npos; });
}

bool endsAsScript(View line) {
  constexpr View kEnds = ";{},([)]:?|&+";
  return kEnds.find(line.back()) != View::npos;
}

} // namespace

bool isPostText(View text, bool named) {
  int lines = 0, fits = 0, weight = 0, functions = 0, ofPosts = 0;
  bool inComment = false;
  for (std::size_t at = 0; at < text.size() && lines < 2000;) {
    const std::size_t end = endOfLine(text, at);
    View line = trimmed(text.substr(at, end - at));
    at = end + 1;
    if (inComment) {
      const std::size_t close = line.find("*/");
      if (close == View::npos) continue;
      line = trimmed(line.substr(close + 2));
      inComment = false;
    }
    if (line.starts_with("/*")) {
      const std::size_t close = line.find("*/", 2);
      inComment = close == View::npos;
      line = inComment ? View() : trimmed(line.substr(close + 2));
    }
    if (line.empty() || line.starts_with("//")) continue;
    if (const std::size_t comment = line.find(" //"); comment != View::npos && comment > 0)
      line = trimmed(line.substr(0, comment));
    if (line.empty()) continue;
    ++lines;
    const bool function = isFunction(line);
    const bool variable =
        (line.starts_with("var ") || line.starts_with("let ") || line.starts_with("const ")) &&
        line.find('=') != View::npos;
    const bool ofPost = isOfPost(line);
    fits += function || variable || ofPost || endsAsScript(line) || line.starts_with("case ") ? 1 : 0;
    functions += function ? 1 : 0;
    ofPosts += ofPost ? 1 : 0;
    weight += (function ? 2 : 0) + (variable && line.ends_with(";") ? 1 : 0) + (ofPost ? 2 : 0);
  }
  if (lines == 0) return false;
  const double share = static_cast<double>(fits) / lines;
  return named ? weight >= 1 && share >= 0.3 : weight >= 3 && share >= 0.6 && functions > 0 && ofPosts > 0;
}

} // namespace dotek::project
