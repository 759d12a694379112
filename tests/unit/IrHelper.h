// Short ways to write IR in tests.
#pragma once

#include "ir/Cycle.h"

#include <string>
#include <utility>

namespace dotek::tests {

template <class Node> ir::CycleStatement statement(Node node) {
  ir::CycleStatement out;
  out.node = std::move(node);
  return out;
}

inline ir::Variable named(std::string name, ir::Role role, ir::Kind kind = ir::Kind::Number) {
  ir::Variable out;
  out.name = std::move(name);
  out.role = role;
  out.kind = kind;
  return out;
}

inline ir::Variable parameter(std::string name, ir::Kind kind = ir::Kind::Number) {
  return named(std::move(name), ir::Role::Parameter, kind);
}

inline ir::Variable local(std::string name, ir::Kind kind = ir::Kind::Number) {
  return named(std::move(name), ir::Role::Local, kind);
}

} // namespace dotek::tests
