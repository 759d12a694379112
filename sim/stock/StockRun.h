// A block that is cut while a program runs, and what is left of it beside the finished part.
#pragma once

#include "sim/machine/MotionWatcher.h"
#include "sim/stock/StockFile.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dotek::sim {

// Beside the part, of one cell: mm square to the surface of the part, above 0 where material is left, below
// where it is cut away. No number: not known.
struct StockMargin {
  double most = 0, least = 0;                   // 0 where nothing is left over, and nothing is cut into
  Point3 mostAt, leastAt;                       // in the frame of the block
  std::size_t over = 0, under = 0, unknown = 0; // cells beyond the tolerance, and without a number
  std::vector<double> cells;                    // by rows
};

class StockRun {
public:
  // What is found on the way: a rapid that cuts, a tool that is in no list.
  enum class Event : std::uint8_t { Rapid, UnknownTool };
  struct Found {
    Event event = Event::Rapid;
    std::uint32_t tool = 0;
    double depth = 0; // of what a rapid has cut, along Z
    Point3 at;
  };

  explicit StockRun(StockFile file) : file_(std::move(file)), map_(file_.block) {}

  // A motion of the gauge line with this tool (0: none was called) and the length that the control counts
  // with. What is wrong with it; nothing: it is right, or was reported before.
  std::optional<Found> moved(const MachineMotion& motion, std::uint32_t tool, double lengthInForce);

  const StockFile& file() const { return file_; }
  const StockMap& map() const { return map_; }
  std::uint64_t lost() const { return lost_; } // moves from or to a place that is not known
  // After the run; of a file without a part nothing.
  std::optional<StockMargin> margin() const;

private:
  const StockTool* toolOf(std::uint32_t number) const;

  StockFile file_;
  StockMap map_;
  std::uint64_t lost_ = 0;
  std::set<std::uint32_t> unknown_; // tools that were reported
};

// For people, some lines, and for programs, a JSON object.
std::string stockText(const StockRun& stock, const std::optional<StockMargin>& margin);
std::string stockJson(const StockRun& stock, const std::optional<StockMargin>& margin);
// The block from above: heights, or beside a part what is left and what is cut into. `title`: in UTF-8.
std::string stockSvg(const StockRun& stock, const std::optional<StockMargin>& margin,
                     const std::string& title);

} // namespace dotek::sim
