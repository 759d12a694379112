#include "lint/Posts.h"

namespace dotek::lint::rule {
namespace {

// `unit == IN ? 20 : 21` and its like: the program may be in inches.
bool writesInches(const PostFile& post) {
  for (const fusion::Node& node : post.tree.nodes) {
    if (!node.is(fusion::Kind::Conditional)) continue;
    bool unit = false;
    walk(node.kids[0], [&](const fusion::Node& part) { unit = unit || part.isName("unit"); });
    const std::string_view one = post.tree.textOf(*fusion::bare(node.kids[1]));
    const std::string_view other = post.tree.textOf(*fusion::bare(node.kids[2]));
    const auto both = [&](std::string_view a, std::string_view b) {
      return (one == a && other == b) || (one == b && other == a);
    };
    if (unit && (both("20", "21") || both("70", "71") || both("700", "710"))) return true;
  }
  return false;
}

// Travel and clearance, a number that is not 0: "Q10.", "R" + 2, "Q" + format.format(10).
bool isFixedLength(const fusion::Node* word) {
  const auto isNumber = [](std::string_view text) {
    return !text.empty() && text.find_first_not_of("-+.0123456789") == std::string_view::npos &&
           text.find_first_of("123456789") != std::string_view::npos;
  };
  const auto isLetter = [](std::string_view text) { return text == "Q" || text == "R"; };
  if (const std::string_view text = textLiteral(word); text.size() > 1)
    return isLetter(text.substr(0, 1)) && isNumber(text.substr(1));
  if (!word->is(fusion::Kind::Binary) || word->text != "+" || !isLetter(textLiteral(word->kids[0])))
    return false;
  const fusion::Node* value = fusion::bare(word->kids[1]);
  if (value->is(fusion::Kind::Call) && value->kids.size() == 2 && calledName(*value).ends_with(".format"))
    value = fusion::bare(value->kids[1]);
  return value->is(fusion::Kind::Number) && isNumber(value->text);
}

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    if (!writesInches(post)) return;
    for (const fusion::Node& node : post.tree.nodes) {
      if (!node.is(fusion::Kind::Call) || !callsMeasuringMacro(node)) continue;
      const std::string name = calledName(node);
      if (name != "writeBlock" && name != "formatWords" && name != "writeWords") continue;
      for (std::size_t i = 2; i < node.kids.size(); ++i) {
        const fusion::Node* const word = fusion::bare(node.kids[i]);
        if (isFixedLength(word))
          report.at(post.tree.range(*word), "the post writes programs in inches too, and this length of the "
                                            "macro is the same number in both: "
                                            "`toPreciseUnit(.., MM)` turns it");
      }
    }
  });
}

} // namespace

DOTEK_LINT_RULE(post_inch_macro_word){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
