#include "script/Arena.h"

#include <bit>
#include <cstring>
#include <sys/mman.h>

namespace dotek::script {

namespace {

constexpr std::size_t kHead = 8;              // before a piece: its kind
constexpr std::size_t kStep = 16, kFine = 32; // kinds of 16, 32 .. 512 bytes, then four for each power of two

std::size_t& kindBefore(void* piece) {
  return *reinterpret_cast<std::size_t*>(static_cast<char*>(piece) - kHead);
}

} // namespace

Arena::Arena(std::size_t bytes) : bytes_(bytes) {
  void* const got =
      mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (got != MAP_FAILED) base_ = static_cast<char*>(got);
}

Arena::~Arena() {
  if (base_ != nullptr) munmap(base_, bytes_);
}

std::size_t Arena::kindOf(std::size_t size) {
  if (size <= kStep * kFine) return size <= kStep ? 0 : (size - 1) / kStep;
  // Above 512: quarter of the power of two below it.
  const auto power = static_cast<std::size_t>(std::bit_width(size - 1) - 1);
  const std::size_t quarter = (size - 1) >> (power - 2) & 3;
  return kFine + (power - 9) * 4 + quarter;
}

std::size_t Arena::sizeOf(std::size_t kind) {
  if (kind < kFine) return (kind + 1) * kStep;
  const std::size_t power = (kind - kFine) / 4 + 9, quarter = (kind - kFine) % 4;
  return (std::size_t{1} << power) + ((quarter + 1) << (power - 2));
}

void* Arena::take(std::size_t size) {
  if (size == 0) return nullptr;
  if (size > bytes_) {
    ranOut_ = true;
    return nullptr;
  }
  std::size_t kind = kindOf(size);
  if (state_.free[kind] == nullptr) {
    const std::size_t whole = sizeOf(kind) + kHead;
    if (bytes_ - state_.used >= whole) {
      void* const piece = base_ + state_.used + kHead;
      state_.used += whole;
      kindBefore(piece) = kind;
      return piece;
    }
    while (kind < kKinds && state_.free[kind] == nullptr)
      ++kind;
    if (kind == kKinds) {
      ranOut_ = true;
      return nullptr;
    }
  }
  void* const piece = state_.free[kind];
  std::memcpy(&state_.free[kind], piece, sizeof(void*));
  return piece;
}

void Arena::give(void* piece) {
  if (piece == nullptr) return;
  void*& first = state_.free[kindBefore(piece)];
  std::memcpy(piece, &first, sizeof(void*));
  first = piece;
}

void* Arena::resize(void* piece, std::size_t size) {
  if (piece == nullptr) return take(size);
  if (size == 0) {
    give(piece);
    return nullptr;
  }
  const std::size_t had = sizeOf(kindBefore(piece));
  if (size <= had) return piece;
  void* const out = take(size);
  if (out == nullptr) return nullptr;
  std::memcpy(out, piece, had);
  give(piece);
  return out;
}

void Arena::save() {
  saved_.assign(base_, state_.used);
  savedState_ = state_;
  savedThrew_ = threw;
  ranOut_ = false;
}

void Arena::restore() {
  std::memcpy(base_, saved_.data(), saved_.size());
  state_ = savedState_;
  threw = savedThrew_;
  ranOut_ = false;
}

} // namespace dotek::script
