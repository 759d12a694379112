// The block of --stock, which the program cuts.
#include "sim/geometry/PartFile.h"
#include "sim/run/SimWorld.h"
#include "support/Decimal.h"
#include "support/messages/Part.h"

#include <fmt/format.h>

namespace dotek::sim {
namespace {

std::string placeText(const Point3& p) {
  return fmt::format("X{} Y{} Z{}", fixedText(p.x, 3), fixedText(p.y, 3), fixedText(p.z, 3));
}

} // namespace

bool SimWorld::loadStockFile() {
  if (!options_.stock) return true;
  std::optional<StockFile> file =
      loadStock(*options_.stock, session_.limits(), session_.bounds(folderOf(*options_.stock)),
                session_.sources(), session_.diagnostics());
  if (!file) return false;
  stock_.emplace(std::move(*file));
  return true;
}

void SimWorld::followStock(const MachineMotion& motion) {
  const double length = machineNow_ == nullptr ? 0 : machineNow_->toolLength();
  MachineMotion here = motion;
  // Where nobody has said where the run begins, an axis has a place once it has moved.
  if (!setup_.at && !machine_) here.known = here.known && stockAxes_ == 7;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (motion.from[axis] != motion.to[axis]) stockAxes_ |= 1U << axis;
  const std::optional<StockRun::Found> found = stock_->moved(here, stockTool_, length);
  if (!found) return;
  const RunPlace place = place_();
  if (found->event == StockRun::Event::UnknownTool)
    session_.diagnostics().report<diag::StockToolUnknown>(
        place.range, found->tool == 0 ? std::string("a tool that nobody has called")
                                      : fmt::format("tool {}", found->tool));
  else if (stockRapids_.emplace(place.range.file, place.range.begin).second)
    session_.diagnostics().report<diag::StockRapid>(place.range, fixedText(found->depth, 3),
                                                    placeText(found->at));
}

void SimWorld::finishStock() {
  if (!stock_ || stockMargin_) return;
  stockMargin_ = stock_->margin();
  if (stockMargin_ && stockMargin_->under > 0)
    session_.diagnostics().report<diag::StockGouged>({}, fixedText(-stockMargin_->least, 4),
                                                     placeText(stockMargin_->leastAt),
                                                     numberText(stock_->file().tolerance));
}

} // namespace dotek::sim
