// A line on the terminal while a command takes longer than a second.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

namespace dotek::cli {

// From its making to its end, or `stop`. It writes to standard error itself, so nothing else may write there
// meanwhile. Silent where standard error is no terminal that can erase a line.
class Progress {
public:
  // `command`: as it is typed.
  Progress(std::string_view command, bool wanted);
  ~Progress() { stop(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // How far it is, "12 of 40 cases"; from any thread.
  void say(std::string text);
  // Erases the line.
  void stop();

private:
  void run();

  std::string command_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::string text_;
  bool ended_ = false;
  std::thread thread_;
};

} // namespace dotek::cli
