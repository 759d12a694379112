// Private to script: the JavaScript engine. Only a worker runs it. The only user of Duktape.
#pragma once

#include "script/Arena.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

struct duk_hthread;

namespace dotek::script {

// Why there is no value: something was thrown, what ran out, or NoRoom: the system gives no memory to begin
// with.
struct EngineFault {
  enum class Kind : unsigned char { Thrown, Memory, Output, NoRoom };
  Kind kind = Kind::Thrown;
  std::string text, source; // as of Fault
  std::uint32_t line = 0;
};

// Every call into the engine is protected: what a script throws, also from a getter or from toString, is a
// fault. Where even that fails, for want of memory, the process ends with the status kEngineGaveUp.
class Engine {
public:
  explicit Engine(std::size_t memory);
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  // The sources in their order, name and text in turn; the value of the first one is what run() calls.
  std::optional<EngineFault> load(const std::vector<std::string_view>& sources);
  // Everything is as load() left it; the function gets the value of the JSON text. `texts`: what it gives, of
  // together at most `most` bytes.
  std::optional<EngineFault> run(std::string_view argument, std::size_t most,
                                 std::vector<std::string>& texts);

private:
  EngineFault thrown(); // what lies on top of the stack, taken away
  void placeOf(EngineFault& fault, std::string_view trace) const;

  Arena arena_;
  duk_hthread* heap_ = nullptr; // in the arena, which frees it
  std::vector<std::string> names_;
};

} // namespace dotek::script
