#include "lint/Posts.h"

#include <algorithm>
#include <array>

namespace dotek::lint::rule {
namespace {

void check(const Project& project, Report& report) {
  constexpr auto kOld =
      std::to_array<std::string_view>({"forceDecimal", "zeropad", "width", "trim", "trimLeadZero"});
  constexpr auto kNew = std::to_array<std::string_view>({"type", "minDigitsLeft", "minDigitsRight"});
  forEachNode(project, fusion::Kind::Call, [&](const PostFile& post, const fusion::Node& call) {
    if (calledName(call) != "createFormat") return;
    const fusion::Node* const given = fusion::bare(call.kid(1));
    const fusion::Node* older = nullptr;
    const fusion::Node* newer = nullptr;
    if (given == nullptr || !given->is(fusion::Kind::Object)) return;
    for (const fusion::Node* one : given->kids) {
      if (!one->is(fusion::Kind::Property)) continue;
      const std::string_view key = keyOf(*one);
      if (std::find(kOld.begin(), kOld.end(), key) != kOld.end()) older = one;
      if (std::find(kNew.begin(), kNew.end(), key) != kNew.end()) newer = one;
    }
    if (older != nullptr && newer != nullptr)
      report.at(post.tree.range(*older->kids[0]),
                "`{}` beside `{}`: the two styles of formats exclude one another, and which one holds is not "
                "stated",
                keyOf(*older), keyOf(*newer));
  });
}

} // namespace

DOTEK_LINT_RULE(post_format_styles_mixed){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
