#include "verify/Gather.h"

#include <algorithm>

namespace dotek::verify {

namespace {

using sim::PathKind;
using sim::Point3;

constexpr double kOpposite = 1e-8;

bool near(const Point3& a, const Point3& b, double tolerance) {
  return (a - b).length() <= tolerance;
}

// Of a run in the order in which it came; one of the two.
struct Step {
  const Piece* piece = nullptr;
  const Mark* mark = nullptr;
};

class Gathering {
public:
  Gathering(const Record& like, const Record& ran, double tolerance, double middle)
      : like_(like), ran_(ran), tolerance_(tolerance), middle_(middle) {
    auto mark = ran.marks.begin();
    for (std::size_t i = 0; i <= ran.pieces.size(); ++i) {
      for (; mark != ran.marks.end() && mark->pieces <= i; ++mark)
        steps_.push_back({nullptr, &*mark});
      if (i < ran.pieces.size()) steps_.push_back({&ran.pieces[i], nullptr});
    }
    out_.record = ran;
    out_.record.pieces.clear();
    out_.record.measures.clear();
    out_.record.marks.clear();
  }

  Gathered run() {
    for (const Measure& measure : like_.measures)
      gather(measure);
    while (moves())
      begin(), takeTouch(), end(out_.record.measures.back().start);
    return std::move(out_);
  }

private:
  const Step* now() const { return next_ < steps_.size() ? &steps_[next_] : nullptr; }
  bool measures() const {
    return now() != nullptr && now()->piece != nullptr && now()->piece->kind == PathKind::Measuring;
  }

  // Up to the next skip move that measures; false: there is none.
  bool moves() {
    for (; now() != nullptr && !measures(); ++next_) {
      if (now()->piece != nullptr)
        out_.record.pieces.push_back(*now()->piece);
      else if (now()->mark->kind != Mark::Kind::Stop)
        out_.loose.push_back(*now()->mark);
    }
    return now() != nullptr;
  }

  void begin() {
    const Measure& first = ran_.measures[touch_];
    Measure measure;
    measure.start = first.start;
    measure.with = first.with;
    measure.range = first.range;
    out_.record.measures.push_back(measure);
    out_.record.pieces.push_back(
        {PathKind::Measuring, first.start, first.start, first.with, first.range, {}});
    out_.parts.emplace_back();
  }
  void end(const Point3& at) { out_.record.measures.back().end = at; }
  void takeTouch() {
    out_.parts.back().touches.push_back(ran_.measures[touch_++]);
    ++next_;
  }
  void takeMarks() {
    for (; now() != nullptr && now()->mark != nullptr; ++next_)
      out_.parts.back().marks.push_back(*now()->mark);
  }

  void takeMove(const Piece& piece) {
    Gathered::Parts& parts = out_.parts.back();
    parts.moves.push_back({parts.touches.size(), piece});
  }

  // Opposite walls that are touched from outside: the probe goes over them and down beside them.
  static bool isOutside(const Measure& like) {
    if (like.nominal.size() < 2) return false;
    const Touch &a = like.nominal[0], &b = like.nominal[1];
    return (a.direction + b.direction).length() < kOpposite && (a.point - b.point).dot(a.direction) < 0;
  }

  // The moves since the probe was where `like` begins are part of the measure.
  void takeWayDown(const Measure& like) {
    std::vector<Piece>& pieces = out_.record.pieces;
    for (std::size_t i = pieces.size(); i-- > 0 && pieces[i].kind == PathKind::Protected;) {
      if (!near(pieces[i].from, like.start, middle_)) continue;
      begin();
      for (std::size_t way = i; way + 1 < pieces.size(); ++way) // without the new measure's own
        out_.parts.back().moves.push_back({0, pieces[way]});
      const Piece measuring{PathKind::Measuring, pieces[i].from,      pieces[i].from,
                            pieces.back().with,  pieces.back().range, {}};
      pieces.resize(i);
      pieces.push_back(measuring);
      out_.record.measures.back().start = measuring.from;
      return;
    }
    begin();
  }

  void gather(const Measure& like) {
    if (!moves()) return;
    outside_ = isOutside(like);
    if (outside_)
      takeWayDown(like);
    else
      begin();
    const std::size_t sides = std::max<std::size_t>(1, like.nominal.size());
    Gathered::Parts& parts = out_.parts.back();
    // Between them the probe comes off the walls in feed.
    while (now() != nullptr && parts.touches.size() < sides) {
      if (measures())
        takeTouch();
      else if (now()->mark != nullptr)
        takeMarks();
      else if (comesOff(*now()->piece))
        takeMove(*now()->piece), ++next_;
      else
        break;
    }
    const bool stopped = like_.ending != Ending::Finished && like.contacts.size() < sides;
    end(stopped ? out_.record.measures.back().start : back(like.end, sides, parts.touches.back().end));
  }

  // From the last contact to where the measure ends, which the next move may go on with.
  Point3 back(const Point3& end, std::size_t sides, Point3 at) {
    bool left = false;
    for (; now() != nullptr; ++next_) {
      if (now()->mark != nullptr) {
        out_.parts.back().marks.push_back(*now()->mark);
        continue;
      }
      const Piece& piece = *now()->piece;
      const bool there =
          left && near(at, end, sides > 1 ? middle_ : tolerance_) && !(sides > 1 && setsLater());
      if (there || piece.kind == PathKind::Measuring || (piece.kind == PathKind::Protected && !outside_))
        break;
      if (sides == 1 && passes(at, piece.to, end)) {
        if (!near(end, piece.to, tolerance_)) {
          out_.record.pieces.push_back(piece);
          out_.record.pieces.back().from = end;
        }
        ++next_;
        takeMarks();
        return end;
      }
      if (!comesOff(piece) || sides == 1) break;
      takeMove(piece);
      at = piece.to;
      left = true;
    }
    return at;
  }

  bool passes(const Point3& from, const Point3& to, const Point3& point) const {
    const Point3 way = to - from;
    const double length = way.length();
    if (!(length > 0)) return false;
    const double share = (point - from).dot(way) / (length * length);
    return share >= 0 && share <= 1 + tolerance_ / length && near(from + way * share, point, tolerance_);
  }

  // A position is set before the program does something else: it has not come to its place yet. A record
  // before that is none.
  bool setsLater() const {
    for (std::size_t i = next_; i < steps_.size(); ++i) {
      if (steps_[i].mark != nullptr && steps_[i].mark->kind == Mark::Kind::Datum) return true;
      if (steps_[i].mark != nullptr && steps_[i].mark->kind == Mark::Kind::Stop) return false;
      if (steps_[i].piece != nullptr && !comesOff(*steps_[i].piece)) return false;
    }
    return false;
  }
  bool comesOff(const Piece& piece) const {
    return piece.kind == PathKind::Feed || (outside_ && piece.kind == PathKind::Protected);
  }

  const Record &like_, &ran_;
  const double tolerance_, middle_;
  std::vector<Step> steps_;
  std::size_t next_ = 0;  // of the steps
  std::size_t touch_ = 0; // of the measures that ran
  bool outside_ = false;  // the measure that is being gathered
  Gathered out_;
};

} // namespace

Gathered gather(const Record& like, const Record& ran, double tolerance, double middle) {
  return Gathering(like, ran, tolerance, middle).run();
}

} // namespace dotek::verify
