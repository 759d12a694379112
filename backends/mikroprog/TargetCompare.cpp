#include "backends/mikroprog/TargetCompare.h"

#include "backends/mikroprog/TargetFrame.h"
#include "backends/mikroprog/TargetWay.h"
#include "stdlib/MacroSet.h"
#include "support/Decimal.h"
#include "verify/Gather.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace dotek::targets {

namespace {

using sim::Point3;
using stdlib::MacroAlarm;
using verify::Aspect;
using verify::Mark;
using verify::Measure;

constexpr std::size_t kBoreSides = 4;     // touches of a bore
constexpr double kSame = 1e-8;            // mm: sums of coordinates that come to the same
constexpr double kValueTolerance = 0.005; // of a recorded diameter, mm
constexpr std::uint32_t kActive = 54;     // the one system

// The middle between walls: of a bore, or of one pair that is touched from one place to both sides.
bool isMiddle(const Measure& measure) {
  const std::vector<verify::Touch>& walls = measure.nominal;
  if (walls.size() == kBoreSides) return true;
  return walls.size() == 2 && (walls[0].direction + walls[1].direction).length() < kSame;
}

std::size_t axisOf(const Point3& direction) {
  const double x = std::abs(direction.x), y = std::abs(direction.y), z = std::abs(direction.z);
  return x > std::max(y, z) ? 0 : y > z ? 1 : 2;
}

double& part(Point3& p, std::size_t axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

// Coordinates in a text "ZDE MA BYT X-3 Y10", written with `form`.
std::array<std::optional<double>, 3> coordinatesIn(const std::string& text, const std::string& form) {
  std::array<std::optional<double>, 3> out;
  const std::size_t hole = form.find("{}");
  if (hole == std::string::npos || text.substr(0, hole) != form.substr(0, hole)) return out;
  for (std::size_t at = hole; at < text.size(); ++at) {
    const std::size_t axis = std::string_view("XYZ").find(text[at]);
    double value = 0;
    if (axis != std::string_view::npos &&
        std::from_chars(text.data() + at + 1, text.data() + text.size(), value).ec == std::errc())
      out[axis] = value;
  }
  return out;
}

// What each measure of the program was meant for and has set, as the macro's call says it.
class Meaning {
public:
  // `tolerance`: of places, mm.
  Meaning(const MikroprogFacts& facts, double tolerance)
      : facts_(facts), tolerance_(tolerance), zero_(facts.zero) {}

  std::vector<verify::Difference> own; // what the common rules do not ask for

  void read(Measure& want, Measure& got, const verify::Gathered::Parts& parts, bool stopped) {
    const bool bore = isMiddle(want);
    middle_ = bore;
    sets_ = !facts_.byOperator && !want.datums.empty();
    nominals(want, got, parts, bore);
    if (stopped) { // only what was looked for is compared
      want.nominal.resize(std::min(want.nominal.size(), got.nominal.size()));
      want.contacts = got.contacts;
      want.end = want.start;
      return;
    }
    if (bore) {
      centresOnly(want.contacts);
      centresOnly(got.contacts);
    }
    if (auto off = wayFault(want, parts, {facts_.ballRadius, tolerance_, bore, sets_}))
      own.push_back(std::move(*off));
    datums(want, got, parts);
    records(want, parts, bore);
  }

private:
  void add(Aspect aspect, std::string text, SourceRange source, SourceRange target) {
    own.push_back({aspect, std::move(text), source, target});
  }

  // Where each search expects its surface: its end without the overtravel.
  void nominals(Measure& want, Measure& got, const verify::Gathered::Parts& parts, bool bore) {
    double beside = 0; // by how much the first wall of a pair lies off its place
    double middle = 0; // the same of the middle between the two, along X
    // As far as the call says, else as far as the program was written for.
    const auto stated = want.options.find(stdlib::ArgumentRole::Overtravel);
    const double overtravel = stated == want.options.end() ? facts_.overtravel : stated->second;
    for (std::size_t i = 0; i < parts.touches.size(); ++i) {
      const Measure& search = parts.touches[i];
      const Point3 way = *search.aim - search.start;
      if (!(way.length() > 0)) continue;
      verify::Touch touch;
      touch.direction = way * (1 / way.length());
      touch.point = *search.aim - touch.direction * overtravel;
      if (touch.direction.z == 0) touch.point.z += facts_.ballRadius;
      if (bore && i < want.nominal.size()) {
        // The ball's centre is searched, where the wall is less a radius; the second wall of a pair from the
        // first.
        touch.point = touch.point + touch.direction * facts_.ballRadius;
        const std::size_t axis = axisOf(touch.direction);
        Point3 found = search.end + touch.direction * facts_.ballRadius;
        if (i % 2 == 1 && sets_) part(touch.point, axis) -= beside;
        if (i % 2 == 0) beside = part(found, axis) - part(want.nominal[i].point, axis);
        if (axis == 0 && i < want.contacts.size())
          middle +=
              (want.contacts[i].centre.x + touch.direction.x * facts_.ballRadius - want.nominal[i].point.x) /
              2;
        // After the first datum of a bore the ball is in the middle along X.
        if (i > 1 && sets_) want.nominal[i].point.x += middle;
      }
      got.nominal.push_back(touch);
      got.contacts.insert(got.contacts.end(), search.contacts.begin(), search.contacts.end());
    }
  }

  // Of a bore the place of the ball, where it touches: what it touches leans with where it is across.
  void centresOnly(std::vector<sim::ProbeEvent>& contacts) const {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      contacts[i].point = contacts[i].centre;
      // Without a walk the ball is in the middle that was expected, not in the one that was found.
      if (!sets_ && i > 1) contacts[i].point = {};
    }
  }

  // The zero that G92 makes, or an operator who enters what the panel shows.
  void datums(const Measure& want, Measure& got, const verify::Gathered::Parts& parts) {
    std::optional<Point3> zero;
    std::array<bool, 3> set{};
    for (const Mark& mark : parts.marks) {
      if (mark.kind == Mark::Kind::Stop && enter(mark, parts, zero, set)) got.datumRange = mark.range;
      if (mark.kind != Mark::Kind::Datum) continue;
      zero = mark.zero;
      got.datumRange = mark.range;
      for (std::size_t axis = 0; axis < 3; ++axis)
        set[axis] = std::abs(part(zero_, axis) - part(*zero, axis)) > kSame;
    }
    if (!zero) return;
    // A zero that stays where it is counts as set where the source sets it.
    for (const auto& [key, value] : want.datums)
      set[key.second] = true;
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      if (set[axis]) got.datums[{kActive, axis}] = part(*zero, axis);
    if (!facts_.byOperator) zero_ = *zero;
  }

  bool enter(const Mark& stop, const verify::Gathered::Parts& parts, std::optional<Point3>& zero,
             std::array<bool, 3>& set) {
    const auto shown =
        coordinatesIn(stop.text, middle_ ? facts_.control.enterCentre : facts_.control.enterShift);
    bool any = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!shown[axis]) continue;
      Point3 at = stop.at;
      if (middle_) at = betweenWalls(parts.touches, axis).value_or(at);
      if (!zero) zero = zero_;
      part(*zero, axis) = part(at, axis) - *shown[axis] / (facts_.control.isDiameter("XYZ"[axis]) ? 2 : 1);
      any = set[axis] = true;
    }
    return any;
  }

  static std::optional<Point3> betweenWalls(const std::vector<Measure>& touches, std::size_t axis) {
    for (std::size_t i = 0; i + 1 < touches.size(); i += 2)
      if (axisOf(*touches[i].aim - touches[i].start) == axis)
        return (touches[i].end + touches[i + 1].end) * 0.5;
    return std::nullopt;
  }

  // Each contact is kept in a record; of a bore that is set by G92, its size along each axis.
  void records(const Measure& want, const verify::Gathered::Parts& parts, bool bore) {
    std::vector<const Mark*> places, values;
    for (const Mark& mark : parts.marks)
      if (mark.kind == Mark::Kind::Position || mark.kind == Mark::Kind::Value)
        (mark.kind == Mark::Kind::Position ? places : values).push_back(&mark);
    const bool sizes = bore && places.empty();
    const std::size_t wanted = sizes ? parts.touches.size() / 2 : parts.touches.size();
    const auto& kept = sizes ? values : places;
    if (kept.size() != wanted)
      return add(Aspect::Contact,
                 fmt::format("{} {} against {} records", wanted, sizes ? "sizes" : "contacts", kept.size()),
                 want.range, parts.touches.front().range);
    afterDatum(want, parts);
    for (std::size_t i = 0; i < kept.size(); ++i) {
      if (!sizes) {
        if ((kept[i]->at - parts.touches[i].end).length() > facts_.tolerance)
          add(Aspect::Contact, "a record that is not made at the contact", want.range, kept[i]->range);
        continue;
      }
      const double size = (parts.touches[2 * i].end - parts.touches[2 * i + 1].end).length();
      if (std::abs(-2 * kept[i]->value - size) > kValueTolerance)
        add(Aspect::Contact,
            fmt::format("a distance of {} between the walls against {}", fixedText(size, 6),
                        fixedText(-2 * kept[i]->value, 6)),
            want.range, kept[i]->range);
    }
  }

  // What is recorded at a contact after its datum is what was set, whatever was found.
  void afterDatum(const Measure& want, const verify::Gathered::Parts& parts) {
    const Mark* datum = nullptr;
    for (const Mark& mark : parts.marks) {
      if (mark.kind == Mark::Kind::Datum) datum = &mark;
      if (mark.kind == Mark::Kind::Position && datum != nullptr && datum->pieces == mark.pieces)
        add(Aspect::Contact, "a record after the datum, which always holds the nominal", want.range,
            mark.range);
    }
  }

  const MikroprogFacts& facts_;
  const double tolerance_;
  Point3 zero_;         // of the active system
  bool middle_ = false; // of the measure that is read
  bool sets_ = false;   // it sets a position: of a bore, the ball walks to the middle
};

