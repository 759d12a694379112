#include "lint/Posts.h"

#include <map>

namespace dotek::lint::rule {
namespace {

// A call of a macro that is no protected move: P9811 to P9899 and their like. What is not written as a number
// is not judged.
bool measures(const fusion::Node& call) {
  for (std::size_t i = 1; i < call.kids.size() && i < 4; ++i) {
    const fusion::Node* part = fusion::bare(call.kids[i]);
    std::string text;
    if (part->is(fusion::Kind::Binary) && part->text == "+" && textLiteral(part->kids[0]) == "P" &&
        part->kids[1]->is(fusion::Kind::Number))
      text = "P" + std::string(part->kids[1]->text);
    else
      text = std::string(textLiteral(part));
    const std::size_t at = text.find('P');
    if (at == std::string::npos || text.size() < at + 5) continue;
    const std::string number = text.substr(at + 1, 4);
    if (number.find_first_not_of("0123456789") != std::string::npos) continue;
    return (number[0] == '9' || number[0] == '8') && number[1] == '8' && number.substr(2) != "10" &&
           number.substr(2) != "32" && number.substr(2) != "33";
  }
  return false;
}

void check(const Project& project, Report& report) {
  forEachPost(project, [&](const PostFile& post) {
    std::map<std::string_view, const Made*> modal;
    const std::vector<Made> made = madeOf(post);
    for (const Made& one : made) {
      const fusion::Node* const control = propertyOf(one.specifiers, "control");
      const fusion::Node* const force = propertyOf(one.specifiers, "force");
      if (one.modal() && one.maker != "createModalGroup" && control == nullptr && force == nullptr)
        modal[one.symbol->name] = &one;
    }
    std::map<std::string, std::vector<const fusion::Node*>> found; // by the variables
    for (const fusion::Node& node : post.tree.nodes) {
      if (!node.is(fusion::Kind::Call) || node.kids.size() < 3) continue;
      const std::string name = calledName(node);
      if (name != "writeBlock" && name != "formatWords" && name != "writeWords") continue;
      if (!measures(node)) continue;
      const fusion::Node* first = nullptr;
      std::string names;
      for (std::size_t i = 2; i < node.kids.size(); ++i) {
        const fusion::Node* const word = fusion::bare(node.kids[i]);
        if (!word->is(fusion::Kind::Call)) continue;
        const fusion::Node* const of = word->kids[0];
        if (!of->is(fusion::Kind::Member) || of->kids[1]->text != "format" ||
            !of->kids[0]->is(fusion::Kind::Name) || !modal.contains(of->kids[0]->text))
          continue;
        if (first == nullptr) first = word;
        names += (names.empty() ? "`" : ", `") + std::string(of->kids[0]->text) + "`";
      }
      if (first != nullptr) found[names].push_back(first);
    }
    for (const auto& [names, words] : found) {
      Diagnostic& one = report.at(
          post.tree.range(*words.front()),
          "{}: nothing is printed while the value stays the same, and the macro measures without the word",
          names);
      for (std::size_t i = 1; i < words.size(); ++i)
        one.note(post.tree.range(*words[i]), "here, too");
    }
  });
}

} // namespace

DOTEK_LINT_RULE(post_modal_macro_word){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
