#include "frontend/mikroprog/Reading.h"

#include <algorithm>
#include <cmath>

namespace dotek::frontend::mikroprog {

bool Block::does(std::string_view function) const {
  return std::any_of(codes.begin(), codes.end(), [&](const Code& code) {
    return code.function != nullptr && code.function->function == function;
  });
}

bool Block::hasUnknownCode() const {
  return std::any_of(codes.begin(), codes.end(), [](const Code& code) { return code.function == nullptr; });
}

std::optional<std::uint32_t> wholeOf(const Word* word) {
  if (word == nullptr || !word->value.number) return std::nullopt;
  const double number = *word->value.number;
  if (number < 0 || number >= 1e9 || number != std::floor(number)) return std::nullopt;
  return static_cast<std::uint32_t>(number);
}

std::optional<std::string_view> profileOf(const Program& program) {
  bool mill = false, xy = false, xz = false; // planes
  for (const Line& line : program.lines) {
    mill = mill || line.find('Y') != nullptr || line.find('J') != nullptr;
    for (const Word& word : line.words) {
      xy = xy || (word.address == 'G' && word.value.number == 17.0);
      xz = xz || (word.address == 'G' && word.value.number == 18.0);
    }
  }
  return mill || (xy && !xz) ? std::optional(stdlib::kMikroprogMill) : std::nullopt;
}

Reading::Reading(const Program& program_, const stdlib::MikroprogControl& control_, const SourceMap& sources_)
    : program(program_), control(control_), sources(sources_) {
  blocks.reserve(program.lines.size());
  for (std::size_t i = 0; i < program.lines.size(); ++i) {
    const Line& line = program.lines[i];
    Block block{&line, {}};
    for (const Word& word : line.words) {
      if (word.address != 'G' && word.address != 'M') continue;
      const auto number = wholeOf(&word);
      block.codes.push_back({&word, number ? control.find(word.address, *number) : nullptr});
    }
    if (line.number) numbers.emplace(*line.number, i);
    if (!end && block.does("end")) end = i;
    blocks.push_back(std::move(block));
  }
}

} // namespace dotek::frontend::mikroprog
