#include "sim/machine/BlockList.h"

#include "ir/Match.h"

#include <fmt/format.h>
#include <utility>

namespace dotek::sim {

BlockList::BlockList(ir::Program program, const SourceMap& sources)
    : program_(std::make_shared<const ir::Program>(std::move(program))) {
  const auto& body = program_->body;
  for (std::size_t at = 0; at < body.size();) {
    ListedBlock now;
    now.line = sources.line(body[at].origin.range());
    bool empty = true; // but for a comment
    const std::uint32_t block = body[at].origin.block;
    do {
      ir::match(
          body[at], [&](const ir::Comment& comment) { now.text = comment.text; },
          [&](const ir::Label& label) {
            now.number = program_->labels[label.label].number;
            empty = false;
          },
          [&](const ir::Store& store) {
            now.store = &store;
            empty = false;
          },
          [&](const ir::NcBlock& words) {
            now.words = words.words;
            empty = false;
            for (const ir::Word& word : words.words)
              if (const auto* name = std::get_if<ir::Constant>(&word.value->node);
                  word.address == '@' && name != nullptr)
                now.file = name->digits;
          },
          [&](const ir::OneOf<ir::Jump, ir::Branch, ir::Move, ir::Measure, ir::ProbePower, ir::JumpTo,
                              ir::Loop, ir::LoopEnd, ir::Call, ir::Exit, ir::Raise, ir::Notice, ir::Port,
                              ir::Print, ir::NameVariables> auto&) {
            empty = false;
            if (refused.empty()) refused = fmt::format("line {} is no plain block", now.line);
          });
      ++at;
    } while (at < body.size() && body[at].origin.block == block);
    if (empty) continue;
    if (now.number) numbers.emplace(*now.number, blocks.size());
    blocks.push_back(std::move(now));
  }
}

} // namespace dotek::sim
