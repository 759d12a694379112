// Every statement of a block.
#pragma once

#include "frontend/cycle/Ast.h"

namespace dotek::frontend::cycle {

// Visits the statements of the block and of the blocks within it, in source order. `Blocks`: Block or const
// Block. What calls of cycles lead to is not visited.
template <class Blocks, class Visit> void eachStatement(Blocks& block, const Visit& visit) {
  for (auto& statement : block.statements) {
    visit(statement);
    if (auto* choice = std::get_if<If>(&statement.node)) {
      for (auto& part : choice->parts)
        eachStatement(part.body, visit);
      if (choice->otherwise != nullptr) eachStatement(*choice->otherwise, visit);
    }
    if (auto* touch = std::get_if<Touch>(&statement.node); touch != nullptr && touch->otherwise != nullptr)
      eachStatement(*touch->otherwise, visit);
    if (auto* repeat = std::get_if<Repeat>(&statement.node)) eachStatement(repeat->body, visit);
    if (auto* loop = std::get_if<For>(&statement.node)) eachStatement(loop->body, visit);
    if (auto* loop = std::get_if<While>(&statement.node)) eachStatement(loop->body, visit);
  }
}

} // namespace dotek::frontend::cycle
