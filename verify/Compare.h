// What two runs did differently.
#pragma once

#include "stdlib/Control.h"
#include "verify/DrawnPath.h"
#include "verify/Record.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace dotek::verify {

enum class Aspect : std::uint8_t {
  Ending,   // alarms, their code and place; a side that cannot be judged
  Path,     // points of the path, and how they are reached
  State,    // feed, probe, spindle, coolant while moving; the latter at the end, too
  Nominal,  // where surfaces are expected
  Contact,  // where they were met; what the probe met that it should not
  Offset,   // zeros of work systems
  Tool,     // entries of the tool table that were changed
  Variable, // that the source stores
  End,      // end position
  Modal,    // codes in force at the end
  Printed,  // what DPRNT and BPRNT sent
};
std::string_view aspectName(Aspect aspect);

struct Difference {
  Aspect aspect = Aspect::Path;
  std::string text;           // "Z 4.000 against 5.000": the source first
  SourceRange source, target; // in the programs that ran; may be without a place
  std::string subject = {};   // of several that an aspect may have: "G54 X", "#600"; "": of the first one
};

inline constexpr std::size_t kMostOfAspect = 12; // of these subjects

struct CompareRules {
  double tolerance = 1e-6; // mm; also of degrees and variables
  // Of results that the control has computed: offsets, variables. Not below `tolerance`.
  double results = 1e-6;
  double angles = 0;   // degrees, of variables where an angle is found by two touches
  double relative = 0; // share of a variable's or a zero's value that counts as equal beside that
  // Whether a place of the target's program stems from a place of the source's. Nothing: not compared.
  std::function<bool(SourceRange source, SourceRange target)> samePlace;
  // Modal groups may also end as they stood at entry: the target is called and puts them back.
  bool mayRestoreModes = false;
  // The target is the same program, translated: it stores and prints nothing else, and alarms that no probing
  // macro raises have their numbers; of #3000 their texts, too, as far as the control shows them.
  bool sameProgram = false;
  // The target is a program for another kind of control: feeds, spindle and coolant count where it measures
  // alone, coolant only where the source has switched it. Each measure sets the same axes, of whatever
  // system.
  bool atMeasures = false;
  bool switchesProbe = false;    // the target switches the probe off at its end, whatever the source leaves
  bool toolParts = false;        // geometry and wear of a tool offset count each, else their sum
  bool sameAlarmNumbers = false; // both call the same macros: numbers and texts count, not only their kind
  std::optional<double> overtravel; // that the target's calls may state where the source states none, mm
  // Where the two run on controls that number their modal groups differently: codes in force at the end are
  // compared by their meaning on each. Both or none.
  const stdlib::Control* sourceControl = nullptr;
  const stdlib::Control* targetControl = nullptr;
  std::uint32_t shownText = 26; // characters of a message that the target's control shows
  bool waits = false; // the target's control knows a code that waits: it uses nothing early that the source
                      // does not
};

// The first difference of each aspect, and each offset and variable that differs, in the order of the
// aspects. Of a different ending only what the two did differently before it, and that they end so, or that
// alone.
std::vector<Difference> compare(const Record& source, const Record& target, const CompareRules& rules);

// How it ended, for people: "it ends", "alarm 3093 (PROBE FAIL)".
std::string endText(const Record& record);

// Two runs of one program, called from different states: it does the same, but for modes that it leaves. Both
// have to be evidence.
bool runsAlike(const Record& one, const Record& other, const CompareRules& rules);

// The drawn path beside the program: points without their kinds, nominal contacts, end. `offset`: from the
// system of the path to the machine. `loops`: the program measures in a loop, which may end before a path
// that draws each round.
std::vector<Difference> compare(const DrawnPath& path, const sim::Point3& offset, const Record& program,
                                double tolerance, bool loops = false);

// It ends, and each of its measures has met a surface.
bool findsAll(const Record& record);

// Where the first measuring move, and the first protected one, ran with the probe off; calls, too.
struct ProbeOff {
  std::optional<SourceRange> measuring, protectedMove;
};
ProbeOff probeOffIn(const Record& record);

// Why a run of the source says nothing of a translation that does the same: an alarm, a collision, a
// measuring move with the probe off, a measure without contact. "": it is evidence; `at`: where.
std::string whyNoEvidence(const Record& record, SourceRange& at);

} // namespace dotek::verify
