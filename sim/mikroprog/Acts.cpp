#include "sim/mikroprog/Acts.h"

#include "sim/machine/Axes.h"
#include "sim/machine/Value.h"
#include "support/Decimal.h"

#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace dotek::sim::mikroprog {

namespace {

constexpr double kBackAbove = 0.5; // mm above the last depth, to which G83 comes back in rapid
constexpr double kMostPecks = 100'000;

double& keptOf(Machine& machine, double* cells, std::uint32_t what) {
  return cells[machine.layout().cellOf(variableOf(what))];
}
bool isOn(double kept) {
  return !isNull(kept) && kept != 0;
}

std::uint32_t axesOf(const stdlib::MikroprogControl& control) {
  std::uint32_t out = 0;
  for (std::size_t i = 0; i < 3; ++i)
    if (control.hasAxis(kAxisLetters[i])) out |= 1u << i;
  return out;
}

// nullopt: nobody knows.
std::optional<bool> holds(Machine& machine, double* cells, const stdlib::MikroprogControl& control,
                          std::uint32_t number) {
  if (const double given = keptOf(machine, cells, kCondition + number); !isNull(given)) return given != 0;
  if (number == 7) return machine.signalIsThere();
  if (number < 10 || number > 16) return std::nullopt;
  const double p = keptOf(machine, cells, kAccumulator);
  if (isNull(p)) return std::nullopt;
  if (number == 10) return p == 0;
  const std::size_t axis = (number - 11) / 2;
  const double place = machine.position()[axis] * (control.isDiameter(kAxisLetters[axis]) ? 2 : 1);
  return number % 2 == 1 ? p <= place : p > place;
}

class Doing {
public:
  Doing(const Act& act, Machine& machine, double* cells) : act_(act), machine_(machine), cells_(cells) {}

  bool run() {
    const std::string& what = act_.function.function;
    if (what == "system-off") {
      kept(kShift) = 0;
      machine_.shiftLocally({});
      return true;
    }
    if (what == "system-stored") return storedSystem();
    if (what == "system-local") return localSystem();
    if (what == "surface-speed") {
      kept(kSurface) = of('A');
      machine_.remark("surface-speed", "on A" + numberText(of('A')));
      return true;
    }
    if (what == "reference") return reference();
    if (what == "output-on" || what == "output-off") return output(what == "output-on");
    if (what == "thread-pass") return thread();
    return cycle();
  }

private:
  double& kept(std::uint32_t what) { return keptOf(machine_, cells_, what); }
  bool has(char letter) const { return act_.has(letter); }
  double of(char letter) const { return cells_[act_.words[slotOf(letter)]]; }
  bool refuse(std::string why) { return machine_.inconclusive(std::move(why)); }
  std::string code() const { return act_.function.code(); }

  double length(char axis) {
    return snap(act_.control.isDiameter(axis) && !isOn(kept(kRadius)) ? of(axis) / 2 : of(axis));
  }
  // The place that the words name; other axes are where they are.
  std::optional<Position> place() {
    if (machine_.mode(kDistance) != 0) {
      refuse(fmt::format("whether the words of {} are ways under G91 is not stated; write G90", code()));
      return std::nullopt;
    }
    Position out = machine_.position();
    for (std::size_t i = 0; i < 3; ++i)
      if (has(kAxisLetters[i])) out[i] = length(kAxisLetters[i]);
    return out;
  }

  bool storedSystem() {
    Position origin{};
    for (std::size_t i = 0; i < 3; ++i) {
      if (!act_.control.hasAxis(kAxisLetters[i])) continue;
      const double value = kept(storedShift(act_.function.number, i));
      if (isNull(value))
        return refuse(fmt::format("{} is a shift that the operator has entered; `--var {}.{}=VALUE` says it, "
                                  "one flag for each axis",
                                  code(), code(), kAxisLetters[i]));
      origin[i] = value;
    }
    kept(kShift) = act_.function.number;
    machine_.shiftLocally(origin);
    return true;
  }

  bool localSystem() {
    if (isOn(kept(kShift)))
      return refuse("whether G51 adds to the shift in force or takes its place is not stated; write G50 "
                    "before it");
    if (machine_.mode(kDistance) != 0) return refuse("what G51 means under G91 is not stated; write G90");
    Position origin{};
    for (std::size_t i = 0; i < 3; ++i)
      if (has(kAxisLetters[i])) origin[i] = length(kAxisLetters[i]);
    kept(kShift) = act_.function.number;
    machine_.shiftLocally(origin);
    return true;
  }

  bool reference() {
    if (isOn(kept(kShift)))
      return refuse(
          "what becomes of the shift in force in a reference run is not stated; write G50 before it");
    if (std::exchange(kept(kSurface), 0) > 0) machine_.remark("surface-speed", "off");
    return machine_.runToReference(axesOf(act_.control));
  }

  bool output(bool on) {
    if (!has('Q')) return machine_.raiseUnnumbered(code() + " without Q");
    const double number = of('Q');
    if (!(number >= 4 && number <= 7))
      return refuse(fmt::format("Q{} is no free output: {}", numberText(number),
                                number == 8 ? "it cuts the power section of the machine"
                                            : "it switches what M3, M4 and M8 switch, beside them"));
    machine_.remark("output", fmt::format("Q{} {}", numberText(number), on ? "on" : "off"));
    return true;
  }

