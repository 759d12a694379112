// Blocks that the modes before them make wrong: a feed that nobody gave, canned cycles without their levels,
// arcs that do not close, codes that a mode does not allow.
#include "frontend/macrob/BlockWords.h"
#include "frontend/macrob/Calls.h"
#include "frontend/macrob/Check.h"
#include "frontend/macrob/Walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <map>

namespace dotek::frontend::macrob {
namespace {

const nc::Word* findAny(const Words& words, std::initializer_list<double> codes) {
  for (const double code : codes)
    if (const nc::Word* word = findCode(words, 'G', code)) return word;
  return nullptr;
}

// All codes of the block are numbers, and none is a builder's.
bool isPlain(const Words& words) {
  return !callOf(words) && std::all_of(words.words.begin(), words.words.end(), [](const nc::Word& word) {
    return word.address != 'G' || literal(word).value_or(100) < 100;
  });
}

// Codes that take the axis words of their block.
const nc::Word* takesWords(const Words& words) {
  return findAny(words, {4, 10, 28, 29, 30, 31, 52, 53, 60, 68, 92});
}

// `visit(block, words, modes before it, modes for its words)`, for blocks that some path leads to.
template <class Visit> void eachBlock(const CheckedProgram& input, const Visit& visit) {
  const std::vector<std::optional<Modes>>& modes = input.modes();
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const Block& block = input.program.blocks[i];
    const auto* words = std::get_if<Words>(&block.body);
    if (words == nullptr || block.repaired || !modes[i] || !isPlain(*words)) continue;
    visit(*words, *modes[i], within(*words, *modes[i]));
  }
}

// The plane's axes, 0 for X; `plane`: 17 to 19.
std::array<long, 2> axesOf(int plane) {
  const std::array<char, 2>& letters = lettersOf(plane).axes;
  return {letters[0] - 'X', letters[1] - 'X'};
}

// The number of the work offset (54 to 59) that a block `G10 L2 P` sets in the plane, 53 for the external one
// that all of them add; 0: it sets none, or which is not known.
int setsSystem(const Words& words, int plane) {
  if (plane == 0 || findCode(words, 'G', 10) == nullptr || findCode(words, 'L', 2) == nullptr) return 0;
  const std::array<char, 2>& letters = lettersOf(plane).axes;
  if (!hasAny(words, std::string(letters.begin(), letters.end()))) return 0;
  const nc::Word* system = findWord(words, 'P');
  const auto number = system == nullptr ? std::nullopt : literal(*system);
  if (!number || !(*number >= 0 && *number <= 6) || *number != std::floor(*number)) return 0;
  return 53 + static_cast<int>(*number);
}

// The same of an assignment to the variable of an offset.
int setsSystem(long variable, int plane, const stdlib::Control& control) {
  const stdlib::SystemVariables& v = control.variables;
  for (const long axis : axesOf(plane)) {
    const long inSystem = axis * v.axisStep;
    if (v.externalX && variable == *v.externalX + inSystem) return 53;
    for (int system = 0; v.workOffsetX && system < 6; ++system)
      if (variable == *v.workOffsetX + system * v.systemStep + inSystem) return 54 + system;
  }
  return 0;
}

// Assignments to an offset that counts in the turned coordinates.
void offsetUnderRotation(const CheckedProgram& input, Report& report) {
  const std::vector<std::optional<Modes>>& modes = input.modes();
  for (std::size_t i = 0; i < modes.size(); ++i) {
    if (!modes[i] || modes[i]->rotation != Certain::Yes || modes[i]->plane == 0) continue;
    const nc::Assignment* assignment = assignmentOf(input.program.blocks[i]);
    const auto number = assignment == nullptr ? std::nullopt : literal(*assignment->variable);
    if (!number || !(*number >= 1000 && *number < 1e6)) continue;
    if (!input.onEach([&](const stdlib::Control& control) {
          const int set = setsSystem(std::lround(*number), modes[i]->plane, control);
          return set == 53 || (set != 0 && set == modes[i]->system);
        }))
      continue;
    report.at({assignment->range.file, assignment->range.begin, assignment->variable->range.end},
              "#{} moves the zero while G68 turns the coordinates; the manuals of Fanuc do not allow it, and "
              "the control moves to another place or stops with an alarm; write G69 before it",
              std::lround(*number));
  }
}

// G43 with Z while the plane is not that of X and Y.
void lengthOutsideOfPlane(const CheckedProgram& input, Report& report) {
  eachBlock(input, [&](const Words& words, const Modes&, const Modes& now) {
    const nc::Word* code = findAny(words, {43, 44});
    if (code == nullptr || now.plane < 18 || !hasAny(words, "Z") || hasAny(words, "XY")) return;
    report.at(code->range,
              "`{}` while G{} is in force: a parameter says whether the tool length goes along Z or across "
              "the plane, along {}; without it Z goes deeper by the length; write G17 before it",
              wordText(*code), now.plane, lettersOf(now.plane).depth);
  });
}

} // namespace

