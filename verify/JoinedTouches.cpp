#include "verify/JoinedTouches.h"

#include "verify/PathPieces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace dotek::verify {

namespace {

class Joining {
public:
  Joining(const Record& source, const Record& target, double tolerance)
      : source_(source), target_(target), tolerance_(tolerance) {}

  // nullopt: nothing is to be joined.
  std::optional<Record> run() {
    if (std::none_of(target_.measures.begin(), target_.measures.end(), isFeature)) return std::nullopt;
    for (std::size_t i = 0; i < source_.pieces.size(); ++i)
      if (source_.pieces[i].kind == sim::PathKind::Measuring) pieceOf_.push_back(i);
    if (pieceOf_.size() != source_.measures.size()) return std::nullopt;
    Record out = source_;
    out.measures.clear();
    out.pieces.clear();
    bool any = false;
    std::size_t next = 0, kept = 0;        // measures and pieces of the source that are dealt with
    std::vector<std::size_t> before = {0}; // how many are left of the first so many measures
    for (const Measure& call : target_.measures) {
      const std::optional<Region> region = isFeature(call) ? regionOf(call, next, kept) : std::nullopt;
      if (!region && next == source_.measures.size()) break;
      if (!region) {
        out.measures.push_back(source_.measures[next++]);
        before.resize(next + 1, out.measures.size());
        continue;
      }
      any = true;
      keepPieces(out, kept, region->begin);
      Piece piece = source_.pieces[region->touches > 0 ? pieceOf_[next] : region->begin];
      if (region->touches == 0) {
        piece.kind = sim::PathKind::Measuring;
        piece.feed.reset();
      }
      piece.from = piece.to = source_.pieces[region->begin].from;
      out.pieces.push_back(piece);
      out.measures.push_back(joined(call, next, *region));
      shifts_.push_back({region->end, out.pieces.size()});
      kept = region->end;
      next += region->touches;
      before.resize(next + 1, out.measures.size());
    }
    if (!any) return std::nullopt;
    out.measures.insert(out.measures.end(), source_.measures.begin() + static_cast<std::ptrdiff_t>(next),
                        source_.measures.end());
    keepPieces(out, kept, source_.pieces.size());
    for (Mark& mark : out.marks)
      mark.pieces = moved(mark.pieces);
    for (IdleMove& idle : out.idle)
      idle.pieces = moved(idle.pieces);
    for (Deed& deed : out.deeds)
      deed.measures = deed.measures < before.size() ? before[deed.measures]
                                                    : deed.measures - (before.size() - 1) + before.back();
    return out;
  }

private:
  struct Region {
    std::size_t begin = 0, end = 0; // pieces of the source, the last one excluded
    std::size_t touches = 0;
  };

  static bool isFeature(const Measure& one) { return one.program != 0 && one.nominal.size() > 1; }

  std::optional<Region> regionOf(const Measure& call, std::size_t first, std::size_t kept) const {
    const std::size_t rest = source_.measures.size() - first;
    const std::size_t touches = std::min(call.nominal.size(), rest);
    const bool stops = source_.ending != Ending::Finished;
    if (touches < call.nominal.size() && !stops) return std::nullopt;
    for (std::size_t i = first; i < first + touches; ++i)
      if (source_.measures[i].nominal.size() != 1) return std::nullopt;
    Region out;
    out.touches = touches;
    const auto isStart = [&](std::size_t piece) {
      return near(source_.pieces[piece].from, call.start, tolerance_);
    };
    out.begin = touches == 0 ? source_.pieces.size() : pieceOf_[first] + 1;
    do {
      if (out.begin == kept) return std::nullopt; // it never was there
      --out.begin;
    } while (!isStart(out.begin));
    out.end = source_.pieces.size();
    if (touches == 0) return out; // it stops before it touches anything
    const std::size_t last = first + touches - 1;
    out.end = pieceOf_[last] + 1;
    if (near(source_.measures[last].end, call.end, tolerance_)) return out;
    const std::size_t most = last + 1 < pieceOf_.size() ? pieceOf_[last + 1] : source_.pieces.size();
    while (out.end < most)
      if (near(source_.pieces[out.end++].to, call.end, tolerance_)) return out;
    if (!stops || last + 1 != source_.measures.size()) return std::nullopt;
    return out;
  }

  // A touch across what was found before it leads through the middle found: the call states the surface
  // beside its start. Where the two differ along the touch, it is the touch.
  Touch besides(const Touch& touch, const Touch& stated) const {
    const sim::Point3 away = touch.point - stated.point;
    const bool same = near(touch.direction, stated.direction, tolerance_) &&
                      std::abs(away.dot(stated.direction)) <= tolerance_ && std::abs(away.z) <= tolerance_;
    Touch out = touch;
    if (same) out.point = stated.point;
    return out;
  }

  Measure joined(const Measure& call, std::size_t first, const Region& region) const {
    Measure out;
    if (region.touches > 0) {
      out = source_.measures[first];
      out.nominal.clear();
      out.contacts.clear();
    } else {
      out.with = source_.pieces[region.begin].with;
      out.range = source_.pieces[region.begin].range;
      out.options = call.options;
    }
    for (std::size_t i = 0; i < region.touches; ++i) {
      const Measure& more = source_.measures[first + i];
      out.nominal.push_back(besides(more.nominal.front(), call.nominal[i]));
      out.contacts.insert(out.contacts.end(), more.contacts.begin(), more.contacts.end());
    }
    out.nominal.insert(out.nominal.end(), call.nominal.begin() + static_cast<std::ptrdiff_t>(region.touches),
                       call.nominal.end());
    // A protected move that meets something is a contact within a call, and none beside one.
    if (region.touches < call.nominal.size() && call.contacts.size() == out.contacts.size() + 1)
      out.contacts.push_back(call.contacts.back());
    out.start = source_.pieces[region.begin].from;
    out.end = source_.pieces[region.end - 1].to;
    return out;
  }

  void keepPieces(Record& out, std::size_t from, std::size_t to) const {
    out.pieces.insert(out.pieces.end(), source_.pieces.begin() + static_cast<std::ptrdiff_t>(from),
                      source_.pieces.begin() + static_cast<std::ptrdiff_t>(to));
  }

  // How many pieces are left of the first so many.
  std::size_t moved(std::size_t pieces) const {
    std::size_t out = pieces;
    for (const auto& [end, left] : shifts_)
      if (pieces >= end) out = left + (pieces - end);
    return out;
  }

  const Record &source_, &target_;
  const double tolerance_;
  std::vector<std::size_t> pieceOf_; // of each measure
  std::vector<std::pair<std::size_t, std::size_t>> shifts_;
};

} // namespace

std::optional<Record> joinedTouches(const Record& source, const Record& target, double tolerance) {
  return Joining(source, target, tolerance).run();
}

} // namespace dotek::verify
