#include "frontend/compost/Walk.h"

namespace dotek::frontend::compost {

void Walk::call(const Routine& routine, SourceRange where) {
  if (!enter(routine, where)) return;
  body(routine.body);
  leave(routine);
}

void Walk::body(const std::vector<Statement>& statements) {
  for (const Statement& statement : statements) {
    if (const auto* text = std::get_if<Literal>(&statement)) {
      if (!step(text->range)) return;
      literal(*text);
    } else if (const auto* keyword = std::get_if<Word>(&statement)) {
      if (!step(keyword->range)) return;
      if (const Routine* routine = routineOf(*keyword))
        call(*routine, keyword->nameRange);
      else
        word(*keyword);
    } else if (const auto* eol = std::get_if<EndOfLine>(&statement)) {
      if (!step(eol->range)) return;
      endLine(eol->range);
    } else if (const auto* inner = std::get_if<std::unique_ptr<If>>(&statement)) {
      if (!step((*inner)->ifRange)) return;
      branch(**inner);
    }
  }
}

} // namespace dotek::frontend::compost
