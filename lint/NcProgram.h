// One program of an NC file as rules look at it, with what several of them ask of it.
#pragma once

#include "lint/IndirectWrites.h"
#include "lint/Lazy.h"
#include "lint/Machining.h"
#include "lint/Skips.h"

#include <memory>
#include <optional>
#include <set>
#include <vector>

namespace dotek::lint {

// A variable that a statement reads, by its number as the text has it.
struct VariableRead {
  std::uint32_t number = 0;
  SourceRange range; // no place: the statement is all that is known
};

// What is passed outlives it. Everything is computed when first asked for; several threads may ask.
class NcProgram {
public:
  NcProgram(const Project& looked, const ir::Program& lowered, const macrob::File& parsed)
      : project(looked), program(lowered), file(parsed) {}

  const Project& project;
  const ir::Program& program; // of at most 20000 statements
  const macrob::File& file;   // that holds it

  const ir::ProgramFlow& flow() const;
  // As distanceModes() says.
  const std::vector<std::optional<DistanceMode>>& modes() const;
  // As machiningBefore() says.
  const std::vector<std::optional<Machining>>& machining() const;
  // As Probing::states() says.
  const std::vector<std::optional<ProbeState>>& probeStates() const;
  // As eachRead() says, of the statement with this index.
  std::span<const VariableRead> reads(std::size_t statement) const;
  // Those of all statements, one after the other.
  std::span<const VariableRead> reads() const { return allReads().all; }
  // Statements that read a variable whose number is computed, ascending.
  std::span<const std::size_t> computedReads() const { return allReads().computed; }
  // Statements that are a G31, ascending.
  const std::vector<std::size_t>& skips() const;
  const IndirectWrites& writes() const;
  // As codesOfOtherGroups() says.
  const std::set<std::uint32_t>& otherCodes() const;

private:
  struct Reads {
    std::vector<VariableRead> all;
    std::vector<std::size_t> ends; // in `all`, by statement
    std::vector<std::size_t> computed;
  };
  const Reads& allReads() const;

  Lazy<ir::ProgramFlow> flow_;
  Lazy<std::vector<std::optional<DistanceMode>>> modes_;
  Lazy<std::vector<std::optional<Machining>>> machining_;
  Lazy<std::vector<std::optional<ProbeState>>> probeStates_;
  Lazy<Reads> reads_;
  Lazy<std::vector<std::size_t>> skips_;
  Lazy<IndirectWrites> writes_;
  Lazy<std::set<std::uint32_t>> otherCodes_;
};

using NcPrograms = std::vector<std::unique_ptr<const NcProgram>>;
// Those that eachProgram() visits, made once a project: rules share what is computed.
const NcPrograms& programsOf(const Project& project);

} // namespace dotek::lint
