// Preloaded into a program (LD_PRELOAD): the most bytes of its heap that were in use at once, written to the
// file that DOTEK_BENCH_HEAP names. Counts what the program asks for, so the figure is the same in each run,
// where the resident set depends on what was freed before and on what the machine does besides. The file is
// shared memory: however the program ends, it holds the figure.
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <fcntl.h>
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

// The allocator of the GNU C library under its own names.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);
}

namespace {

struct Counts {
  std::atomic<std::int64_t> most;
  std::atomic<std::int64_t> now;
};

Counts own{};
std::atomic<Counts*> counts = &own; // until the file is mapped; then the file's

void add(std::int64_t bytes) {
  Counts& all = *counts.load(std::memory_order_relaxed);
  const std::int64_t now = all.now.fetch_add(bytes, std::memory_order_relaxed) + bytes;
  std::int64_t most = all.most.load(std::memory_order_relaxed);
  while (now > most && !all.most.compare_exchange_weak(most, now, std::memory_order_relaxed)) {
  }
}

void* counted(void* memory) {
  if (memory != nullptr) add(static_cast<std::int64_t>(malloc_usable_size(memory)));
  return memory;
}

__attribute__((constructor)) void begin() {
  const char* const path = std::getenv("DOTEK_BENCH_HEAP");
  if (path == nullptr) return;
  const int file = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) return;
  if (ftruncate(file, sizeof(Counts)) == 0) {
    void* const mapped = mmap(nullptr, sizeof(Counts), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (mapped != MAP_FAILED) {
      auto* const shared = static_cast<Counts*>(mapped);
      shared->now.fetch_add(own.now.load());
      counts.store(shared);
    }
  }
  close(file);
}

} // namespace

extern "C" {

__attribute__((visibility("default"))) void* malloc(std::size_t size) {
  return counted(__libc_malloc(size));
}

__attribute__((visibility("default"))) void* calloc(std::size_t count, std::size_t size) {
  return counted(__libc_calloc(count, size));
}

__attribute__((visibility("default"))) void* realloc(void* memory, std::size_t size) {
  const std::int64_t before = memory != nullptr ? static_cast<std::int64_t>(malloc_usable_size(memory)) : 0;
  void* const moved = __libc_realloc(memory, size);
  if (moved != nullptr || size == 0) add(-before);
  return counted(moved);
}

__attribute__((visibility("default"))) void* memalign(std::size_t alignment, std::size_t size) {
  return counted(__libc_memalign(alignment, size));
}

__attribute__((visibility("default"))) void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return counted(__libc_memalign(alignment, size));
}

__attribute__((visibility("default"))) int posix_memalign(void** out, std::size_t alignment,
                                                          std::size_t size) {
  void* const memory = counted(__libc_memalign(alignment, size));
  if (memory == nullptr) return ENOMEM;
  *out = memory;
  return 0;
}

__attribute__((visibility("default"))) void free(void* memory) {
  if (memory != nullptr) add(-static_cast<std::int64_t>(malloc_usable_size(memory)));
  __libc_free(memory);
}
}
