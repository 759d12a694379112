#include "tests/Workers.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <iostream>
#include <map>
#include <memory>
#include <new>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace dotek::tests {

namespace {

// Of one child, written by it and read by the parent once it has ended.
struct Slot {
  Totals totals;
  unsigned current = 0;
  bool running = false; // a case
};

struct Shared {
  std::atomic<unsigned> next = 0;
};

// Memory that the children share with their parent.
template <class T> class SharedArray {
public:
  explicit SharedArray(std::size_t size) : bytes_(size * sizeof(T)) {
    void* memory = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    items_ = static_cast<T*>(memory);
    for (std::size_t i = 0; i < size; ++i)
      new (items_ + i) T();
  }
  ~SharedArray() { munmap(items_, bytes_); }
  SharedArray(const SharedArray&) = delete;
  SharedArray& operator=(const SharedArray&) = delete;
  T& operator[](std::size_t i) { return items_[i]; }

private:
  std::size_t bytes_;
  T* items_ = nullptr;
};

void flushAll() {
  std::cout.flush();
  std::cerr.flush();
  std::fflush(nullptr);
}

void writeAll(int to, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t wrote = write(to, text.data() + done, text.size() - done);
    if (wrote <= 0) return;
    done += static_cast<std::size_t>(wrote);
  }
}

// Where a child's output goes until its case has ended.
class Capture {
public:
  Capture() : file_(std::tmpfile()) {
    if (file_ == nullptr) throw std::bad_alloc();
  }
  ~Capture() { std::fclose(file_); }
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  void redirect() const {
    dup2(fileno(file_), STDOUT_FILENO);
    dup2(fileno(file_), STDERR_FILENO);
  }
  void pass(int to) const {
    const int from = fileno(file_);
    std::string text(static_cast<std::size_t>(lseek(from, 0, SEEK_END)), '\0');
    if (pread(from, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size())) writeAll(to, text);
    if (ftruncate(from, 0) == 0) lseek(from, 0, SEEK_SET);
  }

private:
  std::FILE* file_;
};

struct Child {
  std::size_t slot = 0;
  std::unique_ptr<Capture> capture;
};

class Pool {
public:
  Pool(unsigned jobs, unsigned count, const std::function<Totals(unsigned)>& one,
       const std::function<std::string(unsigned)>& name)
      // Each case may end a child, and a child may end after its last case.
      : jobs_(jobs), count_(count), one_(one), name_(name), shared_(1),
        slots_(jobs + 2 * std::size_t{count}) {}

  Totals run() {
    for (unsigned i = 0; i < jobs_; ++i)
      start();
    Totals out;
    while (!children_.empty()) {
      int status = 0;
      const pid_t ended = wait(&status);
      const auto found = children_.find(ended);
      if (ended < 0) break;
      if (found == children_.end()) continue;
      const Slot& slot = slots_[found->second.slot];
      out += slot.totals;
      if (status != 0) {
        flushAll();
        found->second.capture->pass(STDOUT_FILENO);
        const std::string how = WIFSIGNALED(status) ? fmt::format("signal {}", WTERMSIG(status))
                                                    : fmt::format("status {}", WEXITSTATUS(status));
        const std::string where =
            slot.running ? fmt::format("`{}`", name_(slot.current)) : "its last test case";
        fmt::print("a process ended with {} {} {}\n", how, slot.running ? "in" : "after", where);
        ++out.failed;
        if (slot.running) ++out.ran;
      }
      children_.erase(found);
      if (status != 0 && shared_[0].next < count_) start();
    }
    if (shared_[0].next < count_) {
      fmt::print("{} test cases did not run: no process for them\n", count_ - shared_[0].next);
      ++out.failed;
    }
    return out;
  }

private:
  void start() {
    Child child{used_++, std::make_unique<Capture>()};
    flushAll();
    const pid_t id = fork();
    if (id == 0) work(slots_[child.slot], *child.capture);
    if (id > 0) children_.emplace(id, std::move(child));
  }

  [[noreturn]] void work(Slot& slot, const Capture& capture) {
    const int to = dup(STDOUT_FILENO);
    capture.redirect();
    while (true) {
      slot.current = shared_[0].next++;
      if (slot.current >= count_) break;
      slot.running = true;
      slot.totals += one_(slot.current);
      slot.running = false;
      flushAll();
      capture.pass(to);
    }
    std::exit(0); // and not _exit: the leak check comes last
  }

  unsigned jobs_;
  unsigned count_;
  const std::function<Totals(unsigned)>& one_;
  const std::function<std::string(unsigned)>& name_;
  SharedArray<Shared> shared_;
  SharedArray<Slot> slots_;
  std::size_t used_ = 0;
  std::map<pid_t, Child> children_;
};

} // namespace

Totals& Totals::operator+=(const Totals& other) {
  ran += other.ran;
  failed += other.failed;
  goldens += other.goldens;
  rewritten += other.rewritten;
  corpusRun += other.corpusRun;
  corpusSkipped += other.corpusSkipped;
  skipped += other.skipped;
  return *this;
}

Totals runInProcesses(unsigned jobs, unsigned count, const std::function<Totals(unsigned)>& one,
                      const std::function<std::string(unsigned)>& name) {
  return Pool(jobs, count, one, name).run();
}

} // namespace dotek::tests
