// Test cases that have to do without what they need of the machine: printed with the reason and counted.
// Those without the corpus are counted by haveCorpus() of GoldenRunner.h.
#pragma once

#include <string_view>

namespace dotek::tests {

// The test case that calls it returns afterwards.
void skip(std::string_view reason);
int skips(); // so far, of this process

} // namespace dotek::tests
