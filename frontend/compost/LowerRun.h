// Private to Lower*.cpp: the walk over a routine, from statements to NC blocks with holes.
#pragma once

#include "frontend/compost/FormWalk.h"
#include "frontend/compost/Lower.h"
#include "frontend/nc/Lift.h"

namespace dotek::frontend::compost {

// The sink that makes blocks, with variables for the values.
class LowerRun : private FormWalk {
public:
  LowerRun(const Program& program, const std::string& cycleId, const LowerSettings& settings,
           Diagnostics& diagnostics);

  // Walks the routine; an open line is closed with a warning.
  void run(const Routine& routine);
  bool hasFailed() const { return failed_; }
  const std::vector<nc::Block>& blocks() const { return blocks_; }
  // The text of each of blocks().
  std::vector<ir::PrintedBlock> takePrinted();

private:
  // What an untaken side of a condition must not change; the flags of the conditions neither.
  struct State {
    std::vector<nc::Piece> line;
    SourceRange lineRange;
    std::map<int, std::string> modal; // modal G codes that the blocks wrote, by group
  };

  void text(std::string_view bytes, SourceRange range) override;
  void sequenceNumber(const std::string& address, SourceRange range) override;
  void value(const PrintedValue& value, const std::function<const Picture*()>& picture) override;
  void failed() override { failed_ = true; }
  void literal(const Literal& literal) override;
  void endLine(SourceRange where) override;
  void branch(const If& branch) override;
  // Reports the condition, or the modal codes that its sides leave different.
  void undecided(const If& branch, const Diagnostics& findings);
  // The modal codes in force after the statements.
  std::map<int, std::string> modalAfter(const std::vector<Statement>& statements);
  void add(nc::Piece piece, std::size_t bytes, SourceRange where);

  const LowerSettings& settings_;
  State state_;
  std::vector<nc::Block> blocks_;
  std::vector<ir::PrintedBlock> printed_;
  std::uint32_t compared_ = 0;
  bool comparing_ = false; // only the modal codes count
  bool failed_ = false;
};

} // namespace dotek::frontend::compost
