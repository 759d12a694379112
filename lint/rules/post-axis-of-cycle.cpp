#include "lint/Posts.h"

namespace dotek::lint::rule {
namespace {

// `.x` of `position.x` is no variable.
bool isMember(const PostFile& post, const fusion::Node& name) {
  return post.scopes.symbolOf(&name) == nullptr;
}

void check(const Project& project, Report& report) {
  forEachNode(project, fusion::Kind::Case, [&](const PostFile& post, const fusion::Node& one) {
    const std::string_view type = textLiteral(one.kids[0]);
    const char own = type == "probing-x" || type == "probing-x-wall" || type == "probing-x-channel" ||
                             type == "probing-x-channel-with-island"
                         ? 'X'
                     : type == "probing-y" || type == "probing-y-wall" || type == "probing-y-channel" ||
                             type == "probing-y-channel-with-island"
                         ? 'Y'
                     : type == "probing-z" ? 'Z'
                                           : '\0';
    if (own == '\0') return;
    // `"Y" + format.format(x)`: the coordinate of another axis alone.
    const auto judge = [&](const fusion::Node& value) {
      const fusion::Node* other = nullptr;
      bool mine = false;
      walk(&value, [&](const fusion::Node& part) {
        if (!part.is(fusion::Kind::Name) || (part.text != "x" && part.text != "y" && part.text != "z"))
          return;
        if (isMember(post, part)) return;
        if (part.text[0] == own - 'A' + 'a')
          mine = true;
        else
          other = &part;
      });
      if (other != nullptr && !mine)
        report.at(
            post.tree.range(*other),
            "`{}` measures along {}, and the word {} has the coordinate {}: the probe moves to another place",
            type, own, own, other->text);
    };
    for (std::size_t i = 1; i < one.kids.size(); ++i)
      walk(one.kids[i], [&](const fusion::Node& call) {
        if (!call.is(fusion::Kind::Call) || calledName(call) != "writeBlock") return;
        bool macro = false;
        for (std::size_t k = 1; k < call.kids.size(); ++k)
          walk(call.kids[k], [&](const fusion::Node& node) {
            if (node.is(fusion::Kind::String) || node.is(fusion::Kind::Number)) {
              const std::string_view text =
                  node.is(fusion::Kind::Number) ? node.text : fusion::stringText(node);
              macro = macro || text.find("811") != std::string_view::npos ||
                      text.find("812") != std::string_view::npos;
            }
          });
        if (!macro) return;
        const fusion::Node* wrong = nullptr;
        std::string_view written;
        bool right = false;
        for (std::size_t k = 1; k < call.kids.size(); ++k) {
          const fusion::Node* const word = fusion::bare(call.kids[k]);
          // `"X" + value`, or a template of the letter and the value.
          const bool whole = word->is(fusion::Kind::Template) && word->kids.size() == 1;
          if (!whole && (!word->is(fusion::Kind::Binary) || word->text != "+")) continue;
          const std::string_view letter =
              whole ? post.tree.text.substr(word->begin + 1, word->kids[0]->begin - word->begin - 1)
                    : textLiteral(word->kids[0]);
          if (whole ? !letter.substr(std::min<std::size_t>(1, letter.size())).starts_with("${")
                    : letter.size() != 1)
            continue;
          if (letter[0] == own) {
            right = true;
            judge(*word->kids[whole ? 0 : 1]);
          } else if ((letter[0] == 'X' || letter[0] == 'Y') && wrong == nullptr) {
            wrong = word;
            written = letter.substr(0, 1);
          }
        }
        if (wrong != nullptr && !right)
          report.at(
              wrong->is(fusion::Kind::Template) ? post.tree.range(*wrong) : post.tree.range(*wrong->kids[0]),
              "`{}` measures along {}, and the block has the word {}: the probe moves along the other axis",
              type, own, written);
      });
  });
}

} // namespace

DOTEK_LINT_RULE(post_axis_of_cycle){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
