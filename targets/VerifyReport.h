// The report of `verify`: what the cases come to. The order in which they are added does not matter.
#pragma once

#include "targets/Subject.h"
#include "targets/VerifyDocument.h"

#include <map>
#include <set>
#include <string>
#include <tuple>

namespace dotek::targets {

class VerifyReport {
public:
  // All outlive the report. `runner` shrinks what differs and holds the diagnostics.
  VerifyReport(const VerifyOptions& options, const VerifyPlan& plan, CaseSubject& runner)
      : options_(options), plan_(plan), runner_(runner) {}

  void add(std::uint64_t number, bool edge, verify::Case drawn, CaseResult result);
  // Values of a case in whose place others were drawn, and what came of them: nothing.
  void addReplaced(std::uint64_t number, verify::Case drawn, CaseResult result);
  // A case that ended the verification: nothing else is reported than the first of them.
  void addStopped(std::uint64_t number, Stopped stopped);
  // Reports the first of them to the runner's session; false: there is none.
  bool tellStopped();
  // What the document says besides what the cases show. `edited`: the translation is not what convert writes.
  void addSaid(std::vector<VerifyDocument::Finding> said, bool edited = false);
  // Reports to the runner's session, and gives the line of the verdict.
  std::string finish();
  // After finish(): the document of VerifyOptions::format; "" of the format Text.
  std::string rendered() const;

private:
  struct Group {
    std::uint64_t count = 0, first = 0; // number of the first case
    std::uint64_t alone = 0;            // cases in which the path and the post alone differ
    bool edge = false;                  // all of them are
    verify::Case drawn;
    CaseFinding finding;
  };
  struct Idle {
    std::uint64_t count = 0, first = 0;
    bool edge = false;
    SourceRange at;
    std::string why, remedy;
    std::uint64_t rejected = 0; // proposals, by the check
    verify::Case drawn;
  };
  struct Counts {
    std::uint64_t agree = 0, undecided = 0, differ = 0, refused = 0, none = 0;
    std::uint64_t all() const { return agree + undecided + differ + refused + none; }
  };
  using Key =
      std::tuple<bool, CaseFinding::Pair, verify::Aspect, FileId, std::uint32_t, std::uint32_t, std::string>;

  static Key keyOf(bool edge, const CaseFinding& finding);
  bool stillDiffers(const verify::Case& drawn, const CaseFinding& finding);
  verify::Case shrink(const Group& group);
  std::string command() const; // as far as it says what is compared
  std::string wholeCommand() const;
  std::string replay(const verify::Case& drawn) const;
  void tellDifference(const Group& group, std::uint64_t of);
  std::string verdict();
  void tellIdle(const Idle& idle);
  void tellReplaced();
  void tellUnstated();
  void tellAlarms();
  void tellEdits();
  VerifyDocument::Excerpt excerptOf(SourceRange range);
  std::string pairText() const;
  void describe();
  void describeInputs();
  const verify::Case* shown() const; // in the document; nullptr: none
  void addNotes();
  void addPicture();
  void tellMachine(); // what of --machine no case looks at
  void tellProbe();
  void tellPictures();
  SourceRange targetRange(std::uint32_t line);
  SourceRange sourceOfLine(std::uint32_t line) const;

  const VerifyOptions& options_;
  const VerifyPlan& plan_;
  CaseSubject& runner_;
  bool partsMade_ = false; // in the place of the one that was given
  Diagnostics told_;       // the runner's own are of its last case
  std::optional<FileId> translationFile_;
  Counts cases_, edges_;
  VerifyDocument document_;
  std::map<Key, Group> groups_;
  using Reason = std::tuple<bool, FileId, std::uint32_t, std::string>; // edges apart
  std::map<Reason, Idle> idle_, replaced_;
  std::map<std::pair<FileId, std::uint32_t>, std::pair<SourceRange, std::string>> unstated_; // by place
  std::map<std::pair<FileId, std::uint32_t>, std::pair<SourceRange, std::uint32_t>> absent_; // by place
  std::map<std::pair<FileId, std::uint32_t>, std::pair<SourceRange, bool>> unprotected_;
  std::optional<SourceRange> unarmed_;
  std::map<std::pair<FileId, std::uint32_t>, SourceRange> printed_; // alarms of the source, by place
  Places alarms_;                                                  // of the source, in which cases have ended
  Places reached_;                                                 // of its statements
  std::optional<std::pair<std::uint64_t, verify::Case>> agreeing_; // the first
  std::optional<std::pair<std::uint64_t, Stopped>> stopped_;       // the first
};

} // namespace dotek::targets
