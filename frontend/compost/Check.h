// Findings inside one Prog that need no other file.
#pragma once

#include "frontend/compost/Ast.h"
#include "stdlib/ComPostKeywords.h"
#include "stdlib/Form.h"
#include "support/Check.h"
#include "support/Source.h"

#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dotek::frontend::compost {

// A parsed Prog, and what several checks ask of it. What is passed outlives it.
class CheckedProg {
public:
  // `form`: that of the post, which may define words of its own; nullptr: not known.
  CheckedProg(const Program& prog, const stdlib::ComPostKeywords& known, const SourceMap& files,
              const stdlib::Form* form = nullptr);

  const Program& program;
  const stdlib::ComPostKeywords& keywords;
  const SourceMap& sources;

  std::map<std::string, SourceRange, std::less<>> routines; // first of each name
  std::vector<const Word*> words;                           // of all routines, those of conditions included
  // Statements and conditions in source order, inner ones after the one that holds them.
  std::vector<const std::vector<Statement>*> bodies;
  std::vector<const Condition*> conditions;

  // A command that calls a routine of the Prog.
  bool calls(const Word& word) const {
    return word.kind == WordKind::Command && routines.contains(word.name);
  }
  // The names that words and FORMAT use, the first of each spelling; calls and words that the form alone
  // defines are left out.
  struct Spelling {
    std::string_view name;
    WordKind kind = WordKind::Command;
    SourceRange range;
  };
  std::vector<Spelling> spellings;
  // Another spelling that a name most likely means, with its suffix; "": none differs in case alone.
  std::string caseVariant(const Spelling& spelt) const;
  // The name that one slip of the hand, or an abbreviation written out, makes this one, with its suffix; "":
  // none. Names that differ in an axis, a number, or ON and OFF are names of their own.
  std::string slipOf(const Spelling& spelt) const;

  std::string text(SourceRange range) const { return sources.textUtf8(range); }

private:
  void visit(const std::vector<Statement>& body);
  void visit(const Condition& condition);
  void spell(std::string_view name, WordKind kind, SourceRange range);

  const stdlib::Form* form_;
  std::map<std::string, std::string> routineCases_; // lower case to the first spelling
  std::set<std::string> spelt_;
};

DOTEK_CHECK(CheckedProg, commentBrace, "comment-brace", Warning);
DOTEK_CHECK(CheckedProg, duplicateRoutine, "duplicate-routine", Error);
DOTEK_CHECK(CheckedProg, unknownKeyword, "unknown-keyword", Note);
DOTEK_CHECK(CheckedProg, keywordMisspelt, "keyword-misspelt", Warning);
DOTEK_CHECK(CheckedProg, keywordCase, "keyword-case", Warning);
DOTEK_CHECK(CheckedProg, keywordKind, "keyword-kind", Warning);
DOTEK_CHECK(CheckedProg, keywordArgument, "keyword-argument", Warning);
DOTEK_CHECK(CheckedProg, unverifiedInProg, "unverified-in-prog", Note);
DOTEK_CHECK(CheckedProg, badPicture, "bad-picture", Error);
DOTEK_CHECK(CheckedProg, duplicatePicture, "duplicate-picture", Error);
DOTEK_CHECK(CheckedProg, duplicateFormat, "duplicate-format", Error);
DOTEK_CHECK(CheckedProg, formatWithoutPicture, "format-without-picture", Error);
DOTEK_CHECK(CheckedProg, pictureUnused, "picture-unused", Note);
DOTEK_CHECK(CheckedProg, flagNeverSet, "flag-never-set", Warning);
DOTEK_CHECK(CheckedProg, routineHidesKeyword, "routine-hides-keyword", Warning);
DOTEK_CHECK(CheckedProg, routineNeverCalled, "routine-never-called", Note);

// All of them.
std::span<const Check<CheckedProg>* const> progChecks();

// Runs them. What the parser reported is not repeated.
void check(const Program& program, const stdlib::ComPostKeywords& keywords, const SourceMap& sources,
           Diagnostics& diagnostics);

} // namespace dotek::frontend::compost