void feedMissing(const CheckedProgram& input, Report& report) {
  if (!isMain(input.program)) return; // of others the caller gives it
  bool told = false;
  eachBlock(input, [&](const Words& words, const Modes&, const Modes& now) {
    const bool moves = now.cycle == Certain::Yes || (now.cycle == Certain::No && now.motion > 0);
    if (told || now.feed != Certain::No || !moves || hasAny(words, "F") || !hasAny(words, "XYZ") ||
        takesWords(words) != nullptr)
      return;
    told = true;
    report.at(
        words.words.front().range,
        "no feed was given on the path to this move; the control stops with alarm 11, or moves at the feed "
        "of "
        "the program before; write F");
  });
}

void cycleWords(const CheckedProgram& input, Report& report) {
  bool told = false;   // of this cycle, whose further holes lack the same
  bool dwells = false; // a cycle before had P
  eachBlock(input, [&](const Words& words, const Modes&, const Modes& now) {
    if (now.cycle != Certain::Yes || takesWords(words) != nullptr) return;
    const nc::Word* code = findWord(words, 'G');
    for (const nc::Word& word : words.words) {
      if (word.address != 'G' || literal(word) != now.cycleCode) continue;
      code = &word;
      told = false;
    }
    const SourceRange range = code != nullptr ? code->range : words.words.front().range;
    const std::string name = now.cycleCode != 0 ? fmt::format("G{}", now.cycleCode) : "the cycle";
    for (const char letter : {'K', 'L'})
      if (const nc::Word* repeats = findWord(words, letter))
        if (const auto value = literal(*repeats); value && (*value < 0 || *value != std::floor(*value)))
          report.at(
              repeats->range,
              "`{}` counts the holes of a canned cycle and is no whole number from 0; the control stops with "
              "an alarm; correct it",
              wordText(*repeats));
    const bool storesOnly = findCode(words, 'K', 0) != nullptr || findCode(words, 'L', 0) != nullptr;
    if (told || !hasAny(words, "XYZR") || storesOnly) return;
    const auto tell = [&]<class... Args>(fmt::format_string<Args...> text, Args&&... args) {
      told = true;
      report.at(range, text, std::forward<Args>(args)...);
    };
    const char axis = lettersOf(now.plane == 0 ? 17 : now.plane).depth;
    if (now.levelR == Certain::No && !hasAny(words, "R"))
      tell("{} has no level R; the control drills from where the tool is, at feed through air or at rapid "
           "into the part, or stops with an alarm; write R",
           name);
    if (now.plane != 0 && now.depth == Certain::No && !hasAny(words, {&axis, 1}))
      tell("{} has no depth; the control drills to the depth of an earlier cycle or stops with an alarm; "
           "write {}",
           name, axis);
    if ((now.cycleCode == 73 || now.cycleCode == 83) && now.peck == Certain::No && !hasAny(words, "Q"))
      tell("{} has no Q, the depth of a peck; the control stops with alarm 45 or drills in one go; write Q",
           name);
    if (now.cycleCode == 87 && now.returnsToR == Certain::Yes)
      tell("G87 returns to the initial level alone, and G99 is in force; the control stops with an alarm, "
           "or the tool stays below the part; write G98");
    const bool begins = now.cycleCode != 0 && findCode(words, 'G', now.cycleCode) != nullptr;
    const nc::Word* const peck = findWord(words, 'Q');
    if (!told && begins && (now.cycleCode == 76 || now.cycleCode == 87) && now.peck == Certain::No &&
        peck == nullptr)
      tell("{} has no Q, by which the tool leaves the wall before it goes out; the control stops with an "
           "alarm, or the tool scores the bore; write Q",
           name);
    if (peck != nullptr && (now.cycleCode == 73 || now.cycleCode == 83))
      if (const auto value = literal(*peck); value && *value <= 0) {
        told = true;
        report.at(
            peck->range,
            "`{}`: the depth of a peck is above 0; the control stops with an alarm or drills in one go; "
            "write the depth",
            wordText(*peck));
      }
    const bool waits = hasAny(words, "P");
    if (begins && (now.cycleCode == 82 || now.cycleCode == 89) && !waits && !dwells)
      tell("{} has no P, the dwell at the bottom; it does what G{} does, or waits as long as an earlier "
           "cycle; "
           "write P",
           name, now.cycleCode == 82 ? 81 : 85);
    dwells = dwells || waits;
  });
}

