#include "lint/Posts.h"
#include "support/NearestName.h"
#include "support/WriteInstead.h"

#include <algorithm>
#include <array>
#include <span>

namespace dotek::lint::rule {
namespace {

struct Known {
  std::string_view maker;
  std::span<const std::string_view> words;
};
constexpr auto kFormat = std::to_array<std::string_view>(
    {"decimals", "trim",          "trimLeadZero",   "forceDecimal", "forceSign",   "zeropad",
     "width",    "separator",     "scale",          "offset",       "cyclicLimit", "cyclicSign",
     "prefix",   "suffix",        "inherit",        "base",         "minimum",     "maximum",
     "type",     "minDigitsLeft", "minDigitsRight", "translation"});
constexpr auto kVariable =
    std::to_array<std::string_view>({"prefix", "suffix", "force", "onchange", "first", "current", "control",
                                     "type", "tolerance", "cyclicLimit", "cyclicSign", "format"});

void check(const Project& project, Report& report) {
  constexpr std::array kKnown = {Known{"createFormat", kFormat},
                                 Known{"createVariable", kVariable},
                                 Known{"createModal", kVariable},
                                 Known{"createReferenceVariable", kVariable},
                                 Known{"createIncrementalVariable", kVariable},
                                 Known{"createOutputVariable", kVariable}};
  forEachNode(project, fusion::Kind::Call, [&](const PostFile& post, const fusion::Node& call) {
    const std::string name = calledName(call);
    const auto known =
        std::find_if(kKnown.begin(), kKnown.end(), [&](const Known& one) { return one.maker == name; });
    const fusion::Node* const given = objectOf(post, call.kid(1));
    if (known == kKnown.end() || given == nullptr || !given->is(fusion::Kind::Object)) return;
    for (const fusion::Node* one : given->kids) {
      if (!one->is(fusion::Kind::Property) || one->kids[0]->is(fusion::Kind::Computed)) continue;
      const std::string_view key = keyOf(*one);
      const auto& words = known->words;
      if (std::find(words.begin(), words.end(), key) != words.end()) continue;
      const std::string near = nearestName(key, words);
      const SourceRange place = post.tree.range(*one->kids[0]);
      Diagnostic& found =
          report.at(place, "`{}` is no specifier of {}: the engine passes over it in silence{}", key, name,
                    near.empty() ? "" : "; did you mean `" + near + "`?");
      if (place.end - place.begin == key.size()) found.fix = writeInstead(place, near); // else in quotes
    }
  });
}

} // namespace

DOTEK_LINT_RULE(post_misspelt_specifier){
    .severity = Severity::Warning,
    .check = check,
};

} // namespace dotek::lint::rule
