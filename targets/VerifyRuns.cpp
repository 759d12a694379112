#include "targets/VerifyRuns.h"

#include "support/messages/Verify.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <fmt/format.h>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>

namespace dotek::targets {

namespace {

constexpr std::uint64_t kEdgeShare = 10; // one edge case beside so many others
// How often other values are drawn for a case; less often once the first ones have shown that it is in vain.
constexpr std::uint32_t kReplaced = 23, kReplacedLater = 7;
constexpr std::uint64_t kFirst = 20;
constexpr std::uint64_t kEdges = std::uint64_t{1} << 62; // numbers of edge cases begin here

// The places of the checks are those of one thread's files, which all threads read alike.
void tellNoValues(CaseSubject& main, const std::vector<Rejection>& rejections) {
  constexpr std::size_t kMostTold = 4;
  std::uint32_t all = 0, refused = 0;
  const Rejection* first = nullptr;
  for (const Rejection& one : rejections) {
    all += one.count;
    if (!one.byConversion) continue;
    refused += one.count;
    if (first == nullptr) first = &one;
  }
  Diagnostics& said = main.session().diagnostics();
  Diagnostic& finding = first != nullptr
                            ? said.report<diag::ConversionRefused>(main.place(), refused, first->why)
                            : said.report<diag::NoValuesFound>(main.place(), all);
  const std::size_t told = std::min(rejections.size(), kMostTold);
  std::uint32_t others = first != nullptr ? refused : all;
  for (std::size_t i = 0; i < told; ++i) {
    if (first != nullptr && !rejections[i].byConversion) {
      finding.note(rejections[i].at,
                   fmt::format("besides, {} tries: {}", rejections[i].count, rejections[i].why));
      continue;
    }
    others -= rejections[i].count;
    finding.note(rejections[i].at, fmt::format("{} of them: {}", rejections[i].count, rejections[i].why));
  }
  if (others > 0) finding.note({}, fmt::format("{} of them: for other reasons", others));
}

} // namespace

bool runCases(const VerifyOptions& options, bool edges, CaseSubject& main,
              const std::function<std::unique_ptr<CaseSubject>()>& another, VerifyReport& report) {
  const std::uint64_t all = options.cases + (edges ? options.cases / kEdgeShare : 0);
  std::atomic<std::uint64_t> next = 0, done = 0, end = all;
  std::atomic<bool> stop = false;
  std::mutex mutex;
  std::vector<Rejection> noValues;
  // What says nothing for its values alone is compared, and others are drawn for it.
  const auto replace = [&](CaseSubject& runner, std::uint64_t n, verify::Case& drawn, CaseResult& result) {
    const std::uint32_t most = n < kFirst ? kReplaced : kReplacedLater;
    for (std::uint32_t i = 0; i < most; ++i) {
      std::optional<verify::Case> other = runner.another(n);
      if (!other) return;
      CaseResult ran = runner.run(*other);
      if (runner.stopped()) return;
      if (ran.ofValues) continue;
      const std::lock_guard lock(mutex);
      report.addReplaced(n, std::move(drawn), std::move(result));
      drawn = std::move(*other);
      result = std::move(ran);
      return;
    }
  };
  const auto work = [&](CaseSubject& runner) {
    for (std::uint64_t n = next++; n < end && !stop; n = next++) {
      const bool edge = n >= options.cases;
      std::optional<verify::Case> drawn;
      if (edge)
        drawn = runner.edge(n - options.cases);
      else
        drawn = runner.draw(n);
      const auto stopped = [&] {
        if (!runner.stopped()) return false;
        // Cases before it are others' and come to their end, so that the first one is reported.
        const std::lock_guard lock(mutex);
        end = std::min<std::uint64_t>(end, n);
        report.addStopped(n, *runner.stopped());
        return true;
      };
      if (stopped()) return;
      if (!drawn) {
        const std::lock_guard lock(mutex);
        noValues = runner.rejections();
        stop = true;
        return;
      }
      CaseResult result = runner.run(*drawn);
      if (stopped()) return;
      if (!edge && result.ofValues) replace(runner, n, *drawn, result);
      if (stopped()) return;
      const std::lock_guard lock(mutex);
      if (options.traces) options.traces(n, result.verdict == CaseVerdict::Agrees, result.trace);
      report.add(edge ? kEdges + n : n, edge, std::move(*drawn), std::move(result));
      const std::uint64_t finished = ++done;
      if (options.progress) options.progress(fmt::format("{} of {} cases", finished, all));
      if (n == 0) return;
    }
  };
  std::uint32_t jobs = options.jobs != 0 ? options.jobs : std::max(1U, std::thread::hardware_concurrency());
  jobs = static_cast<std::uint32_t>(std::min<std::uint64_t>(jobs, std::max<std::uint64_t>(1, all / 32)));
  // What is thrown ends all threads, and then the command.
  std::exception_ptr thrown;
  const auto guardedWork = [&](CaseSubject& runner) {
    try {
      work(runner);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!thrown) thrown = std::current_exception();
      stop = true;
    }
  };
  // Without a thread, or memory for one, the others do its work.
  const auto help = [&] {
    std::unique_ptr<CaseSubject> runner;
    try {
      runner = another();
    } catch (const std::bad_alloc&) {
      return;
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!thrown) thrown = std::current_exception();
      stop = true;
    }
    if (runner) guardedWork(*runner);
  };
  // The first case alone: what no case survives is found once.
  guardedWork(main);
  std::vector<std::thread> threads;
  try {
    for (std::uint32_t i = 1; i < jobs && next < end && !stop; ++i)
      threads.emplace_back(help);
  } catch (const std::system_error&) {
  } catch (const std::bad_alloc&) {
  }
  guardedWork(main);
  for (std::thread& thread : threads)
    thread.join();
  if (thrown) std::rethrow_exception(thrown);
  if (report.tellStopped()) return false;
  if (!stop) return true;
  main.session().diagnostics() = Diagnostics();
  tellNoValues(main, noValues);
  return false;
}

} // namespace dotek::targets