// A search, and a rapid move back to where it began.
bool backAtOnce(const verify::Piece& search, const verify::Piece& back) {
  constexpr double kNear = 0.01; // mm
  return search.kind == sim::PathKind::Measuring && back.kind == sim::PathKind::Rapid &&
         (back.to - search.from).length() < kNear;
}

// What follows a search in feed begins with the path back, at the feed that the program was written with. It
// is a rapid move where the source has one.
void pathsBack(const verify::Record& source, const verify::Record& ran, const MikroprogFacts& facts,
               std::vector<verify::Difference>& out) {
  bool rapid = false;
  for (std::size_t i = 1; i < source.pieces.size(); ++i)
    rapid = rapid || backAtOnce(source.pieces[i - 1], source.pieces[i]);
  for (std::size_t i = 1; i < ran.pieces.size(); ++i) {
    const verify::Piece &search = ran.pieces[i - 1], &back = ran.pieces[i];
    if (!rapid && backAtOnce(search, back)) {
      out.push_back({Aspect::State,
                     fmt::format("the path back from the contact at F{} against a rapid move",
                                 numberText(facts.returnFeed)),
                     {},
                     back.range});
      return;
    }
    if (search.kind != sim::PathKind::Measuring || back.kind != sim::PathKind::Feed) continue;
    if (back.feed && std::abs(*back.feed - facts.returnFeed) <= kSame) continue;
    out.push_back({Aspect::State,
                   fmt::format("the path back at F{} against {}", numberText(facts.returnFeed),
                               back.feed ? "F" + numberText(*back.feed) : "no feed"),
                   {},
                   back.range});
    return;
  }
}

