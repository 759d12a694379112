// Plain English: words and phrases of docs/diagnostics.md ("Wording") that read as translated do not come
// back.
#include "tests/policy/Tree.h"

#include <algorithm>
#include <array>
#include <doctest/doctest.h>
#include <string_view>

using namespace dotek::tests;

namespace {

struct Gone {
  std::string_view phrase; // in small letters, whole words
  std::string_view write;
};

constexpr std::array kGone = {
    Gone{"hangs on", "depends on"},
    Gone{"hang on", "depend on"},
    Gone{"turned away", "rejected"},
    Gone{"turns away", "rejects"},
    Gone{"turn away", "reject"},
    Gone{"tells of", "reports"},
    Gone{"tell of", "report"},
    Gone{"is told", "is reported"},
    Gone{"are told", "are reported"},
    Gone{"told once", "reported once"},
    Gone{"has it not", "does not have it"},
    Gone{"have it not", "do not have it"},
    Gone{"nobody says", "no source says"},
    Gone{"stands", "is, appears, precedes, follows"},
    Gone{"as they stand", "as they are"},
    Gone{"may stand", "may appear"},
    Gone{"cannot stand", "cannot appear"},
    Gone{"stand in", "are in"},
    Gone{"stand behind", "follow"},
    Gone{"stand before", "precede"},
    Gone{"right behind", "right after"},
    Gone{"one behind the other", "one after the other"},
    Gone{"behind", "after"},
};

// What stays right: a letter stands for a word, and in geometry one thing lies behind another.
constexpr std::array<std::string_view, 15> kRight = {
    "stands for",       "stand in for",       "may stand for",   "is told to",      "is told apart",
    "behind the part",  "behind the surface", "behind the face", "behind the wall", "behind the ball",
    "behind the plane", "behind the camera",  "behind the view", "behind the edge", "lies behind",
};

bool isProse(const TreeFile& file) {
  return file.path == "README.md" || file.path == "CHANGELOG.md" ||
         (file.path.ends_with(".md") && (file.below("docs") || file.below("ir")));
}

// Comments and literals of a source; the rest is blank. Lines stay where they are.
std::string proseOf(const std::string& text) {
  std::string out(text.size(), ' ');
  enum class In { Code, Comment, Literal } in = In::Code;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') {
      out[i] = c;
      in = In::Code;
      continue;
    }
    if (in == In::Code) {
      if (text.compare(i, 2, "//") == 0)
        in = In::Comment;
      else if (c == '"')
        in = In::Literal;
      continue;
    }
    if (in == In::Literal && c == '\\') {
      ++i;
      continue;
    }
    if (in == In::Literal && c == '"')
      in = In::Code;
    else
      out[i] = c;
  }
  return out;
}

// The text without the phrases that stay right.
std::string withoutRight(std::string text) {
  for (const std::string_view right : kRight)
    for (std::size_t at = text.find(right); at != std::string::npos; at = text.find(right, at + 1))
      text.replace(at, right.size(), std::string(right.size(), '.'));
  return text;
}

} // namespace

TEST_CASE("policy: plain English") {
  for (const TreeFile& file : tree()) {
    const bool source = (file.isSource() || file.path.ends_with(".def")) && !file.below("tests");
    if (!source && !isProse(file)) continue;
    const std::string text = withoutRight(lowerCase(source ? proseOf(file.text) : file.text));
    for (const Gone& gone : kGone) {
      const std::size_t at = findWord(text, std::string(gone.phrase));
      const auto line =
          at == std::string::npos
              ? 0
              : 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
      CHECK_MESSAGE(at == std::string::npos,
                    file.path << ":" << line << ": `" << gone.phrase << "`; write: " << gone.write);
    }
  }
}

TEST_CASE("policy: the rule for English itself") {
  CHECK(findWord(withoutRight("g stands for a code"), "stands") == std::string::npos);
  CHECK(findWord(withoutRight("it stands behind a word"), "stands") != std::string::npos);
  CHECK(proseOf("int behind = 1; // after\n") == "                 / after\n");
  CHECK(proseOf("f(\"x \\\" y\", behind);\n").find("behind") == std::string::npos);
}
