// Which numbered blocks something goes to. A number that nothing goes to changes nothing.
#pragma once

#include "frontend/macrob/Ast.h"

namespace dotek::frontend::macrob {

// Sets Block::target: of a GOTO and of M97 P, the local subprogram of a Haas, in the program; of M99 P and
// M98 Q anywhere in the file, since they go on in a program that calls or is called; of G70 to G73 P Q, which
// name the blocks of a contour. A number that is computed, or a GOTO that could not be read, may go to every
// number.
void markTargets(File& file);

} // namespace dotek::frontend::macrob
