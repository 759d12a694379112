#define DOCTEST_CONFIG_IMPLEMENT
#include "script/Script.h"
#include "script/Serve.h"
#include "tests/GoldenRunner.h"
#include "tests/Goldens.h"
#include "tests/Skips.h"
#include "tests/Workers.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fs = std::filesystem;
using namespace dotek::tests;

namespace {

// Of the run or query that just ended. doctest hands both to listeners only, which it makes itself.
struct Heard {
  bool ran = false; // false: a query
  unsigned cases = 0;
  unsigned failed = 0;
  std::vector<std::string> names; // of a query
};
Heard& heard() {
  static Heard instance;
  return instance;
}

class Listener : public doctest::IReporter {
public:
  explicit Listener(const doctest::ContextOptions&) {}
  void report_query(const doctest::QueryData& in) override {
    for (unsigned i = 0; i < in.num_data; ++i)
      heard().names.emplace_back(in.data[i]->m_name);
  }
  void test_run_start() override { heard().ran = true; }
  void test_run_end(const doctest::TestRunStats& stats) override {
    heard().failed = stats.numTestCasesFailed;
  }
  void test_case_start(const doctest::TestCaseData&) override { ++heard().cases; }
  void test_case_reenter(const doctest::TestCaseData&) override {}
  void test_case_end(const doctest::CurrentTestCaseStats&) override {}
  void test_case_exception(const doctest::TestCaseException&) override {}
  void subcase_start(const doctest::SubcaseSignature&) override {}
  void subcase_end() override {}
  void log_assert(const doctest::AssertData&) override {}
  void log_message(const doctest::MessageData&) override {}
  void test_case_skipped(const doctest::TestCaseData&) override {}
};
REGISTER_LISTENER("listener", 1, Listener);

// `--list-test-cases --reporters=ctest`: the cases as commands of a file that ctest includes
// (discover.cmake).
class CTestReporter : public Listener {
public:
  explicit CTestReporter(const doctest::ContextOptions& options) : Listener(options), out_(*options.cout) {}
  void report_query(const doctest::QueryData& in) override {
    for (unsigned i = 0; i < in.num_data; ++i) {
      const std::string name = in.data[i]->m_name;
      std::string filter;
      for (const char c : name) {
        if (c == ',' || c == '\\') filter += '\\';
        filter += c;
      }
      const std::string kind = name.substr(0, name.find_first_of(" :"));
      out_ << fmt::format("dotek_case([==[{}]==] [==[--test-case={}]==] {})\n", name, filter,
                          kind == "golden" || kind == "policy" ? kind : std::string("unit"));
    }
  }

private:
  std::ostream& out_;
};
REGISTER_REPORTER("ctest", 0, CTestReporter);

// Files of one process do not meet those of another.
class TemporaryFolder {
public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "dotek-tests-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) return;
    path_ = name;
    setenv("TMPDIR", name.c_str(), 1);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  // For a child process, below that of its parent.
  void own(unsigned number) const {
    const fs::path folder = path_ / std::to_string(number);
    fs::create_directories(folder);
    setenv("TMPDIR", folder.c_str(), 1);
  }

private:
  fs::path path_;
};

class Run {
public:
  Run(int argc, char** argv) : argc_(argc), argv_(argv) {
    for (int i = 1; i < argc; ++i) {
      const std::string_view argument = argv[i];
      if (argument == "--update")
        settings().update = true;
      else if (argument.starts_with("--jobs="))
        std::from_chars(argument.data() + 7, argument.data() + argument.size(), jobs_);
      else if (!isFilter(argument))
        divisible_ = false;
    }
  }

  int all() {
    if (jobs_ > 1 && divisible_) {
      std::vector<const char*> arguments(argv_, argv_ + argc_);
      arguments.insert(arguments.end(), {"--list-test-cases", "--reporters=none"});
      doctest::Context(static_cast<int>(arguments.size()), arguments.data()).run();
      const std::vector<std::string> names = std::move(heard().names);
      const auto count = static_cast<unsigned>(names.size());
      if (count > 1)
        return end(runInProcesses(
            std::min(jobs_, count), count, [this](unsigned i) { return one(i); },
            [&](unsigned i) { return names[i]; }));
    }
    doctest::Context context(argc_, argv_);
    const int result = context.run();
    return heard().ran ? end(totals()) : result;
  }

private:
  // Arguments that only choose cases, or what is printed of each.
  static bool isFilter(std::string_view argument) {
    static constexpr std::string_view kNames[] = {"tc",       "test-case",
                                                  "tce",      "test-case-exclude",
                                                  "ts",       "test-suite",
                                                  "tse",      "test-suite-exclude",
                                                  "sf",       "source-file",
                                                  "sfe",      "source-file-exclude",
                                                  "cs",       "case-sensitive",
                                                  "duration", "d",
                                                  "success",  "s"};
    while (argument.starts_with('-'))
      argument.remove_prefix(1);
    const std::string_view name = argument.substr(0, argument.find('='));
    return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
  }

  // The case number `i` of those chosen.
  Totals one(unsigned i) {
    if (!inChild_) temporary_.own(i);
    inChild_ = true;
    heard() = {};
    const Totals before = counters();
    doctest::Context context(argc_, argv_);
    context.setOption("first", static_cast<int>(i + 1));
    context.setOption("last", static_cast<int>(i + 1));
    context.setOption("minimal", true);
    context.run();
    Totals out = totals();
    out.goldens -= before.goldens;
    out.rewritten -= before.rewritten;
    out.corpusRun -= before.corpusRun;
    out.corpusSkipped -= before.corpusSkipped;
    out.skipped -= before.skipped;
    return out;
  }

  static Totals counters() {
    Totals out;
    out.goldens = settings().run;
    out.rewritten = settings().rewritten;
    out.corpusRun = settings().corpusRun;
    out.corpusSkipped = settings().corpusSkipped;
    out.skipped = skips() + settings().toolSkipped;
    return out;
  }

  static Totals totals() {
    Totals out = counters();
    out.ran = heard().cases;
    out.failed = heard().failed;
    return out;
  }

  // The last two lines; a filter that matches nothing proves nothing.
  static int end(const Totals& totals) {
    fmt::print("goldens: {} run, {} rewritten; corpus cases: {} run, {} skipped{}; other cases skipped: {}\n",
               totals.goldens, totals.rewritten, totals.corpusRun, totals.corpusSkipped,
               totals.corpusSkipped > 0 ? " (no corpus: set DOTEK_CORPUS)" : "", totals.skipped);
    fmt::print("{} passed, {} failed\n", totals.ran - std::min(totals.ran, totals.failed), totals.failed);
    return totals.ran == 0 || totals.failed > 0 ? 1 : 0;
  }

  int argc_;
  char** argv_;
  unsigned jobs_ = 1;
  bool divisible_ = true;
  bool inChild_ = false;
  TemporaryFolder temporary_;
};

} // namespace

// `dotek_tests --update` rewrites the goldens that differ, `--jobs=N` takes N processes; all other arguments
// are doctest's. The last line is `N passed, N failed`. What is tested has its scripts run by this program,
// too.
int main(int argc, char** argv) {
  if (argc == 2 && argv[1] == dotek::script::kWorkerCommand) return dotek::script::serve();
  registerGoldens();
  return Run(argc, argv).all();
}
