// Private to Lower*.cpp: the walk over a routine, from statements to NC blocks with holes.
#pragma once

#include "frontend/compost/Conditions.h"
#include "frontend/compost/Lower.h"
#include "frontend/compost/ProgTables.h"
#include "frontend/nc/Lift.h"

#include <deque>

namespace dotek::frontend::compost {

class LowerRun {
public:
  LowerRun(const Program& program, const std::string& cycleId, const LowerSettings& settings,
           Diagnostics& diagnostics);

  // Walks the routine; an open line is closed with a warning.
  void run(const Routine& routine);
  bool failed() const { return failed_; }
  const std::vector<nc::Block>& blocks() const { return blocks_; }
  // The text of each of blocks().
  std::vector<ir::PrintedBlock> takePrinted() { return std::move(printed_); }

private:
  // What an untaken side of a condition must not change.
  struct State {
    Conditions conditions;
    std::vector<nc::Piece> line;
    SourceRange lineRange;
    std::map<int, std::string> modal; // modal G codes that the blocks wrote, by group
  };

  void call(const Routine& routine, SourceRange where);
  void body(const std::vector<Statement>& statements);
  void branch(const If& branch);
  // Reports the condition, or the modal codes that its sides leave different.
  void undecided(const If& branch, const Diagnostics& findings);
  // The modal codes in force behind the statements.
  std::map<int, std::string> modalAfter(const std::vector<Statement>& statements);
  void word(const Word& word);
  void command(const Word& word);
  void numeric(const Word& word);
  void text(std::string_view bytes, SourceRange range);
  void hole(std::optional<ir::VariableId> variable, const Picture* picture, const std::string& what,
            SourceRange range);
  void grow(std::size_t bytes, SourceRange where);
  void endLine(SourceRange where);
  bool step(SourceRange where);

  template <class Id, class... Args> void refuse(SourceRange range, const Args&... args) {
    failed_ = true;
    diagnostics_->report<Id>(range, args...);
  }

  const LowerSettings& settings_;
  Diagnostics* diagnostics_; // a side that is only compared reports elsewhere
  ProgTables tables_;
  State state_;
  std::deque<Picture> commandPictures_; // blocks point into it
  std::vector<nc::Block> blocks_;
  std::vector<ir::PrintedBlock> printed_;
  std::set<std::string, std::less<>> told_; // words that the form lacks
  std::uint64_t steps_ = 0;
  std::uint64_t bytes_ = 0;
  std::uint32_t depth_ = 0;
  std::uint32_t compared_ = 0;
  bool comparing_ = false; // only the modal codes count
  bool stopped_ = false;   // a limit was hit
  bool failed_ = false;
};

} // namespace dotek::frontend::compost
