#include "verify/JoinedCalls.h"

#include "verify/PathPieces.h"

#include <algorithm>
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
    if (std::none_of(source_.measures.begin(), source_.measures.end(),
                     [](const Measure& one) { return one.nominal.size() > 1; }))
      return std::nullopt;
    for (std::size_t i = 0; i < target_.pieces.size(); ++i)
      if (target_.pieces[i].kind == sim::PathKind::Measuring) pieces_.push_back(i);
    if (pieces_.size() != target_.measures.size()) return std::nullopt;
    std::vector<Measure> measures;
    std::vector<std::size_t> before = {0}; // how many are left of the first so many
    std::vector<bool> left(target_.pieces.size(), false);
    bool any = false;
    for (std::size_t next = 0; next < target_.measures.size();) {
      Measure joined = target_.measures[next];
      const std::size_t wanted =
          measures.size() < source_.measures.size() ? source_.measures[measures.size()].nominal.size() : 0;
      std::size_t last = next;
      while (joined.nominal.size() < wanted && last + 1 < target_.measures.size() && follows(last)) {
        const Measure& more = target_.measures[++last];
        joined.nominal.insert(joined.nominal.end(), more.nominal.begin(), more.nominal.end());
        joined.contacts.insert(joined.contacts.end(), more.contacts.begin(), more.contacts.end());
        for (const auto& [key, zero] : more.datums)
          joined.datums[key] = zero;
        joined.end = more.end;
        left[pieces_[last]] = any = true;
      }
      measures.push_back(std::move(joined));
      next = last + 1;
      before.resize(next + 1, measures.size());
    }
    if (!any) return std::nullopt;
    std::optional<Record> out(target_);
    out->measures = std::move(measures);
    for (Deed& deed : out->deeds)
      deed.measures = before[std::min(deed.measures, before.size() - 1)];
    out->pieces.clear();
    for (std::size_t i = 0; i < target_.pieces.size(); ++i)
      if (!left[i]) out->pieces.push_back(target_.pieces[i]);
    return out;
  }

private:
  // The next call is made in the place of the one before, which has come back to it, with the same options.
  bool follows(std::size_t measure) const {
    const Measure &one = target_.measures[measure], &next = target_.measures[measure + 1];
    const Piece& piece = target_.pieces[pieces_[measure + 1]];
    return pieces_[measure + 1] == pieces_[measure] + 1 && near(piece.from, piece.to, tolerance_) &&
           near(one.start, one.end, tolerance_) && near(one.end, next.start, tolerance_) &&
           one.options == next.options && one.with == next.with;
  }

  const Record &source_, &target_;
  const double tolerance_;
  std::vector<std::size_t> pieces_; // of each measure
};

} // namespace

std::optional<Record> joinedCalls(const Record& source, const Record& target, double tolerance) {
  return Joining(source, target, tolerance).run();
}

} // namespace dotek::verify
