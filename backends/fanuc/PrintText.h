// The blocks of a port: POPEN, PCLOS, DPRNT, BPRNT.
#pragma once

#include "ir/Statement.h"

#include <string>

namespace dotek::backends::fanuc {

std::string portText(const ir::Port& port);
// `DPRNT[X#100[53]]`; a blank is written as `*`.
std::string printText(const ir::Print& print);

} // namespace dotek::backends::fanuc
