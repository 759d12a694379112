// What the profile of a control says of the number of a variable.
#pragma once

#include "stdlib/Control.h"

#include <cstdint>

namespace dotek::stdlib {

// The profile states what the system variable (#1000 and up) holds.
bool namesVariable(const Control& control, std::uint32_t number);

// A program that writes it stops with alarm 116: listed so, a state that is only read, or the tool offset 0.
bool isReadAlone(const Control& control, std::uint32_t number);

// An entry of a table of tools, or the number that its entries count from: #2000 of `#[2000+#7]`.
bool isOfTools(const Control& control, std::uint32_t number);

// A work offset, the external one, one beyond G59, or the number that a computed one counts from: #5200 of
// `#[5200+20*#1+#2]`, where the axis is a number, #6981 of `#[6981+20*#1]`, where the systems count from 1.
bool isOfOffsets(const Control& control, std::uint32_t number);

} // namespace dotek::stdlib
