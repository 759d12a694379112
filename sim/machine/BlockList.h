// A program of plain blocks by its numbers: what a machine without a macro language goes through.
#pragma once

#include "ir/Program.h"
#include "support/Source.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace dotek::sim {

struct ListedBlock {
  std::optional<std::uint64_t> number; // N
  const ir::Store* store = nullptr;    // an assignment; nullptr: none
  std::span<const ir::Word> words;     // in the order of the text, that of '@' too
  std::string file;                    // after '@'; "": none
  std::string text;                    // of its comment, UTF-8; "": none
  std::uint32_t line = 0;              // of the text, from 1
};

// Blocks of nothing but a comment are left out. Copies share the program.
struct BlockList {
  BlockList(ir::Program program, const SourceMap& sources);

  std::vector<ListedBlock> blocks;
  std::map<std::uint64_t, std::size_t> numbers; // N to the first block that has it
  std::string refused;                          // which line holds more than a plain block; "": none

private:
  std::shared_ptr<const ir::Program> program_;
};

} // namespace dotek::sim
