#include "lint/Posts.h"

#include <map>

namespace dotek::lint::rule {
namespace {

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
      if (!callsMeasuringMacro(node)) continue;
      const fusion::Node* first = nullptr;
      std::string names;
      std::vector<const fusion::Node*> words;
      for (std::size_t i = 2; i < node.kids.size(); ++i) {
        const fusion::Node* const word = objectOf(post, node.kids[i]);
        if (word->is(fusion::Kind::Array))
          words.insert(words.end(), word->kids.begin(), word->kids.end());
        else
          words.push_back(word);
      }
      for (const fusion::Node* word : words) {
        if (word == nullptr) continue;
        word = fusion::bare(word);
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
