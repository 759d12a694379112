// Scripts (JavaScript, ES5) run in a process of their own: who runs one needs this header alone.
#pragma once

#include "support/Limits.h"
#include "support/Worker.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace dotek::script {

// The one argument of a program that is started to run scripts.
inline constexpr std::string_view kWorkerCommand = "script-worker";

struct Options {
  std::string program;       // path of a program that serves (Serve.h), as `dotek` does; "": there is none
  std::uint32_t seconds = 3; // Limits::scriptSeconds
  std::uint32_t memory = 64; // Limits::scriptMemory, MB
  std::uint32_t output = 1u << 20; // Limits::scriptOutput, bytes

  Options() = default;
  Options(std::string path, const Limits& limits)
      : program(std::move(path)), seconds(limits.scriptSeconds), memory(limits.scriptMemory),
        output(limits.scriptOutput) {}
};

struct Source {
  std::string_view name; // in places
  std::string_view text; // UTF-8
};

// Why there is no value.
struct Fault {
  // Script: its own text is wrong, it threw, or its value is none; it may run again. Stopped: a limit, or its
  // process ended. NoWorker: the system, or who called, gives no process.
  enum class Kind : std::uint8_t { Script, Stopped, NoWorker };
  Kind kind = Kind::Script;
  std::string text;       // "TypeError: ...", "it computed for more than 3 seconds, ..."
  std::string source;     // of the innermost place that is known; "": none is
  std::uint32_t line = 0; // from 1; 0: not known
};

// What a script that wrote more than Options::output is stopped with.
Fault tooMuchOutput(const Options& options);

using Texts = std::vector<std::string>;

// One process, which keeps one set of scripts. Each run finds them as they were when they had been loaded,
// whatever runs before it changed. For one thread, which outlives it.
class Runner {
public:
  explicit Runner(Options options) : options_(std::move(options)) {}

  const Options& options() const { return options_; }
  // Evaluates the sources, one after the other, in place of those before; the process is started with the
  // first. The value of the first source is a function, which run() calls.
  std::optional<Fault> load(const std::vector<Source>& sources);
  // The function's value for one argument, given as JSON: an array of texts.
  std::variant<Texts, Fault> run(std::string_view argument);

private:
  std::optional<Fault> start();
  std::variant<Texts, Fault> ask(const std::vector<std::string_view>& request);
  Fault faultOf(const Worker::End& end) const;

  Options options_;
  std::unique_ptr<Worker> worker_;
  std::optional<Fault> lost_; // the process ended: what every run comes to
};

} // namespace dotek::script