  bool thread() {
    if (machine_.spindle() == 0)
      return refuse("the feed of a thread follows the spindle, and the spindle is at rest");
    const std::optional<Position> end = place();
    if (!end) return false;
    kept(kMotionLost) = 1;
    return machine_.threadTo(*end, of('K'));
  }

  bool cycle() {
    const std::optional<Position> end = place();
    if (!end) return false;
    const std::uint32_t number = act_.function.number;
    if (number != 79 && !machine_.knowsFeed())
      return refuse("which feed is in force after the program that G28 ran is not stated (Q25); write F");
    if (number != 79 && !(machine_.feed() > 0)) return machine_.raise(stdlib::Alarm::NoFeed);
    if (number == 81 || number == 83 || number == 85) return drill(*end, number);
    if (machine_.hasSkipSignal())
      return refuse(
          fmt::format("{} comes back to where it begins, and its path between is not stated; so what "
                      "it meets of a part or a machine is not known",
                      code()));
    machine_.traceRound(code(), *end);
    return true;
  }

  bool drill(const Position& end, std::uint32_t number) {
    const Position start = machine_.position();
    const double depth = std::abs(end[2] - start[2]), way = end[2] < start[2] ? -1 : 1;
    const double peck = number == 83 ? of('W') : depth;
    if (depth == 0) return true;
    if (!(peck > 0) || depth / peck > kMostPecks) return refuse("a peck of this size");
    Position at = start;
    for (double done = 0; done < depth;) {
      if (done > kBackAbove) {
        at[2] = snap(start[2] + way * (done - kBackAbove));
        if (!machine_.goTo(at, MotionKind::Rapid, std::nullopt)) return false;
      }
      done = std::min(depth, snap(done + peck));
      at[2] = done == depth ? end[2] : snap(start[2] + way * done);
      if (!machine_.goTo(at, MotionKind::Feed, std::nullopt)) return false;
      if (!machine_.goTo(start, number == 85 ? MotionKind::Feed : MotionKind::Rapid, std::nullopt))
        return false;
    }
    return true;
  }

  const Act& act_;
  Machine& machine_;
  double* cells_;
};

} // namespace

bool takesWords(std::string_view function) {
  return function == "cycle" || function == "thread-pass" || function == "system-local";
}

Action actionOf(const Act& act) {
  return [act](Machine& machine, double* cells) { return Doing(act, machine, cells).run(); };
}

Action askCondition(const stdlib::MikroprogControl& control, std::uint32_t number, std::uint32_t cell) {
  return [&control, number, cell](Machine& machine, double* cells) {
    const std::optional<bool> known = holds(machine, cells, control, number);
    if (known) {
      cells[cell] = *known ? 1 : 0;
      return true;
    }
    if (number == 7) return machine.inconclusive("O7 without a part");
    if (number >= 10 && number <= 16)
      return machine.inconclusive(fmt::format("P{} has no value", kAccumulator));
    return machine.inconclusive(fmt::format(
        "O{} is an input of the machine; `--var O{}=1` says that it holds, `O{}=0` that it does not", number,
        number, number));
  };
}

Action stopIf(const stdlib::MikroprogControl& control, std::uint32_t number, std::string text) {
  return [&control, number, text = std::move(text)](Machine& machine, double* cells) {
    const std::optional<bool> known = holds(machine, cells, control, number);
    if (!known)
      machine.remark("optional-stop", fmt::format("O{}", number));
    else if (*known)
      machine.pause(text);
    return true; // the operator goes on, or there was no stop
  };
}

Action endSurfaceSpeed() {
  return [](Machine& machine, double* cells) {
    if (isOn(std::exchange(keptOf(machine, cells, kSurface), 0))) machine.remark("surface-speed", "off");
    return true;
  };
}

Action dwellThen(std::uint32_t seconds) {
  return [seconds](Machine& machine, double* cells) {
    machine.dwellFor(cells[seconds]);
    return true;
  };
}

Action writeText(std::string file, std::string text) {
  return [file = std::move(file), text = std::move(text)](Machine& machine, double*) {
    machine.remark("write", text.empty() ? file : file + " " + text);
    return true;
  };
}

Action keep(Kept what, double value) {
  return [what, value](Machine& machine, double* cells) {
    keptOf(machine, cells, what) = value;
    return true;
  };
}

Action checkMotion() {
  return [](Machine& machine, double* cells) {
    return !isOn(keptOf(machine, cells, kMotionLost)) ||
           machine.inconclusive("whether G33 is in force after its block is not stated; write G0, G1 or G33");
  };
}

Action checkDiameters(bool said) {
  return [said](Machine& machine, double* cells) {
    return (!said && machine.mode(kDistance) == 0) || isOn(keptOf(machine, cells, kRadius)) ||
           machine.inconclusive("G91 with a diameter (Q9)");
  };
}

Action checkRadius(std::string why) {
  return [why = std::move(why)](Machine& machine, double* cells) {
    return !isOn(keptOf(machine, cells, kRadius)) || machine.inconclusive(why);
  };
}

Action checkNoShift() {
  return [](Machine& machine, double* cells) {
    return !isOn(keptOf(machine, cells, kShift)) ||
           machine.inconclusive("what G92 means under a shift (G51 to G55) is not stated (Q12); write G50 "
                                "before it");
  };
}

} // namespace dotek::sim::mikroprog
