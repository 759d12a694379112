// What all kinds of sources share that verify looks at. A subject draws cases and runs them on both sides;
// the report puts together what they come to.
#pragma once

#include "project/Session.h"
#include "sim/geometry/Part.h"
#include "sim/geometry/Probe.h"
#include "sim/picture/Picture.h"
#include "targets/Options.h"
#include "verify/Bounds.h"
#include "verify/Compare.h"
#include "verify/Draw.h"
#include "verify/Stand.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dotek::targets {

// A translation as text, with what its lines come from.
struct Translation {
  std::string name, text;
  std::string converted; // the text that convert writes, where `text` is one that was edited; "": it is that
  std::vector<OutputArgument> arguments;
  std::set<std::uint32_t> handedBack; // common variables that its programs work in
  // By line from 0: files and lines; empty: made up. Nothing: not known, of a line that was edited.
  std::vector<std::optional<std::set<std::pair<std::string, std::uint32_t>>>> sources;

  // A line, from 1, that stems from nothing in the source.
  bool madeUp(std::uint32_t line) const;
  // The line, from 1, stems from a place of the source; true where one of the two is not known.
  bool stemsFrom(SourceRange source, std::uint32_t line, const SourceMap& sources) const;
};

// What all cases share.
struct VerifyPlan {
  std::vector<verify::DrawField> fields; // of a cycle
  std::map<std::string, double> fixedHosts;
  std::shared_ptr<const verify::Bounds> bounds; // of the checks; nullptr: not known
  std::map<std::string, int> hostDecimals;      // of host inputs that the post prints
  std::string sourceMacros, targetMacros;       // names of sets; "": none
  bool findsMacros = false; // the source's set, where it is "", is that which the posted program calls
  std::optional<Translation> translation; // nothing: the path is compared with the posted program
  std::optional<sim::MachineFile> machine;
  std::optional<sim::Part> part; // of --part; nothing: made from the path of each case
  // The posted program counts from where the probe is (#5003): it agrees with a path of the CAM, which begins
  // on the retract plane, only from there.
  bool startsOnRetract = false;
  // It moves to places, or sets offsets by words (G10), that the control has computed from what it has
  // measured or keeps.
  bool computesPlaces = false;
  bool cycleFile = false; // of the cycle language: its own meaning is the source
  bool programs = false;  // macro B against its conversion: fields are variables by number
};

// A difference in places that the user has: the source's files, lines of the translation.
struct CaseFinding {
  // The two that differ.
  enum class Pair : std::uint8_t { SourceAndTranslation, PathAndTranslation, PathAndPost };
  Pair pair = Pair::SourceAndTranslation;
  verify::Aspect aspect = verify::Aspect::Path;
  std::string text;
  SourceRange source;
  SourceRange posted;           // beside a path: the Prog's line
  std::uint32_t targetLine = 0; // from 1; 0: none
  std::string subject = {};     // as of verify::Difference
};

// Refused: the translation raises an alarm of its own before anything moves. NoProgram: the source prints
// none, or no source says what it does.
enum class CaseVerdict : std::uint8_t { Agrees, Undecided, Differ, Refused, NoProgram };

struct CaseResult {
  CaseVerdict verdict = CaseVerdict::Undecided;
  std::vector<CaseFinding> findings;
  std::string why; // it is undecided; "" where it is not
  SourceRange whyAt;
  std::uint32_t rejected = 0; // proposals before this one that the check at `whyAt` rejected, too
  std::string remedy;         // flags that give what the check reads: "`--var 1=VALUE`"; "": none is known
  // Protected moves that ran with the probe off, the first of the case; and whether the spindle was stopped
  // only after it.
  std::optional<SourceRange> unprotected;
  bool spindleLater = false;
  std::optional<SourceRange> unarmed; // the first measuring move with the probe off
  bool partMade = false;              // of the touches that the path shows
  // Undecided, but with other values the source may come to its end: it stops, or is not known, for these.
  bool ofValues = false;
  // Calls that both sides make alike and whose work no source states, with what it does not state.
  std::vector<std::pair<SourceRange, std::string>> unstated = {};
  // Subprograms that it calls and that are not at hand.
  std::vector<std::pair<SourceRange, std::uint32_t>> absent = {};
  // Of the source, in which its runs have ended since the last result: what the translation does there is
  // known.
  std::vector<SourceRange> alarms = {};
  std::vector<SourceRange> reached = {}; // statements that both sides ran for the first time
  std::vector<SourceRange> printed = {}; // all alarms that the posted program has where it moves
  std::string trace;                     // of the translation; only where VerifyOptions::traces wants it
};

