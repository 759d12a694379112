#include "script/Serve.h"

#include "script/Engine.h"
#include "script/Protocol.h"
#include "script/Script.h"
#include "support/Version.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <new>
#include <optional>
#include <sys/resource.h>
#include <unistd.h>

namespace dotek::script {

namespace {

constexpr std::size_t kMostRequest = std::size_t{1} << 30;
constexpr double kSecondsForEach = 0.02; // that a run may take beside the limit

std::uint64_t numberOf(std::string_view text) {
  std::uint64_t out = 0;
  std::from_chars(text.data(), text.data() + text.size(), out);
  return out;
}

double processorSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

template <class Resource> void lower(Resource resource, double most) {
  rlimit now{};
  if (getrlimit(resource, &now) != 0) return;
  const auto wanted = static_cast<rlim_t>(most);
  now.rlim_cur = now.rlim_max == RLIM_INFINITY ? wanted : std::min(wanted, now.rlim_max);
  setrlimit(resource, &now);
}

// The processor's time of all runs together: a short allowance for each, and the limit beside it. The system
// ends the process where one run takes it all.
class Time {
public:
  explicit Time(double seconds) : limit_(seconds), left_(seconds) {}
  void begin() {
    began_ = processorSeconds();
    const double end = std::floor(began_ + left_) + 1; // the system counts in whole seconds
    if (end != end_) lower(RLIMIT_CPU, end);
    end_ = end;
  }
  // false: it is spent.
  bool finish() {
    left_ = std::min(limit_, left_ + kSecondsForEach - (processorSeconds() - began_));
    return left_ > 0;
  }

private:
  double limit_, left_, began_ = 0, end_ = 0;
};

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kSanitized = true;
#elif defined(__has_feature)
constexpr bool kSanitized = __has_feature(address_sanitizer);
#else
constexpr bool kSanitized = false;
#endif

// Beside the engine's own memory, which is one block: what reads requests and holds a value.
void limitMemory(std::size_t more) {
  if (kSanitized) return; // it takes all addresses there are
  std::FILE* const file = std::fopen("/proc/self/statm", "r");
  if (file == nullptr) return;
  unsigned long pages = 0;
  if (std::fscanf(file, "%lu", &pages) == 1)
    lower(RLIMIT_AS, static_cast<double>(pages) * static_cast<double>(sysconf(_SC_PAGESIZE)) +
                         static_cast<double>(more));
  std::fclose(file);
}

class Server {
public:
  int serve() {
    if (frames_.send(packed({kHello, kVersion})) != FrameEnd::State::Done) return 0;
    for (std::string request; frames_.receive(request, kMostRequest) == FrameEnd::State::Done;)
      if (frames_.send(answer(request)) != FrameEnd::State::Done) break;
    return 0;
  }

private:
  std::string answer(std::string_view frame) {
    const auto request = unpacked(frame);
    if (!request || request->empty()) return packed({kThrown, "a request that is none", "", ""});
    if (request->front() == kLoad && request->size() >= 4) return load(*request);
    if (request->front() == kRun && request->size() == 2 && engine_) return run((*request)[1]);
    return packed({kThrown, "a request that is none", "", ""});
  }

  std::string load(const std::vector<std::string>& request) {
    constexpr std::size_t kMegabyte = 1 << 20, kReserve = 64 * kMegabyte;
    if (!time_) time_.emplace(static_cast<double>(numberOf(request[1])));
    output_ = numberOf(request[3]);
    engine_.reset(); // its memory first
    engine_ = std::make_unique<Engine>(numberOf(request[2]) * kMegabyte);
    if (!limited_) limitMemory(kReserve + 4 * output_);
    limited_ = true;
    time_->begin();
    auto fault = engine_->load({request.begin() + 4, request.end()});
    if (!time_->finish()) return packed({kTime});
    return fault ? textOf(*fault) : packed({kValue});
  }

  std::string run(const std::string& argument) {
    time_->begin();
    std::vector<std::string> texts;
    const auto fault = engine_->run(argument, output_, texts);
    if (!time_->finish()) return packed({kTime});
    if (fault) return textOf(*fault);
    std::vector<std::string_view> out = {kValue};
    out.insert(out.end(), texts.begin(), texts.end());
    return packed(out);
  }

  static std::string textOf(const EngineFault& fault) {
    switch (fault.kind) {
    case EngineFault::Kind::Memory: return packed({kMemory});
    case EngineFault::Kind::Output: return packed({kOutput});
    case EngineFault::Kind::NoRoom: return packed({kNoRoom});
    case EngineFault::Kind::Thrown: break;
    }
    return packed({kThrown, fault.text, fault.source, std::to_string(fault.line)});
  }

  const FrameEnd frames_{STDIN_FILENO};
  std::unique_ptr<Engine> engine_;
  std::optional<Time> time_;
  std::size_t output_ = 0;
  bool limited_ = false;
};

} // namespace

int serve() {
  if (!becomeWorker()) {
    std::fputs("dotek: error: `script-worker` is started by Dotek itself, to run scripts\n", stderr);
    return 2;
  }
  try {
    return Server().serve();
  } catch (const std::bad_alloc&) {
    return kNoMemory;
  } catch (...) {
    return kEngineGaveUp;
  }
}

} // namespace dotek::script
