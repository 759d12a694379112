#define DOCTEST_CONFIG_IMPLEMENT
#include "tests/GoldenRunner.h"

#include <cstdlib>
#include <cstring>
#include <doctest/doctest.h>
#include <filesystem>
#include <fmt/format.h>

// `dotek_tests --update` rewrites the goldens that differ; all other arguments are doctest's.
int main(int argc, char** argv) {
  doctest::Context context;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--update") == 0) dotek::tests::settings().update = true;
  }
  context.applyCommandLine(argc, argv);
  const int result = context.run();
  if (context.shouldExit()) return result;
  const auto& settings = dotek::tests::settings();
  fmt::print("goldens: {} run, {} rewritten; corpus cases: {} run, {} skipped{}\n", settings.run,
             settings.rewritten, settings.corpusRun, settings.corpusSkipped,
             settings.corpusSkipped > 0 ? " (no corpus: set DOTEK_CORPUS)" : "");
  return result;
}
