// A folder for `--data` in tests, removed at the end.
#pragma once

#include "tests/TestFolder.h"

#include <random>
#include <string>

namespace dotek::tests {

// Several may be open in one test.
class DataFolder : public TestFolder {
public:
  DataFolder() : TestFolder("dotek-data-" + std::to_string(std::random_device()())) {}
  std::string path() const { return TestFolder::path().string(); }
};

} // namespace dotek::tests
