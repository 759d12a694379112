#include "lint/PostEntries.h"

namespace dotek::lint {

std::vector<TopFunction> topFunctions(const fusion::Tree& tree) {
  std::vector<TopFunction> out;
  const auto add = [&](const fusion::Node* name, const fusion::Node* value) {
    if (name == nullptr || value == nullptr || !name->is(fusion::Kind::Name)) return;
    const fusion::Node* const function = fusion::bare(value);
    if (function->is(fusion::Kind::Function) || function->is(fusion::Kind::Arrow))
      out.push_back({name, function});
  };
  for (const fusion::Node* one : tree.body) {
    if (one->is(fusion::Kind::Function)) {
      add(one->kids[0], one);
    } else if (one->is(fusion::Kind::Variables)) {
      for (const fusion::Node* each : one->kids)
        add(each->kids[0], each->kids[1]);
    } else if (one->is(fusion::Kind::Evaluate) && one->kids[0]->is(fusion::Kind::Assign) &&
               one->kids[0]->text == "=") {
      add(one->kids[0]->kids[0], one->kids[0]->kids[1]);
    }
  }
  return out;
}

} // namespace dotek::lint
