#include "script/Script.h"

#include "script/Protocol.h"
#include "support/Version.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <csignal>
#include <fmt/format.h>

namespace dotek::script {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds kGreetingPatience{30'000}; // of a machine that does much else
constexpr std::size_t kMostGreeting = 1000;
constexpr std::size_t kMostAround = 1 << 16; // lengths, names and what was thrown, beside the output

// Longer than the processor's time that is allowed, on a machine that does other work too.
milliseconds patienceOf(const Options& options) {
  return milliseconds(2'000 + 2'000 * std::int64_t{options.seconds});
}

Fault stopped(std::string text) {
  return {Fault::Kind::Stopped, std::move(text), "", 0};
}

Fault tooLong(const Options& options) {
  return stopped(fmt::format("it has no end or is too slow; it may compute for {} s, and `--limit "
                             "script-seconds=N` gives it more",
                             options.seconds));
}

Fault tooLarge(const Options& options) {
  return stopped(fmt::format("it needs more than {} MB of memory; `--limit script-memory=MB` gives it more",
                             options.memory));
}

} // namespace

Fault tooMuchOutput(const Options& options) {
  return stopped(fmt::format(
      "it writes more than {} bytes in one run; `--limit script-output=N` gives it more", options.output));
}

Fault Runner::faultOf(const Worker::End& end) const {
  using Kind = Worker::End::Kind;
  // On a machine that does other work, patience ends before the processor's time does.
  if (end.kind == Kind::Silent || (end.kind == Kind::Signal && end.code == SIGXCPU)) return tooLong(options_);
  if (end.kind == Kind::Exit && end.code == kNoMemory) return tooLarge(options_);
  if (end.kind == Kind::Exit && end.code == kEngineGaveUp)
    return stopped("the script engine gave up, for want of memory or of room for calls");
  return stopped("its process ended by itself: " + endText(end));
}

std::optional<Fault> Runner::start() {
  const auto refused = [](std::string why) { return Fault{Fault::Kind::NoWorker, std::move(why), "", 0}; };
  if (options_.program.empty())
    return refused("no program is named that runs scripts; who uses Dotek as a library names `dotek` in "
                   "`CommonOptions::scriptProgram`");
  std::string why;
  worker_ = Worker::start(options_.program, {std::string(kWorkerCommand)}, why);
  if (worker_ == nullptr)
    return refused(fmt::format("`{}`, which runs scripts, does not start: {}", options_.program, why));
  const std::optional<std::string> greeting = worker_->greeting(kMostGreeting, kGreetingPatience);
  if (greeting == packed({kHello, kVersion})) return std::nullopt;
  const std::string end = greeting ? "it is another version" : endText(worker_->end());
  worker_.reset();
  return refused(fmt::format("`{}` does not run scripts for this version of Dotek ({}): {}", options_.program,
                             kVersion, end));
}

std::variant<Texts, Fault> Runner::ask(const std::vector<std::string_view>& request) {
  if (lost_) return *lost_;
  const std::optional<std::string> frame =
      worker_->ask(packed(request), std::size_t{options_.output} + kMostAround, patienceOf(options_));
  if (!frame) {
    lost_ = faultOf(worker_->end());
    return *lost_;
  }
  auto texts = unpacked(*frame);
  if (!texts || texts->empty()) return stopped("its process answers with what is no answer");
  const std::string kind = std::move(texts->front());
  texts->erase(texts->begin());
  if (kind == kValue) return std::move(*texts);
  if (kind == kMemory) return tooLarge(options_);
  if (kind == kTime) return tooLong(options_);
  if (kind == kOutput) return tooMuchOutput(options_);
  if (kind == kNoRoom)
    return Fault{
        Fault::Kind::NoWorker,
        fmt::format("the system gives no {} MB of memory for one; `--limit script-memory=MB` asks for less",
                    options_.memory),
        "", 0};
  texts->resize(3);
  std::uint32_t line = 0;
  std::from_chars((*texts)[2].data(), (*texts)[2].data() + (*texts)[2].size(), line);
  return Fault{Fault::Kind::Script, std::move((*texts)[0]), std::move((*texts)[1]), line};
}

std::optional<Fault> Runner::load(const std::vector<Source>& sources) {
  if (worker_ == nullptr)
    if (std::optional<Fault> fault = start()) return fault;
  const std::string limits[] = {std::to_string(options_.seconds), std::to_string(options_.memory),
                                std::to_string(options_.output)};
  std::vector<std::string_view> request = {kLoad, limits[0], limits[1], limits[2]};
  for (const Source& one : sources) {
    request.push_back(one.name);
    request.push_back(one.text);
  }
  auto answer = ask(request);
  if (Fault* fault = std::get_if<Fault>(&answer)) return std::move(*fault);
  return std::nullopt;
}

std::variant<Texts, Fault> Runner::run(std::string_view argument) {
  if (worker_ == nullptr) return Fault{Fault::Kind::NoWorker, "no script is loaded", "", 0};
  return ask({kRun, argument});
}

} // namespace dotek::script