void modeForbidsCode(const CheckedProgram& input, Report& report) {
  const auto tell = [&](const nc::Word& code, std::string_view mode, std::string_view remedy) {
    report.at(code.range,
              "`{}` while {}; the manuals of Fanuc do not allow it, and the control stops with an alarm "
              "or moves to another place; {}",
              wordText(code), mode, remedy);
  };
  eachBlock(input, [&](const Words& words, const Modes& before, const Modes& now) {
    if (before.cycle == Certain::Yes && now.cycle == Certain::Yes) {
      const nc::Word* plane = findAny(words, {17, 18, 19});
      if (plane != nullptr && (before.plane == 0 || before.plane == now.plane)) plane = nullptr;
      const nc::Word* code = plane != nullptr ? plane : findAny(words, {28, 29, 30, 31, 53});
      if (code != nullptr) return tell(*code, "a canned cycle is on", "write G80 before it");
    }
    if (before.compensation == Certain::Yes && now.compensation == Certain::Yes) {
      if (const nc::Word* code = findAny(words, {31}))
        return tell(*code, "cutter compensation is on (alarm 36)", "write G40 before it");
      const nc::Word* plane = findAny(words, {17, 18, 19});
      if (plane != nullptr && before.plane != 0 && before.plane != now.plane)
        return tell(*plane, "cutter compensation is on (alarm 37)", "write G40 before it");
    }
    if (before.rotation == Certain::Yes && now.rotation == Certain::Yes) {
      const nc::Word* code = findAny(words, {52, 92});
      const nc::Word* plane = findAny(words, {17, 18, 19});
      if (plane != nullptr && before.plane != 0 && before.plane != now.plane) code = plane;
      const nc::Word* system = findAny(words, {54, 54.1, 55, 56, 57, 58, 59});
      if (system != nullptr && before.system != 0 && before.system != now.system) code = system;
      if (const int set = setsSystem(words, now.plane); set == 53 || (set != 0 && set == now.system))
        code = findAny(words, {10});
      if (code != nullptr) return tell(*code, "G68 turns the coordinates", "write G69 before it");
    }
  });
  lengthOutsideOfPlane(input, report);
  offsetUnderRotation(input, report);
}

// ---- arcs

namespace {

double orZero(const nc::Word* word) {
  return word == nullptr ? 0 : literal(*word).value_or(0);
}

class Arcs {
public:
  Arcs(const CheckedProgram& input, Report& report)
      : tolerance_(input.control != nullptr ? input.control->arcTolerance.value_or(kTolerance) : kTolerance),
        bare_(input.control == nullptr || input.control->decimal == stdlib::DecimalMode::Increment),
        report_(report) {}

  void check(const Words& words, const Modes& before, const Modes& now) const {
    if (now.motion < 2 || now.cycle != Certain::No || now.plane == 0 || takesWords(words) != nullptr) return;
    const PlaneLetters& plane = lettersOf(now.plane);
    const nc::Word* code = findAny(words, {2, 3});
    const SourceRange range = code != nullptr ? code->range : words.words.front().range;
    const nc::Word* radius = findWord(words, 'R');
    if (const nc::Word* unused = findWord(words, plane.unusedCentre); unused != nullptr && radius == nullptr)
      report_.at(
          unused->range,
          "an arc in G{} has its centre at {} and {}, and `{}` belongs to another plane; the control stops "
          "with "
          "an alarm, or makes another arc; write the plane, or the letter that is meant",
          now.plane, plane.centre[0], plane.centre[1], wordText(*unused));
    if (radius != nullptr && !hasAny(words, std::string(plane.axes.begin(), plane.axes.end()))) {
      fullCircle(*radius, plane);
      return;
    }
    ends(words, before, now, plane, range);
  }

private:
  static constexpr double kTolerance = 0.03;

