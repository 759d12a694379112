// A process that works for this one: a program started anew, spoken to in frames, gone with its owner.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <vector>

namespace dotek {

// What a process is handed as standard input: one end of a pair of connected sockets. A frame is a length
// and so many bytes. Nothing here raises SIGPIPE; an interrupted call goes on.
class FrameEnd {
public:
  enum class State : unsigned char { Done, Closed, Late, TooLong };
  using Clock = std::chrono::steady_clock;

  explicit FrameEnd(int descriptor) : descriptor_(descriptor) {}
  // nullopt as the deadline: waits as long as it takes.
  State send(std::string_view frame, std::optional<Clock::time_point> deadline = std::nullopt) const;
  // At most `most` bytes; a longer frame is not read.
  State receive(std::string& frame, std::size_t most,
                std::optional<Clock::time_point> deadline = std::nullopt) const;

private:
  State wait(short events, const std::optional<Clock::time_point>& deadline) const;
  State take(char* bytes, std::size_t size, const std::optional<Clock::time_point>& deadline) const;

  int descriptor_;
};

class Worker {
public:
  // How the process ended. Silent: it did not answer in time, and was ended. Unknown: the system does not
  // say.
  struct End {
    enum class Kind : unsigned char { Exit, Signal, Silent, Unknown };
    Kind kind = Kind::Unknown;
    int code = 0; // exit status or number of the signal
  };

  // Starts `program` (a path) with arguments. Its standard output is nowhere, its signals are those of the
  // system, its process group is its own. nullptr: `why` says what the system refused.
  static std::unique_ptr<Worker> start(const std::string& program, const std::vector<std::string>& arguments,
                                       std::string& why);
  ~Worker(); // ends the process
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  // Sends a frame and waits for the one that answers it. nullopt: there is none, end() says why, and the
  // process is gone.
  std::optional<std::string> ask(std::string_view frame, std::size_t most,
                                 std::chrono::milliseconds patience);
  // The first frame of a process that speaks first.
  std::optional<std::string> greeting(std::size_t most, std::chrono::milliseconds patience);
  const End& end() const { return end_; } // after an answer that did not come

private:
  Worker(pid_t process, int descriptor) : process_(process), descriptor_(descriptor), frames_(descriptor) {}
  std::optional<std::string> answer(FrameEnd::State sent, std::size_t most,
                                    FrameEnd::Clock::time_point deadline);
  void finish();

  pid_t process_; // -1: gone
  int descriptor_;
  FrameEnd frames_;
  End end_;
};

// "signal 11 (Segmentation fault)", "exit status 3", "no answer"
std::string endText(const Worker::End& end);

// For the process itself, as the first thing it does: closes what it inherited, dumps no core, and ends where
// its parent does. false: its standard input is no end of a Worker.
bool becomeWorker();

// A path at which this program can be started anew; "": the system does not say.
std::string runningProgram();

// Several texts as one frame, and back; nullopt: it is no such frame.
std::string packed(const std::vector<std::string_view>& texts);
std::optional<std::vector<std::string>> unpacked(std::string_view frame);

} // namespace dotek
