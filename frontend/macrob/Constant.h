// Values that are the same in every run.
#pragma once

#include "frontend/macrob/Ast.h"

#include <optional>

namespace dotek::frontend::macrob {

// The value of numbers joined by + - * and AND; nullopt: it depends on variables, or on how the control
// computes.
std::optional<double> constantOf(const Expression& expression);

} // namespace dotek::frontend::macrob
