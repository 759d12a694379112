// What Compare*.cpp share: one pair of runs, and what was found of it.
#pragma once

#include "verify/Compare.h"

#include <string>
#include <string_view>
#include <vector>

namespace dotek::verify {

// Adds it where nothing of its aspect and subject is in the list.
void addFirst(std::vector<Difference>& list, Difference one);

// All outlive it.
struct ComparedPair {
  const Record& source;
  const Record& target;
  const CompareRules& rules;
  std::vector<Difference>& out; // the first of each aspect and subject

  void add(Aspect aspect, std::string text, SourceRange here, SourceRange there) const {
    addFirst(out, {aspect, std::move(text), here, there});
  }
  // Where other macros stop with their alarm is their own business; but after a measurement that is out of
  // its limits they have come back to where it began.
  bool stopsInMacros() const;
};

// What a translation says that compares a limit by itself (docs/convert.md, Calls); "": it compares none.
std::string_view ownTextOf(std::string_view alarmKind);

// What follows the last measure made it.
SourceRange lastMeasure(const Record& record);

// "the source has A, the translation B".
std::string sidesText(std::string_view source, std::string_view target);

// Two numbers that differ, as briefly as shows it: millionths, or all digits where these are the same.
struct ShownNumbers {
  std::string source, target;
};
ShownNumbers shownNumbers(double source, double target);

// All measures, each with its nominal contacts, its contacts and what it sets.
void compareMeasures(const ComparedPair& pair);
// Where one measure expects its surfaces, and how far it looks for them.
void compareNominal(const ComparedPair& pair, const Measure& a, const Measure& b);

// What is on; `when`: " at the end".
void compareState(const ComparedPair& pair, const Surroundings& a, const Surroundings& b,
                  std::string_view when, SourceRange here, SourceRange there);
// Tools, M codes, stops; what the probe meets besides; what is read or written early; switches of the probe.
void compareDeeds(const ComparedPair& pair);
void compareFaults(const ComparedPair& pair);
void compareEarlyUses(const ComparedPair& pair);
void compareSwitches(const ComparedPair& pair, bool sameMacros);

} // namespace dotek::verify
