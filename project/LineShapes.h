// Private to InputKind.cpp: which language a line can be of. Shapes only; no table of keywords is read, so
// that an input is recognised before anything is loaded.
#pragma once

#include <string_view>

namespace dotek::project {

// How a line looks to one language.
struct Shape {
  bool blank = false; // empty, or nothing but a comment: it counts for nothing
  bool fits = false;  // it can be of the language
  int weight = 0;     // what hardly any other text has, 0 to 5
};

// A block of NC: words, statements of Macro B, a header, `%`. Comments in round brackets are skipped.
struct BlockShape : Shape {
  int macroB = 0;       // of the weight: what only Macro B has
  bool percent = false; // a line `%`
  bool header = false;  // O1234, :1234
  bool code = false;    // it has a G or M code, or a number
  bool begins = false;  // it begins as a block and goes on as something else
};
BlockShape blockShape(std::string_view line);

// A block of Mikroprog: words, values from `P` parameters, `@file`, a comment after `;`.
Shape sufShape(std::string_view line);

// A statement of a GibbsCAM macro.
Shape macroShape(std::string_view line);

// A control of a GibbsCAM dialog: a word and the four numbers of its box.
Shape dialogShape(std::string_view line);

// A statement of the cycle language.
Shape cycleShape(std::string_view line);

// A statement of Macro B with a word that is none of it, outside of comments and of what DPRNT prints: a
// slip, or a sentence about a variable.
bool hasStrayWord(std::string_view line);

// A sentence: mostly words, not all in capitals.
bool isProse(std::string_view line);

// NAME = number, as in DefineData.txt.
bool isDefinition(std::string_view line);

// A line of a Prog of ComPost. `inComment`: whether a comment in braces was open before it, and is after it.
Shape progShape(std::string_view line, bool& inComment);

} // namespace dotek::project
