// What a Prog prints, as NC blocks with holes: the view that rules have of a post.
#pragma once

#include "lint/Project.h"

#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::lint {

// One thing that is printed into a block.
struct ProgPiece {
  enum class Kind : std::uint8_t { Text, Number, Command, Sequence };
  Kind kind = Kind::Text;
  SourceRange range;
  const compost::Literal* literal = nullptr; // of Text
  const compost::Word* word = nullptr;       // of the others
  std::string field;                         // of an OpFieldData#: the field; else ""
  std::uint32_t arm = 0; // pieces of one number are below the same part of an IF; 0: below none
};

// An NC word of a block: an address with digits, or with a hole that a piece fills.
struct ProgWord {
  char address = 0;
  std::string digits;              // of a hole: "" or the sign before it; of an expression in brackets: "["
  const ProgPiece* hole = nullptr; // what fills it
  SourceRange range;               // of the address and its digits
};

struct ProgBlock {
  std::vector<ProgPiece> pieces; // EOL excepted
  SourceRange range;             // first to last piece
  bool conditional = false;      // is below an IF within the statements that were asked for
  bool called = false;           // printed, all of it, by a routine that the statements call
  bool open = false;             // the statements end before its EOL
  std::vector<const compost::Routine*> joined = {}; // that are called in the middle of it

  // `G65 P9770 Z{}`: blanks as one, holes as braces, commands as `<SpinOff>`, no sequence word.
  std::string shape() const;
  // The same with the name of each field: `G65 P9770 Z{depth}`.
  std::string text() const;
};

// What a command or a numeric word prints. The form says which words are block numbers, beside those that the
// language is known to have.
ProgPiece::Kind pieceKind(const compost::Word& word, const Project& project);
// Words of the block; the hole of a command is the address that the form prints for it. A macro statement has
// none. Points into the block.
// `expressions`: words with one are among them; else a block that has one gives none.
std::vector<ProgWord> wordsOf(const ProgBlock& block, const stdlib::Form* form, bool expressions = false);
// A command of the block prints what the form does not say, any address perhaps: what wordsOf() lacks may be
// there.
bool printsUnknown(const ProgBlock& block, const stdlib::Form* form);
// The digits of the first word with this address; "" for none, or a hole.
std::string digitsOf(const std::vector<ProgWord>& words, char address);
const ProgWord* findWord(const std::vector<ProgWord>& words, char address);
// G65 with a P that is written out; 0: the block calls nothing.
std::uint32_t macroCalled(const std::vector<ProgWord>& words);

// The blocks that the statements print, those of called routines included, both arms of an IF one after
// the other. Computed once a project; `statements` are of its Prog.
const std::vector<ProgBlock>& blocksOf(const std::vector<compost::Statement>& statements,
                                       const compost::Program& prog, const Project& project);
std::vector<ProgBlock> collectBlocks(const std::vector<compost::Statement>& statements,
                                     const compost::Program& prog, const Project& project);

// Routines that print no whole block alone: what they are called for begins or ends in their callers.
struct PartRoutines {
  std::set<const compost::Routine*> begun; // in the middle of a block
  std::set<const compost::Routine*> called;
};
// Computed once a project.
const PartRoutines& partsOf(const compost::Program& prog, const Project& project);
PartRoutines findParts(const compost::Program& prog, const Project& project);
// The blocks of a routine that are its own to judge: those of the routines that it calls are theirs, and a
// block that is split over several is that of the one that calls them.
std::vector<const ProgBlock*> ownBlocks(const compost::Routine& routine, const compost::Program& prog,
                                        const Project& project);

// A branch that is printed for one cycle.
struct CycleBranch {
  std::string id;
  compost::BranchRef ref;
  std::vector<ProgBlock> blocks;
};
// Branches of one routine on one cycle each, that print something: siblings of one another.
struct Siblings {
  const compost::Program* prog = nullptr;
  const compost::Routine* routine = nullptr;
  std::vector<CycleBranch> branches;
};
// Computed once a project.
const std::vector<Siblings>& siblingsOf(const Project& project);
std::vector<Siblings> findSiblings(const Project& project);

// Visits all statements of a routine, outer ones first.
void eachStatement(const std::vector<compost::Statement>& statements,
                   const std::function<void(const compost::Statement&)>& visit);
// All routines of all Progs.
void eachRoutine(const Project& project,
                 const std::function<void(const compost::Program&, const compost::Routine&)>& visit);
SourceRange rangeOf(const compost::Statement& statement);

// What any set of probing macros says the program does.
struct MacroMeaning {
  const stdlib::MacroSet* set = nullptr; // nullptr: no set knows the program
  stdlib::Intent intent = stdlib::Intent::ProtectedMove;
  bool measures() const; // touches a feature
};
MacroMeaning meaningOf(const Project& project, std::uint32_t program);

} // namespace dotek::lint
