// Private to script: the memory of one engine, a block of fixed size that can be put back as it was.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace dotek::script {

// Pieces of like sizes are kept in lists, and nothing is joined again: a script that needs more than there is
// has to be stopped anyway.
class Arena {
public:
  explicit Arena(std::size_t bytes);
  ~Arena();
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  bool good() const { return base_ != nullptr; } // false: the system gave none
  // nullptr where there is none left. Aligned to 8 bytes.
  void* take(std::size_t size);
  void* resize(void* piece, std::size_t size);
  void give(void* piece);
  bool ranOut() const { return ranOut_; } // since save() or restore()
  // What the engine threw for want of memory or of room for calls, whether or not a script caught it;
  // nullptr.
  const char* threw = nullptr;

  void save();
  void restore(); // what save() saw

private:
  static constexpr std::size_t kKinds = 160;
  struct State {
    std::size_t used = 0;
    std::array<void*, kKinds> free{};
  };
  static std::size_t kindOf(std::size_t size);
  static std::size_t sizeOf(std::size_t kind);

  char* base_ = nullptr;
  std::size_t bytes_ = 0;
  State state_, savedState_;
  std::string saved_;
  bool ranOut_ = false;
  const char* savedThrew_ = nullptr;
};

} // namespace dotek::script
