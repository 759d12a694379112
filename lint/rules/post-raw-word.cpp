#include "lint/Posts.h"

#include <map>

namespace dotek::lint::rule {
namespace {

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
          if (text.empty()) return;
          const bool plain =
              text == "0" || text == "1" || text == "G0" || text == "G1" || text == "G00" || text == "G01";
          moves = moves || plain;
          const std::string_view number = text.front() == 'G' || text.front() == 'M' ? text.substr(1) : text;
          other = other || (!plain && number.find_first_not_of("0123456789") == std::string_view::npos &&
                            number != "90" && number != "94" && number != "17");
        });
      if (!moves || other) continue;
      for (std::size_t i = 1; i < node.kids.size(); ++i) {
        const std::string_view text = textLiteral(node.kids[i]);
        if (text.size() < 2 || std::string_view("-.0123456789").find(text[1]) == std::string_view::npos)
          continue;
        if (const auto at = owners.find(text.substr(0, 1));
            at != owners.end() && text.find(' ') == std::string_view::npos)
          report.at(post.tree.range(*node.kids[i]),
                    "`{}` is written past `{}`, which then leaves out a word that the control needs", text,
                    at->second);
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