// A datum that is set only after the way back belongs to the measure before it, where that lacks one: what it
// sets is another place.
void lateDatums(const verify::Record& source, const verify::Record& ran, verify::Gathered& got) {
  for (const Mark& mark : got.loose) {
    if (mark.kind != Mark::Kind::Datum) continue;
    const auto touches = static_cast<std::size_t>(
        std::count_if(ran.pieces.begin(), ran.pieces.begin() + static_cast<std::ptrdiff_t>(mark.pieces),
                      [](const verify::Piece& piece) { return piece.kind == sim::PathKind::Measuring; }));
    std::size_t measure = 0;
    for (std::size_t before = 0; measure < got.parts.size(); ++measure)
      if ((before += got.parts[measure].touches.size()) >= touches) break;
    if (measure >= std::min(got.record.measures.size(), source.measures.size())) continue;
    Measure& late = got.record.measures[measure];
    if (!late.datums.empty()) continue;
    Point3 zero = mark.zero;
    for (const auto& [key, value] : source.measures[measure].datums)
      late.datums[{kActive, key.second}] = part(zero, key.second);
    if (!late.datums.empty()) late.datumRange = mark.range;
  }
}

} // namespace

std::vector<verify::Difference> compareWithSource(verify::Record source, const verify::Record& ran,
                                                  const MikroprogFacts& facts) {
  const std::string_view obstructed = macroAlarmName(MacroAlarm::PathObstructed);
  // What the source touches with its probe off stops a probe that is always on.
  if (!source.events.empty() && ran.alarmKind == obstructed) return {};
  // Contact before a search begins is asked for before the chain.
  if (source.alarmKind == macroAlarmName(MacroAlarm::ProbeOpen)) source.alarmKind = obstructed;
  source.stores.clear();
  source.zeros.clear(); // each measure says what it sets
  for (verify::Piece& piece : source.pieces)
    if (piece.kind == sim::PathKind::Measuring) piece.to = piece.from;
  const bool bores = std::any_of(source.measures.begin(), source.measures.end(),
                                 [](const Measure& one) { return isMiddle(one); });
  verify::CompareRules rules;
  rules.tolerance = rules.results = bores ? std::max(facts.tolerance, kMiddleTolerance) : facts.tolerance;
  rules.atMeasures = rules.mayRestoreModes = true;

  verify::Gathered got = gather(source, ran, facts.tolerance, rules.tolerance);
  Meaning meaning(facts, rules.tolerance);
  for (std::size_t i = 0; i < std::min(source.measures.size(), got.parts.size()); ++i) {
    Measure& want = source.measures[i];
    const bool stopped = source.ending != verify::Ending::Finished &&
                         want.contacts.size() < std::max<std::size_t>(1, want.nominal.size());
    meaning.read(want, got.record.measures[i], got.parts[i], stopped);
  }
  if (!facts.byOperator) lateDatums(source, ran, got);
  for (const Mark& mark : got.loose)
    meaning.own.push_back(
        {mark.kind == Mark::Kind::Datum ? Aspect::Offset : Aspect::Contact,
         mark.kind == Mark::Kind::Datum ? "nothing against a datum" : "nothing against a record",
         {},
         mark.range});
  pathsBack(source, ran, facts, meaning.own);
  for (verify::Difference& one : frameFaults(source, ran, facts.height))
    meaning.own.push_back(std::move(one));
  std::vector<verify::Difference> out = compare(source, got.record, rules);
  if (!out.empty() && out.front().aspect == Aspect::Ending) return out;
  for (verify::Difference& one : meaning.own)
    if (std::none_of(out.begin(), out.end(), [&](const auto& told) { return told.aspect == one.aspect; }))
      out.push_back(std::move(one));
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.aspect < b.aspect; });
  return out;
}

} // namespace dotek::targets
