#include "tests/Skips.h"

#include <fmt/format.h>

namespace dotek::tests {

namespace {

int& counter() {
  static int count = 0;
  return count;
}

} // namespace

void skip(std::string_view reason) {
  ++counter();
  fmt::print("skipped: {}\n", reason);
}

int skips() {
  return counter();
}

} // namespace dotek::tests
