#include "verify/MikroprogCompare.h"

#include "sim/geometry/Contact.h"
#include "stdlib/MacroSet.h"
#include "support/Decimal.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace dotek::verify {

namespace {

using sim::Point3;
using Kind = MikroprogStep::Kind;
using Ends = MikroprogRecord::Ending;

constexpr int kShown = 6;                 // decimals
constexpr std::size_t kBoreSides = 4;     // touches of a bore
constexpr double kSame = 1e-8;            // mm: sums of coordinates that come to the same
constexpr double kValueTolerance = 0.005; // of a recorded diameter, mm

double& part(Point3& p, std::size_t axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}
double part(const Point3& p, std::size_t axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

bool near(const Point3& a, const Point3& b, double tolerance) {
  return (a - b).length() <= tolerance;
}

// The axis along which a touch leads; nothing: it is oblique.
std::optional<std::size_t> axisOf(const Point3& direction) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (std::abs(std::abs(part(direction, axis)) - 1) < 1e-9) return axis;
  return std::nullopt;
}

// Coordinates in a text "ZDE MA BYT X-3 Y10", written with `form`.
std::array<std::optional<double>, 3> coordinatesIn(const std::string& text, const std::string& form) {
  std::array<std::optional<double>, 3> out;
  const std::size_t hole = form.find("{}");
  if (hole == std::string::npos || text.substr(0, hole) != form.substr(0, hole)) return out;
  for (std::size_t at = hole; at < text.size(); ++at) {
    const std::size_t axis = std::string_view("XYZ").find(text[at]);
    if (axis == std::string_view::npos) continue;
    double value = 0;
    const auto read = std::from_chars(text.data() + at + 1, text.data() + text.size(), value);
    if (read.ec == std::errc()) out[axis] = value;
  }
  return out;
}

// Brings both sides to one form: the source as it runs once each datum has moved the system in which the
// program goes on, the target with its searches as measures.
class Sides {
public:
  Sides(const Record& source, const MikroprogRecord& target, sim::World& world, const MikroprogFacts& facts)
      : source_(source), target_(target), world_(world), facts_(facts), radius_(world.probe().ballRadius()),
        zero_(facts.zero) {}

  std::vector<Difference> run() {
    // What the source touches with its probe off stops a probe that is always on.
    if (!source_.events.empty() && target_.ending == Ends::Collision) return {};
    expected_.start = source_.start;
    found_.start = target_.start;
    for (const Piece& piece : source_.pieces) {
      if (piece.kind == sim::PathKind::Measuring && measure_ < source_.measures.size())
        measure(source_.measures[measure_++]);
      else
        move(piece);
    }
    movesUntilMeasure();
    for (; step_ < target_.steps.size(); ++step_)
      surplus(target_.steps[step_]);
    expected_.end = shifted(source_.end);
    found_.end = target_.end;
    ending();
    obstructed();
    if (source_.events.empty() && !target_.events.empty())
      add(Aspect::Contact, "the stylus meets the part on its path", {}, target_.events.front().second);
    CompareRules rules;
    rules.tolerance = rules.results =
        bores_ ? std::max(facts_.tolerance, kMiddleTolerance) : facts_.tolerance;
    std::vector<Difference> out = compare(expected_, found_, rules);
    if (!out.empty() && out.front().aspect == Aspect::Ending) return out;
    for (Difference& own : own_) {
      const bool told = std::any_of(out.begin(), out.end(),
                                    [&](const Difference& one) { return one.aspect == own.aspect; });
      if (!told) out.push_back(std::move(own));
    }
    std::stable_sort(out.begin(), out.end(),
                     [](const Difference& a, const Difference& b) { return a.aspect < b.aspect; });
    return out;
  }

