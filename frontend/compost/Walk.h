// One walk over what a routine of a Prog prints: its statements in their order, the routines that it calls,
// the sides of an IF that count. What becomes of them, text or blocks or findings, is up to the sink that
// derives from it.
#pragma once

#include "frontend/compost/Ast.h"

#include <vector>

namespace dotek::frontend::compost {

class Walk {
public:
  virtual ~Walk() = default;

protected:
  void body(const std::vector<Statement>& statements);
  // Walks the routine if enter() lets it.
  void call(const Routine& routine, SourceRange where);

  // Before each statement; false ends the walk.
  virtual bool step(SourceRange /*where*/) { return true; }
  // The routine that a word calls; nullptr: it calls none, and word() gets it.
  virtual const Routine* routineOf(const Word& word) const = 0;
  virtual bool enter(const Routine& routine, SourceRange where) = 0;
  virtual void leave(const Routine& routine) = 0;
  virtual void literal(const Literal& literal) = 0;
  virtual void word(const Word& word) = 0;
  virtual void endLine(SourceRange where) = 0;
  // Calls body() for each side that counts.
  virtual void branch(const If& branch) = 0;
};

} // namespace dotek::frontend::compost
