#include "lint/Posts.h"

#include <algorithm>
#include <map>

namespace dotek::lint::rule {
namespace {

bool isPlainMove(std::string_view word) {
  return word == "0" || word == "1" || word == "G0" || word == "G1" || word == "G00" || word == "G01";
}

std::vector<std::string> wordsOf(std::string_view text) {
  std::vector<std::string> out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    if (end > at) out.emplace_back(text.substr(at, end - at));
    at = end + 1;
  }
  return out;
}

// Of an argument: its words where they are texts, `"Z" + 100` too.
std::vector<std::string> literalWords(const fusion::Node* node) {
  node = fusion::bare(node);
  if (node->is(fusion::Kind::Binary) && node->text == "+" &&
      fusion::bare(node->kids[1])->is(fusion::Kind::Number))
    return wordsOf(std::string(textLiteral(node->kids[0])) + std::string(fusion::bare(node->kids[1])->text));
  return wordsOf(textLiteral(node));
}

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    std::map<std::string_view, std::string_view> owners; // by letter
    const std::vector<Made> made = madeOf(post);
    for (const Made& one : made)
      if (one.modal() && one.maker != "createModalGroup" && one.prefix.size() == 1 &&
          std::string_view("XYZF").find(one.prefix) != std::string_view::npos)
        owners.try_emplace(one.prefix, one.symbol->name);
    for (const fusion::Node& node : post.tree.nodes) {
      if (!node.is(fusion::Kind::Call) || calledName(node) != "writeBlock") continue;
      // A plain move: words of macros, planes and machine coordinates do not stay.
      bool moves = false, other = false;
      for (std::size_t i = 1; i < node.kids.size(); ++i)
        walk(node.kids[i], [&](const fusion::Node& part) {
          const std::string_view text = part.is(fusion::Kind::String)   ? fusion::stringText(part)
                                        : part.is(fusion::Kind::Number) ? part.text
                                                                        : std::string_view();
          for (const std::string& word : wordsOf(text)) {
            const bool plain = isPlainMove(word);
            moves = moves || plain;
            const std::string number = word.front() == 'G' || word.front() == 'M' ? word.substr(1) : word;
            const fusion::Node* const sum = fusion::bare(node.kids[i]); // `"Z" + 100`
            const bool axis = sum->is(fusion::Kind::Binary) && fusion::bare(sum->kids[1]) == &part;
            other =
                other || (!plain && !axis && number.find_first_not_of("0123456789") == std::string::npos &&
                          number != "90" && number != "94" && number != "17");
          }
        });
      if (!moves || other) continue;
      for (std::size_t i = 1; i < node.kids.size(); ++i) {
        for (const std::string& text : literalWords(node.kids[i])) {
          if (text.size() < 2 || std::string_view("-.0123456789").find(text[1]) == std::string_view::npos)
            continue;
          const auto at = owners.find(std::string_view(text).substr(0, 1));
          if (at == owners.end()) continue;
          report.at(post.tree.range(*node.kids[i]),
                    "`{}` is written past `{}`, which then leaves out a word that the control needs", text,
                    at->second);
          break;
        }
      }
    }
  });
}

} // namespace

DOTEK_LINT_RULE(post_raw_word){
    .severity = Severity::Note,
    .check = check,
};

} // namespace dotek::lint::rule