  void fullCircle(const nc::Word& radius, const PlaneLetters& plane) const {
    report_.at(radius.range,
               "a full circle with R has any number of centres; the control does not move, or stops with an "
               "alarm; write {} and {} of the centre",
               plane.centre[0], plane.centre[1]);
  }

  // The value is the same whatever the control makes of numbers without a point.
  bool isCertain(const nc::Word& word) const {
    const nc::Number* number = word.value == nullptr ? nullptr : std::get_if<nc::Number>(&word.value->node);
    if (const auto* negated = word.value == nullptr ? nullptr : std::get_if<nc::Negated>(&word.value->node))
      number = std::get_if<nc::Number>(&negated->operand->node);
    return literal(word) && number != nullptr && (number->point || number->value == 0 || !bare_);
  }

  // The centre lies as far from start and end if its numbers are coordinates.
  bool fitsAsPoint(const Modes& before, const PlaneLetters& plane, const std::array<double, 2>& way,
                   const std::array<double, 2>& centre) const {
    std::array<double, 2> from{};
    for (std::size_t i = 0; i < 2; ++i) {
      const auto start = before.at[static_cast<std::size_t>(plane.axes[i] - 'X')];
      if (!start) return false;
      from[i] = centre[i] - *start;
    }
    const double first = std::hypot(from[0], from[1]);
    return first > tolerance_ &&
           std::abs(first - std::hypot(from[0] - way[0], from[1] - way[1])) <= tolerance_;
  }

  // Of an arc whose start, end and centre are numbers.
  void ends(const Words& words, const Modes& before, const Modes& now, const PlaneLetters& plane,
            SourceRange range) const {
    std::array<double, 2> way{}, centre{};
    for (std::size_t i = 0; i < 2; ++i) {
      const nc::Word* end = findWord(words, plane.axes[i]);
      const auto start = before.at[static_cast<std::size_t>(plane.axes[i] - 'X')];
      if (end != nullptr) {
        if (!isCertain(*end) || now.distance == 0 || (now.distance == 90 && !start)) return;
        way[i] = *literal(*end) - (now.distance == 90 ? *start : 0);
      }
      const nc::Word* middle = findWord(words, plane.centre[i]);
      if (middle != nullptr && !isCertain(*middle)) return;
      centre[i] = orZero(middle);
    }
    const double chord = std::hypot(way[0], way[1]);
    if (const nc::Word* radius = findWord(words, 'R')) {
      if (!isCertain(*radius)) return;
      if (chord == 0) return fullCircle(*radius, plane);
      if (const double r = std::abs(*literal(*radius)); r > 0 && chord / 2 - r > tolerance_)
        report_.at(
            range,
            "the ends of this arc are {:.3f} apart and its radius is {:.3f}, less than half of that; the "
            "control stops with alarm 20; correct the end point or R",
            chord, r);
      return;
    }
    if (!hasAny(words, std::string(plane.centre.begin(), plane.centre.end()))) return;
    const double first = std::hypot(centre[0], centre[1]);
    const double second = std::hypot(centre[0] - way[0], centre[1] - way[1]);
    if (std::abs(first - second) > tolerance_)
      report_.at(
          range,
          "the start of this arc is {:.3f} from its centre and the end {:.3f}; the control stops with alarm "
          "20 (over tolerance of radius); correct the end point or the centre{}",
          first, second,
          fitsAsPoint(before, plane, way, centre)
              ? fmt::format("; {} and {} fit as coordinates of the centre, and the control takes them as "
                            "distances from the start",
                            plane.centre[0], plane.centre[1])
              : "");
  }

  double tolerance_;
  bool bare_;
  Report& report_;
};

} // namespace

