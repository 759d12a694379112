#include "tests/Draws.h"

namespace dotek::tests {

bool fewDraws() {
#ifdef DOTEK_SANITIZE
  return true;
#else
  return false;
#endif
}

} // namespace dotek::tests
