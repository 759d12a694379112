// Each folder of tests/golden with a `cmd` is a test case of its own, `golden AREA/CASE`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dotek::tests {

// Below `root`, sorted; with forward slashes, relative to it.
std::vector<std::string> goldenNames(const std::filesystem::path& root);

// Names of files below `root` whose text comes from the corpus or the reference: the lines of
// `root`/REFERENCE but for comments.
std::vector<std::string> referenceFiles(const std::filesystem::path& root);

struct GoldenFile {
  std::filesystem::path root; // of the goldens
  std::filesystem::path file;
  std::string absent; // what a missing file means
};

// Compares, and with `update` rewrites the file, but for one of the reference. "": both are equal now; else
// what differs.
std::string settle(const GoldenFile& golden, const std::string& actual, bool update, int& rewritten);

// Registers one test case each. Call it once, before doctest runs.
void registerGoldens();

} // namespace dotek::tests
