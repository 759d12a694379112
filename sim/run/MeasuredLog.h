// Gathers what a run measures: calls of probing macros with what they found, touches of skip moves outside of
// such calls, and the offsets that were written after them.
#pragma once

#include "sim/picture/Picture.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace dotek::sim {

class MeasuredLog {
public:
  static constexpr std::size_t kMost = 1000; // entries; more are counted

  // What a macro that ran by its text left in its result variables; nothing: no source says what it measures.
  using Reader =
      std::function<std::optional<Measurement>(std::uint32_t program, std::span<const double> locals)>;

  // Where the run is: the block, the last move of the picture, the name of the active work offset.
  struct Now {
    std::function<PictureBlock()> block;
    std::function<std::size_t()> move;
    std::function<std::string()> system;
  };
  void begin(Now now) { now_ = std::move(now); }
  void setReader(Reader reader) { reader_ = std::move(reader); }

  void callBegins(std::uint32_t program, std::span<const double> locals);
  void callEnded(std::uint32_t program);
  void measured(const Measurement& found);
  void offsetWritten(const OffsetWrite& write);
  void writtenAfterMiss(); // of the last one
  // A skip move that ended at a contact: where, in work coordinates, and the way of the machine to it.
  // One at the same place as the last, with nothing between that asked where that was, takes its row: that
  // was an approach.
  void touched(const Point3& position, const Point3& way);
  void positionRead() { touch_.read = true; } // by the program
  // A skip move that met nothing, and whose skip position is used: `one` says where it ended. What is set
  // until another call begins is set after it.
  void missed(PictureMeasured one);
  static Measurement measurementOf(const Point3& position, const Point3& way, std::string_view what);
  void finish(); // calls in which the run ended

  const std::vector<PictureMeasured>& entries() const { return entries_; }
  std::size_t leftOut() const { return leftOut_; }

private:
  struct Call {
    std::vector<double> locals;
    PictureBlock block;
    std::string system;
    std::size_t first = 0; // of entries_, made within it
    std::optional<Measurement> found;
  };
  void close(Call call);
  PictureMeasured entry(Measurement found, PictureBlock block, std::string system) const;
  void add(PictureMeasured one);

  // The last touch of a skip move, while its row is the last.
  struct Touch {
    std::size_t rows = 0; // entries_ after it; 0: there was none
    std::size_t calls = 0;
    Point3 position, way;
    bool read = false;
  };
  // Of the touch at the same place from the same side; nullptr: there is none.
  PictureMeasured* sameTouch(const Point3& position, const Point3& way, std::string_view system);

  Now now_;
  Touch touch_;
  Reader reader_;
  std::vector<Call> calls_;
  std::vector<PictureMeasured> entries_;
  std::size_t leftOut_ = 0;
  std::optional<std::size_t> missedAt_; // how many calls were open when the last miss was used
};

} // namespace dotek::sim
