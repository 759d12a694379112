// One program of an NC file as rules look at it, with what several of them ask of it.
#pragma once

#include "lint/Machining.h"
#include "lint/Skips.h"

#include <optional>
#include <vector>

namespace dotek::lint {

// A variable that a statement reads, by its number as the text has it.
struct VariableRead {
  std::uint32_t number = 0;
  SourceRange range; // no place: the statement is all that is known
};

// What is passed outlives it; one thread uses it. Everything is computed when first asked for.
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
  // As eachRead() says, of the statement with this index.
  std::span<const VariableRead> reads(std::size_t statement) const;

private:
  struct Reads {
    std::vector<VariableRead> all;
    std::vector<std::size_t> ends; // in `all`, by statement
  };
  mutable std::optional<ir::ProgramFlow> flow_;
  mutable std::optional<std::vector<std::optional<DistanceMode>>> modes_;
  mutable std::optional<std::vector<std::optional<Machining>>> machining_;
  mutable std::optional<Reads> reads_;
};

} // namespace dotek::lint