  // After run().
  std::string whyUndecided() {
    if (!corrected_) return "";
    SourceRange at;
    if (!whyNoEvidence(source_, at).empty())
      return "the source comes to nothing after a datum, where this control goes on beside its path";
    return correctedWayIsFree() ? "" : "the path that a datum has corrected meets the part";
  }

private:
  // The path that is expected of the target, walked without it.
  bool correctedWayIsFree() {
    const double length = world_.probe().centreLength() + radius_;
    const auto machine = [&](const Point3& lowest) {
      sim::Position out{};
      out[0] = lowest.x, out[1] = lowest.y, out[2] = lowest.z + length;
      return out;
    };
    world_.restart(0);
    world_.setOn(true);
    std::size_t measures = 0;
    for (const Piece& piece : expected_.pieces) {
      sim::SkipMove move{};
      const auto ask = [&](const Point3& from, const Point3& to) {
        const sim::Position a = machine(from), b = machine(to);
        for (std::size_t i = 0; i < a.size(); ++i)
          move.machineFrom[i] = a[i], move.machineTo[i] = b[i];
        return world_.contact(move);
      };
      if (piece.kind == sim::PathKind::Measuring) {
        if (measures == expected_.measures.size()) break;
        const Measure& measure = expected_.measures[measures++];
        for (const Touch& touch : measure.nominal) {
          const Point3 start = measure.start + Point3{0, 0, radius_};
          const double way = (touch.point - start).length() + facts_.overtravel;
          if (!ask(measure.start, measure.start + touch.direction * way)) return false;
        }
      } else if (piece.kind == sim::PathKind::Protected) {
        if (!near(piece.from, piece.to, 0) && ask(piece.from, piece.to)) return false;
      } else {
        const auto kind = piece.kind == sim::PathKind::Rapid ? sim::MotionKind::Rapid : sim::MotionKind::Feed;
        world_.moved({kind, machine(piece.from), machine(piece.to), 0, true});
      }
    }
    return std::none_of(world_.events().begin(), world_.events().end(), [](const sim::ProbeEvent& event) {
      return event.outcome != sim::Outcome::Contact && event.outcome != sim::Outcome::Miss;
    });
  }

  void add(Aspect aspect, std::string text, SourceRange source, std::uint32_t line) {
    own_.push_back({aspect, std::move(text), source, line == 0 ? SourceRange{} : facts_.place(line)});
  }

  Point3 shifted(const Point3& point) const { return point + error_; }

  void move(const Piece& piece) {
    expected_.pieces.push_back({piece.kind, shifted(piece.from), shifted(piece.to), {}, piece.range});
  }

  // ---- the target -----------------------------------------------------------------------------------------

  const MikroprogStep* now() const { return step_ < target_.steps.size() ? &target_.steps[step_] : nullptr; }

  void foundPiece(const MikroprogStep& step, const Point3& from) {
    const sim::PathKind kind = step.kind == Kind::Rapid       ? sim::PathKind::Rapid
                               : step.kind == Kind::Protected ? sim::PathKind::Protected
                                                              : sim::PathKind::Feed;
    found_.pieces.push_back({kind, from, step.to, {}, facts_.place(step.line)});
  }

  // Moves up to the next search.
  void movesUntilMeasure() {
    for (; now() != nullptr && now()->kind != Kind::Search; ++step_) {
      if (now()->moves())
        foundPiece(*now(), now()->from);
      else
        surplus(*now());
    }
  }

  // A record, a datum, a stop that belongs to no measure.
  void surplus(const MikroprogStep& step) {
    if (step.kind == Kind::Search) {
      Measure more;
      more.start = step.from;
      more.end = step.to;
      more.range = facts_.place(step.line);
      found_.measures.push_back(more);
      found_.pieces.push_back({sim::PathKind::Measuring, step.from, step.from, {}, more.range});
    } else if (step.moves()) {
      foundPiece(step, step.from);
    } else if (step.kind == Kind::Datum) {
      add(Aspect::Offset, "nothing against a datum", {}, step.line);
    } else if (step.kind == Kind::Record || step.kind == Kind::Value) {
      add(Aspect::Contact, "nothing against a record", {}, step.line);
    }
  }

  // ---- a measure ------------------------------------------------------------------------------------------

