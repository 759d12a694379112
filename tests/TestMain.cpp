#define DOCTEST_CONFIG_IMPLEMENT
#include "tests/GoldenRunner.h"

#include <cstring>
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <optional>

namespace {

// Of the run that just ended; nothing where only a list was asked for. doctest hands it to listeners only,
// which it makes itself.
std::optional<doctest::TestRunStats>& lastRun() {
  static std::optional<doctest::TestRunStats> stats;
  return stats;
}

class Counter : public doctest::IReporter {
public:
  explicit Counter(const doctest::ContextOptions&) {}
  void test_run_end(const doctest::TestRunStats& stats) override { lastRun() = stats; }

  void report_query(const doctest::QueryData&) override {}
  void test_run_start() override {}
  void test_case_start(const doctest::TestCaseData&) override {}
  void test_case_reenter(const doctest::TestCaseData&) override {}
  void test_case_end(const doctest::CurrentTestCaseStats&) override {}
  void test_case_exception(const doctest::TestCaseException&) override {}
  void subcase_start(const doctest::SubcaseSignature&) override {}
  void subcase_end() override {}
  void log_assert(const doctest::AssertData&) override {}
  void log_message(const doctest::MessageData&) override {}
  void test_case_skipped(const doctest::TestCaseData&) override {}
};
REGISTER_LISTENER("counter", 1, Counter);

} // namespace

// `dotek_tests --update` rewrites the goldens that differ; all other arguments are doctest's. The last line
// is `N passed, N failed`.
int main(int argc, char** argv) {
  doctest::Context context;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--update") == 0) dotek::tests::settings().update = true;
  }
  context.applyCommandLine(argc, argv);
  const int result = context.run();
  if (!lastRun()) return result;
  const auto& settings = dotek::tests::settings();
  const unsigned ran = lastRun()->numTestCasesPassingFilters;
  const unsigned failed = lastRun()->numTestCasesFailed;
  fmt::print("goldens: {} run, {} rewritten; corpus cases: {} run, {} skipped{}\n", settings.run,
             settings.rewritten, settings.corpusRun, settings.corpusSkipped,
             settings.corpusSkipped > 0 ? " (no corpus: set DOTEK_CORPUS)" : "");
  if (settings.toolSkipped > 0) fmt::print("skipped without their tool: {}\n", settings.toolSkipped);
  fmt::print("{} passed, {} failed\n", ran - failed, failed);
  // A filter that matches nothing proves nothing.
  return ran == 0 ? 1 : result;
}