void arcGeometry(const CheckedProgram& input, Report& report) {
  const Arcs arcs(input, report);
  eachBlock(input, [&](const Words& words, const Modes& before, const Modes& now) {
    arcs.check(words, before, now);
  });
}

// ---- rotation

void rotationWords(const CheckedProgram& input, Report& report) {
  eachBlock(input, [&](const Words& words, const Modes& before, const Modes& now) {
    if (now.motion >= 0 && now.distance == 91 && now.rotation == Certain::No && takesWords(words) == nullptr)
      for (std::size_t axis = 0; axis < before.turned.size(); ++axis) {
        const nc::Word* word = findWord(words, static_cast<char>('X' + axis));
        if (!before.turned[axis] || word == nullptr || literal(*word) == 0.0) continue;
        report.at(word->range,
                  "`{}` is the first move of this axis after G69, and incremental; the manuals of Fanuc ask "
                  "for an absolute one, as the control may count from where the program was in turned "
                  "coordinates; write it under G90",
                  wordText(*word));
        break;
      }
    const nc::Word* code = findCode(words, 'G', 68);
    if (code == nullptr || hasAny(words, "IJK")) return;
    if (const nc::Word* off = findCode(words, 'G', 69))
      report.at(off->range,
                "G68 and G69 in one block; which of them holds is not known; give each a block of its own");
    const nc::Word* angle = findWord(words, 'R');
    if (angle == nullptr)
      report.at(code->range,
                "G68 without R turns by an angle that a parameter holds (5410 on a Fanuc); on another "
                "machine everything that follows is elsewhere; write R");
    else if (const auto value = literal(*angle); value && std::abs(*value) > 360)
      report.at(angle->range,
                "`{}`: an angle is from -360 to 360 degrees; the control stops with an alarm; correct it",
                wordText(*angle));
    if (now.plane == 0) return;
    const auto [depth, axes] = std::pair(lettersOf(now.plane).depth, lettersOf(now.plane).axes);
    const nc::Word *first = findWord(words, axes[0]), *second = findWord(words, axes[1]);
    const nc::Word* outside = findWord(words, depth);
    if (outside == nullptr && (first == nullptr) != (second == nullptr)) {
      const nc::Word& given = first != nullptr ? *first : *second;
      report.at(given.range,
                "the centre of the rotation has `{0}` and no {1}; the control takes the other from where the "
                "tool is, or stops with an alarm; write {1}, or leave `{0}` out if the tool is at the centre",
                wordText(given), axes[first != nullptr ? 1 : 0]);
    }
    if (outside != nullptr)
      report.at(outside->range,
                "the centre of a rotation lies in the plane, which is G{}, and `{}` does not; the control "
                "stops with an alarm or moves {}; leave it out",
                now.plane, wordText(*outside), depth);
  });
}

// ---- calls

void callsItself(const CheckedProgram& input, Report& report) {
  if (!input.program.name || input.modes().empty()) return;
  const std::uint64_t own = input.program.name->number;
  std::vector<bool> passed;
  std::map<const nc::Word*, std::size_t> blocks; // by the first of their words
  for (const std::vector<Call>* list : {&input.calls, &input.subprograms})
    for (const Call& call : *list) {
      if (call.kind == CallKind::AfterMoves || call.kind == CallKind::EachBlock || call.program == nullptr ||
          own == 0 || literal(*call.program) != static_cast<double>(own))
        continue;
      if (passed.empty()) {
        passed = passedByAllPaths(input.program);
        for (std::size_t i = 0; i < passed.size(); ++i)
          if (const auto* words = std::get_if<Words>(&input.program.blocks[i].body);
              words != nullptr && !words->words.empty())
            blocks.emplace(words->words.data(), i);
      }
      const auto behind = blocks.upper_bound(call.program);
      if (behind == blocks.begin()) continue;
      // The call is certain where no path from the start goes around it.
      const std::size_t at = std::prev(behind)->second;
      if (!passed[at] || input.program.blocks[at].blockDelete) continue;
      report.at(
          call.program->range,
          "O{} calls itself here, and no path ends before the call; the control stops with alarm 122 or 77 "
          "(too many levels); call the program that is meant, or write the IF that ends it",
          own);
    }
}

} // namespace dotek::frontend::macrob