  struct Group { // what one measure of the source is in the target
    std::vector<const MikroprogStep*> searches;
    std::vector<const MikroprogStep*> values;
    std::optional<Point3> zero; // after its last datum
    std::array<bool, 3> set{};  // axes that a datum has moved
    std::uint32_t setLine = 0;
    std::size_t records = 0;
  };

  void measure(const Measure& given) {
    movesUntilMeasure();
    const std::size_t sides = std::max<std::size_t>(1, given.nominal.size());
    bores_ = bores_ || sides == kBoreSides;
    Measure want;
    want.start = shifted(given.start);
    want.range = given.range;
    want.nominal = given.nominal;
    for (Touch& touch : want.nominal)
      touch.point = shifted(touch.point);
    expected_.pieces.push_back({sim::PathKind::Measuring, want.start, want.start, {}, given.range});

    Measure got;
    Group group;
    if (now() != nullptr) {
      got.start = now()->from;
      got.range = facts_.place(now()->line);
      found_.pieces.push_back({sim::PathKind::Measuring, got.start, got.start, {}, got.range});
      takeSearches(sides, group);
    }
    if (source_.ending != Ending::Finished && given.contacts.size() < sides)
      return lookedFor(want, got, group, sides);
    predict(given, want, sides);
    want.end = shifted(given.end);
    if (sides == kBoreSides) centresOnly(want.contacts);
    expected_.measures.push_back(want);
    if (group.searches.empty()) return;
    got.end = wayBack(want.end, sides, group);
    nominals(want, got, group, sides);
    if (sides == kBoreSides) centresOnly(got.contacts);
    found_.measures.push_back(got);
    settled(given, group);
    datums(given, group);
    records(given, group, sides);
    if (group.zero && !facts_.byOperator) zero_ = *group.zero;
  }

  // Of a bore the place of the ball, where it touches: what it touches leans with where it is across.
  void centresOnly(std::vector<sim::ProbeEvent>& contacts) const {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      contacts[i].point = contacts[i].centre;
      // Without a walk the ball is in the middle that was expected, not in the one that was found.
      if (facts_.byOperator && i > 1) contacts[i].point = {};
    }
  }

  // The source stops here with its alarm: only what was looked for is compared.
  void lookedFor(Measure& want, Measure& got, const Group& group, std::size_t sides) {
    want.end = got.end = want.start;
    expected_.measures.push_back(want);
    if (group.searches.empty()) return;
    nominals(want, got, group, sides);
    want.contacts = got.contacts;
    expected_.measures.back().contacts = got.contacts;
    found_.measures.push_back(got);
  }

  // Searches of one measure; between them the probe comes off the walls in feed.
  void takeSearches(std::size_t sides, Group& group) {
    while (now() != nullptr && group.searches.size() < sides) {
      const MikroprogStep& step = *now();
      if (step.kind == Kind::Search)
        group.searches.push_back(&step);
      else if (step.kind == Kind::Rapid || step.kind == Kind::Protected)
        return;
      else
        takeEvent(step, group);
      ++step_;
    }
  }

