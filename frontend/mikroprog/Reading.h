// A program read against its control: what the codes of each line are there, where lines are found by number,
// where the main program ends. What checks and rules of lint look at.
#pragma once

#include "frontend/mikroprog/Ast.h"
#include "stdlib/MikroprogControl.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::frontend::mikroprog {

inline constexpr std::uint32_t kTouchProbe = 7; // condition O: touch probe A has contact

// A G or an M of a line.
struct Code {
  const Word* word = nullptr;
  const stdlib::MikroprogFunction* function = nullptr; // nullptr: the control does not have it
};

struct Block {
  const Line* line = nullptr;
  std::vector<Code> codes; // in the order of the text

  bool does(std::string_view function) const; // one of its codes does: "jump", "probe-move"
  bool hasUnknownCode() const;
};

struct MotionState;

// What walkMotion has found, once it was asked for: many rules look at the same program.
struct MotionKept {
  std::once_flag once;
  std::shared_ptr<const std::vector<std::optional<MotionState>>> states;
};

struct Reading {
  // All three outlive the reading.
  Reading(const Program& program, const stdlib::MikroprogControl& control, const SourceMap& sources);

  const Program& program;
  const stdlib::MikroprogControl& control;
  const SourceMap& sources;
  std::vector<Block> blocks;                    // one a line, unread ones too
  std::map<std::uint64_t, std::size_t> numbers; // N to the first block that has it
  std::optional<std::size_t> end;               // the first block that ends the main program

  mutable MotionKept motion;

  std::string text(SourceRange range) const { return sources.textUtf8(range); }
};

// The profile that a program says by itself: Y or J in a block is for the mill, G17 without G18 as
// well. nullopt: it may be for either.
std::optional<std::string_view> profileOf(const Program& program);

// The value of a word where it is a whole number from 0 to 999,999,999. nullopt: there is no word, or a
// parameter or another number in it.
std::optional<std::uint32_t> wholeOf(const Word* word);

} // namespace dotek::frontend::mikroprog
