// Trees of posts, of whole texts and of damaged ones.
#include "frontend/fusion/Parse.h"
#include "tests/GoldenRunner.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

using namespace dotek;
using namespace dotek::tests;
using namespace dotek::frontend;

namespace {

// What a node covers lies in the text, and is not inside out.
bool holds(const fusion::Tree& tree) {
  return std::all_of(tree.nodes.begin(), tree.nodes.end(),
                     [&](const fusion::Node& node) {
                       return node.begin <= node.end && node.end <= tree.text.size();
                     }) &&
         std::all_of(tree.unread.begin(), tree.unread.end(), [&](const fusion::Unread& one) {
           return one.range.begin <= one.range.end && one.range.end <= tree.text.size();
         });
}

} // namespace

TEST_CASE("fusion syntax: each part of a damaged post covers a piece of its text") {
  for (const char* text :
       {"f(", "x = [", "x = [,,", "function f(", "function (a,", "if (x", "for (", "case", "y {",
        "x = {\n\n a", "switch (x) {\n\ncase 1", "try {\n", "class A {\n  b(", "`${",
        "schema = 1\nunit = \"mm\"\n\n[program]\nname = 1\n", "  \n /* a */ }  \n ,"}) {
    CAPTURE(text);
    CHECK(holds(fusion::parseText(text)));
  }
  std::ifstream file(root() / "tests/fusion/posts/words.cps", std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  REQUIRE(whole.size() > 500);
  CHECK(holds(fusion::parseText(whole)));
  std::mt19937 random(14);
  for (int round = 0; round < 500; ++round) {
    std::string damaged = whole.substr(random() % whole.size(), 20 + random() % 400);
    damaged.erase(random() % damaged.size(), 1 + random() % 12);
    CAPTURE(damaged);
    REQUIRE(holds(fusion::parseText(damaged)));
  }
}

TEST_CASE("fusion syntax: words of a switch outside of one are reported each") {
  std::string text;
  constexpr std::size_t kMany = 20'000;
  for (std::size_t i = 0; i < kMany; ++i)
    text += "case 1:\n";
  const fusion::Tree tree = fusion::parseText(text);
  CHECK(tree.unread.size() >= kMany);
}