  void takeEvent(const MikroprogStep& step, Group& group) {
    if (step.kind == Kind::Value) group.values.push_back(&step);
    if (step.kind == Kind::Record) {
      ++group.records;
      const MikroprogStep* last = group.searches.empty() ? nullptr : group.searches.back();
      if (last == nullptr || !near(last->to, step.to, facts_.tolerance))
        add(Aspect::Contact, "a record that is not made at the contact", {}, step.line);
    }
    if (step.kind == Kind::Datum) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        group.set[axis] = std::abs(part(zero_, axis) - part(step.zero, axis)) > kSame;
      group.zero = step.zero;
      group.setLine = step.line;
    }
    if (step.kind == Kind::Stop) operatorDatum(step, group);
  }

  // The zero that an operator makes who enters what the panel shows.
  void operatorDatum(const MikroprogStep& step, Group& group) {
    const bool middle = group.searches.size() == kBoreSides;
    const auto shown =
        coordinatesIn(step.text, middle ? facts_.control.enterCentre : facts_.control.enterShift);
    Point3 zero = group.zero.value_or(Point3{});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!shown[axis]) continue;
      double here = part(step.to, axis);
      if (middle && axis < 2)
        here = (part(group.searches[2 * axis]->to, axis) + part(group.searches[2 * axis + 1]->to, axis)) / 2;
      const bool diameter = facts_.control.isDiameter("XYZ"[axis]);
      part(zero, axis) = here - (diameter ? *shown[axis] / 2 : *shown[axis]);
      group.set[axis] = true;
      group.zero = zero;
      group.setLine = step.line;
    }
  }

  // The path from the last contact to where the measure ends, which the next move may go on with.
  Point3 wayBack(const Point3& end, std::size_t sides, Group& group) {
    Point3 at = group.searches.back()->to;
    const double tolerance = bores_ ? kMiddleTolerance : facts_.tolerance;
    bool left = false;
    while (now() != nullptr) {
      const MikroprogStep& step = *now();
      if (!step.moves()) {
        takeEvent(step, group);
        ++step_;
        continue;
      }
      const bool there = left && near(at, end, tolerance) && !(sides == kBoreSides && pendingDatum());
      if (there || step.kind == Kind::Search || step.kind == Kind::Protected) break;
      const Point3 way = step.to - at;
      const double length = way.length();
      const double share = length > 0 ? (end - at).dot(way) / (length * length) : -1;
      const bool passes = length > 0 && share >= 0 && share <= 1 + tolerance / length &&
                          near(at + way * share, end, tolerance);
      if (sides == 1 && passes) {
        if (!near(end, step.to, facts_.tolerance)) foundPiece(step, end);
        ++step_;
        at = end;
        left = true;
        takeEvents(group);
        break;
      }
      if (step.kind != Kind::Feed || sides == 1) break;
      at = step.to;
      left = true;
      ++step_;
    }
    return at;
  }

  void takeEvents(Group& group) {
    for (; now() != nullptr && !now()->moves(); ++step_)
      takeEvent(*now(), group);
  }

  // A datum still comes before the program does something else: the walk has not ended.
  bool pendingDatum() const {
    for (std::size_t i = step_; i < target_.steps.size(); ++i) {
      const Kind kind = target_.steps[i].kind;
      if (kind == Kind::Datum) return true;
      if (kind != Kind::Feed) return false;
    }
    return false;
  }

  // Where each search expects its surface: its end without the overtravel.
  void nominals(Measure& want, Measure& got, const Group& group, std::size_t sides) {
    double beside = 0; // by how much the first wall of a pair lies off its place
    for (std::size_t i = 0; i < group.searches.size(); ++i) {
      const MikroprogStep& step = *group.searches[i];
      Touch touch;
      const Point3 way = step.aim - step.from;
      const double length = way.length();
      if (!(length > 0)) continue;
      touch.direction = way * (1 / length);
      touch.point = step.aim - touch.direction * facts_.overtravel;
      const auto axis = axisOf(touch.direction);
      if (axis && *axis < 2) {
        // Bores are searched by the ball's centre where the wall is less a radius.
        touch.point.z += radius_;
        if (sides == kBoreSides) touch.point = touch.point + touch.direction * radius_;
      }
      // The second wall of a pair is searched from the first one.
      if (sides == kBoreSides && axis && i < want.nominal.size()) {
        const Point3& expected = want.nominal[i].point;
        if (i % 2 == 1 && !facts_.byOperator) part(touch.point, *axis) -= beside;
        if (step.contact && i % 2 == 0)
          beside = part(step.to + touch.direction * radius_, *axis) - part(expected, *axis);
      }
      got.nominal.push_back(touch);
      if (step.contact) got.contacts.push_back(*step.contact);
    }
  }

  // Spindle and coolant at a search, where the source has switched them.
  void settled(const Measure& given, const Group& group) {
    const MikroprogStep& step = *group.searches.front();
    const auto name = [](bool on) { return on ? "on" : "off"; };
    const bool turning = given.with.spindle != 0;
    if (step.spindle.value_or(false) != turning)
      add(Aspect::State,
          fmt::format("spindle {} against {} at a measure", name(turning),
                      name(step.spindle.value_or(false))),
          given.range, step.line);
    if (given.with.coolant == sim::Machine::Coolant::NotSwitched) return;
    const bool flowing = given.with.coolant != sim::Machine::Coolant::Off;
    if (!step.coolant || *step.coolant != flowing)
      add(Aspect::State,
          fmt::format("coolant {} against {} at a measure", name(flowing),
                      step.coolant ? name(*step.coolant) : "not switched"),
          given.range, step.line);
  }

  // ---- what the source's measure comes to from where the target makes it --------------------------------

  void predict(const Measure& given, Measure& want, std::size_t sides) {
    Point3 off; // of the surface from where the source expects it
    std::array<bool, 3> known{};
    change_ = {};
    const bool elsewhere = !near(error_, {}, 0);
    for (std::size_t i = 0; i < given.nominal.size() && i < given.contacts.size(); ++i) {
      const Touch& touch = want.nominal[i];
      sim::ProbeEvent contact = given.contacts[i];
      if (sides == 1 && elsewhere) {
        const Point3 from = want.start + Point3{0, 0, radius_};
        const Point3 to =
            from + touch.direction * ((touch.point - from).length() + facts_.overtravel + radius_);
        if (const auto met = sim::firstContact(world_.part(), radius_, from, to)) {
          contact.centre = met->centre;
          contact.point = met->point;
        }
      }
      want.contacts.push_back(contact);
      const auto axis = axisOf(touch.direction);
      if (!axis) continue;
      const double surface = part(contact.centre + touch.direction * radius_, *axis);
      const double was = part(given.contacts[i].centre + touch.direction * radius_, *axis);
      part(off, *axis) += (surface - part(given.nominal[i].point, *axis)) / (sides == 1 ? 1 : 2);
      part(change_, *axis) = surface - was;
      known[*axis] = true;
    }
    for (const auto& [key, zero] : given.datums) {
      const std::uint32_t axis = key.second;
      if (!known[axis] || facts_.byOperator) continue;
      part(error_, axis) = part(off, axis);
      corrected_ = true;
    }
    // After the first datum of a bore the ball is in the middle along X.
    if (sides == kBoreSides && given.datums.size() > 1 && !facts_.byOperator)
      for (std::size_t i = 2; i < want.nominal.size(); ++i)
        want.nominal[i].point.x = given.nominal[i].point.x + off.x;
  }

  void datums(const Measure& given, const Group& group) {
    std::array<bool, 3> wanted{};
    for (const auto& [key, zero] : given.datums) {
      const auto [system, axis] = key;
      wanted[axis] = true;
      const double want = zero + part(change_, axis);
      const bool set = group.zero && group.set[axis];
      const double got = set ? part(*group.zero, axis) : part(zero_, axis);
      // A zero that stays where it is has to be set as well.
      if (group.zero &&
          std::abs(want - got) <= (bores_ ? std::max(facts_.tolerance, kMiddleTolerance) : facts_.tolerance))
        continue;
      add(Aspect::Offset,
          fmt::format("the zero of G{} along {} lies at {} of the machine against {}", system, "XYZ"[axis],
                      fixedText(want, kShown), group.zero ? fixedText(got, kShown) : "nothing"),
          given.range, group.setLine);
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (group.set[axis] && !wanted[axis])
        add(Aspect::Offset, fmt::format("nothing against a datum along {}", "XYZ"[axis]), given.range,
            group.setLine);
  }

  // Each contact is kept in a record; of a bore that is set by G92, its size along each axis.
  void records(const Measure& given, const Group& group, std::size_t sides) {
    const std::uint32_t line = group.searches.front()->line;
    if (sides == kBoreSides && group.records == 0) {
      if (group.values.size() * 2 != group.searches.size()) {
        add(Aspect::Contact, fmt::format("{} sizes against {} records", sides / 2, group.values.size()),
            given.range, line);
        return;
      }
      for (std::size_t i = 0; i < group.values.size(); ++i) {
        const double size = (group.searches[2 * i]->to - group.searches[2 * i + 1]->to).length();
        if (std::abs(-2 * group.values[i]->value - size) <= kValueTolerance) continue;
        add(Aspect::Contact,
            fmt::format("a way of {} between the walls against {}", fixedText(size, kShown),
                        fixedText(-2 * group.values[i]->value, kShown)),
            given.range, group.values[i]->line);
      }
      return;
    }
    if (group.records != group.searches.size())
      add(Aspect::Contact,
          fmt::format("{} contacts against {} records", group.searches.size(), group.records), given.range,
          line);
  }

  // ---- the end --------------------------------------------------------------------------------------------

  // Where both are stopped on their path, one of them lies beside the other and meets the obstacle elsewhere.
  void obstructed() {
    if (source_.ending != Ending::Alarm || target_.ending != Ends::Collision) return;
    if (expected_.pieces.empty() || expected_.pieces.size() != found_.pieces.size()) return;
    const Piece& want = expected_.pieces.back();
    Piece& got = found_.pieces.back();
    const Point3 a = want.to - want.from, b = got.to - got.from;
    const double lengths = a.length() * b.length();
    if (want.kind != sim::PathKind::Protected || got.kind != want.kind || !(lengths > 0)) return;
    if (a.dot(b) / lengths < 1 - 1e-9) return;
    got.to = want.to;
    found_.end = expected_.end;
  }

  void ending() {
    expected_.ending = source_.ending;
    expected_.text = source_.text;
    expected_.alarm = source_.alarm;
    expected_.endedAt = source_.endedAt;
    const std::string obstructed(macroAlarmName(stdlib::MacroAlarm::PathObstructed));
    // Contact before a search begins is asked for before the chain.
    expected_.alarmKind =
        source_.alarmKind == macroAlarmName(stdlib::MacroAlarm::ProbeOpen) ? obstructed : source_.alarmKind;
    found_.endedAt = target_.endLine == 0 ? SourceRange{} : facts_.place(target_.endLine);
    switch (target_.ending) {
    case Ends::Finished: break;
    case Ends::NotFound:
      found_.ending = Ending::Alarm;
      found_.text = facts_.control.notFound;
      found_.alarmKind = macroAlarmName(stdlib::MacroAlarm::ProbeFail);
      break;
    case Ends::Collision:
      found_.ending = Ending::Alarm;
      found_.text = facts_.control.collision;
      found_.alarmKind = obstructed;
      break;
    case Ends::Broken:
      found_.ending = Ending::Inconclusive;
      found_.text = target_.why;
      break;
    }
  }

  const Record& source_;
  const MikroprogRecord& target_;
  sim::World& world_;
  const MikroprogFacts& facts_;
  const double radius_;
  Record expected_, found_;
  std::vector<Difference> own_;
  std::size_t measure_ = 0; // of the source, the next
  std::size_t step_ = 0;    // of the target, the next
  bool bores_ = false;
  bool corrected_ = false; // a datum has moved the target's system
  // By how much the target's way lies beside that of the source: what its datums have corrected.
  Point3 error_;
  Point3 change_; // by how much the target measures its surface elsewhere
  Point3 zero_;   // of the target's active system
};

} // namespace

bool goesOnInItsDatum(const Record& source, std::uint32_t system) {
  return std::any_of(source.measures.begin(), source.measures.end(), [&](const Measure& measure) {
    return std::any_of(measure.datums.begin(), measure.datums.end(),
                       [&](const auto& datum) { return datum.first.first == system; });
  });
}

MikroprogComparison compare(const Record& source, const MikroprogRecord& target, sim::World& world,
                            const MikroprogFacts& facts) {
  Sides sides(source, target, world, facts);
  MikroprogComparison out;
  out.differences = sides.run();
  if (!out.differences.empty()) out.undecided = sides.whyUndecided();
  return out;
}

} // namespace dotek::verify