// What the two sides run on, for people; "": there is none.
struct VerifySides {
  std::string sourceControl, targetControl; // "Fanuc 0i-MD, machining centre (fanuc-0i-md)"
  std::string form;                         // through which a Prog is read
};

// Why proposals of values were rejected.
struct Rejection {
  std::uint32_t count = 0;
  std::string why;
  SourceRange at;            // of a check; no place: the reach of the probe, or what the post prints
  bool byConversion = false; // the source takes them, and nothing is written for them
};

// By reason and place.
using Rejections = std::map<std::pair<std::string, std::uint32_t>, Rejection>;
// The commonest first.
std::vector<Rejection> commonestFirst(const Rejections& rejections);

// What ends the whole verification: the macro or the translation goes on for ever, or needs more than it may.
struct Stopped {
  Diagnostic why;
  verify::Case drawn; // with which values
};

// The runs of a case, and how each went, for people: "it ends".
struct CasePictures {
  sim::Picture source;
  std::string sourceEnds;
  std::optional<sim::Picture> translation; // nothing: it did not run
  std::string translationEnds;             // with the caller who sees the difference
};

using Places = std::set<std::pair<FileId, std::uint32_t>>; // where ranges begin

// One thread uses a subject.
class CaseSubject {
public:
  virtual ~CaseSubject() = default;
  virtual Session& session() = 0;
  virtual SourceRange place() const = 0; // of the source as a whole
  // The case of this number; nothing: no values were found within the attempts.
  virtual std::optional<verify::Case> draw(std::uint64_t index) = 0;
  // Another one of this number, after draw() or another() gave one; nothing: there is none.
  virtual std::optional<verify::Case> another(std::uint64_t /*index*/) { return std::nullopt; }
  virtual verify::Case edge(std::uint64_t index) = 0;
  // The case that `draw` gave last is run without another look at it.
  virtual CaseResult run(const verify::Case& drawn) = 0;
  // Of draw(), edge() or run(): nothing; or nothing more can be run, and what they gave says nothing.
  const std::optional<Stopped>& stopped() const { return stopped_; }
  // Fields whose picture drops digits of a value that is finer than its last place: printed where.
  virtual std::vector<std::pair<std::string, SourceRange>> droppedDigits(const verify::Case& /*drawn*/) {
    return {};
  }
  // Why the proposals of the last draw() were rejected, the most frequent reason first.
  virtual std::vector<Rejection> rejections() const { return {}; }
  // Statements of the source that end it with an alarm; none where they are not told apart.
  virtual std::vector<SourceRange> alarms() const { return {}; }
  // The first statement of each part of the source that is not among `reached`, without those that end in an
  // alarm; none where they are not told apart.
  virtual std::vector<SourceRange> unreached(const Places& /*reached*/) const { return {}; }
  virtual VerifySides sides() const { return {}; }
  // Of a case. nullopt: there is nothing to see.
  virtual std::optional<CasePictures> pictures(const verify::Case& /*drawn*/) { return std::nullopt; }

protected:
  std::optional<Stopped> stopped_;
};

// Programs of macro B, whose translations take the same values: variables by number.
class ProgramSubject : public CaseSubject {
public:
  // Reads the source; false: reported to session().
  virtual bool load() = 0;
  // What is drawn, with what `--var` gives; after load(). nullopt: reported.
  virtual std::optional<std::vector<verify::DrawField>> fields() = 0;
  virtual const std::map<std::string, double>& hosts() const = 0; // given
  // Names of the sets that both sides call; "": none.
  virtual std::string sourceMacros() const = 0;
  virtual std::string targetMacros() const = 0;
  // Before the first case, once the plan is complete.
  virtual bool prepare() = 0;
};

// `Target::programs` of a target whose programs this class runs.
template <class Runner>
std::unique_ptr<ProgramSubject> programsBy(const VerifyOptions& options, const VerifyPlan& plan) {
  return std::make_unique<Runner>(options, plan);
}

} // namespace dotek::targets
