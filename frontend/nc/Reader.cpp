#include "frontend/nc/Reader.h"

#include <algorithm>

namespace dotek::frontend::nc {

Reader::Reader(const std::vector<Piece>& pieces) {
  for (const Piece& piece : pieces) {
    const std::size_t offset = text_.size();
    if (const auto* text = std::get_if<TextPiece>(&piece)) {
      if (text->text.empty()) continue;
      text_ += text->text;
      // The two characters that mean something here are damage in a text.
      std::replace_if(
          text_.begin() + static_cast<std::ptrdiff_t>(offset), text_.end(),
          [](char c) { return c == kHole || c == kEnd; }, '\x7f');
    } else {
      text_ += kHole;
    }
    starts_.push_back({offset, &piece});
  }
}

void Reader::skipBlanks() {
  while (peek() == ' ' || peek() == '\t')
    ++position_;
}

const Reader::Start& Reader::pieceAt(std::size_t offset) const {
  const auto after =
      std::upper_bound(starts_.begin(), starts_.end(), offset,
                       [](std::size_t wanted, const Start& start) { return wanted < start.offset; });
  return *(after - 1); // the first piece starts at 0
}

const HolePiece& Reader::hole() const {
  return std::get<HolePiece>(*pieceAt(position_).piece);
}

SourceRange Reader::range(std::size_t begin, std::size_t end) const {
  if (starts_.empty()) return {};
  const std::size_t last = text_.size();
  begin = std::min(begin, last);
  end = std::clamp(end, begin, last);
  // After the last character: the place after it.
  const bool behind = begin == last;
  const auto placeOf = [&](std::size_t from, std::size_t to) -> SourceRange {
    const Start& start = pieceAt(from);
    if (const auto* hole = std::get_if<HolePiece>(start.piece)) return hole->range;
    const auto& text = std::get<TextPiece>(*start.piece);
    if (text.range.end - text.range.begin != text.text.size()) return text.range;
    const std::size_t shift = from - start.offset;
    const std::size_t length = std::min(to - start.offset, text.text.size()) - shift;
    const auto at = text.range.begin + static_cast<std::uint32_t>(shift);
    return {text.range.file, at, at + static_cast<std::uint32_t>(length)};
  };
  if (behind) {
    SourceRange place = placeOf(last - 1, last);
    place.begin = place.end;
    return place;
  }
  if (end == begin) end = begin + 1;
  const SourceRange first = placeOf(begin, end);
  const SourceRange second = placeOf(end - 1, end);
  // Pieces of several routines are in any order in the file: then the first place says it.
  return second.file == first.file && second.begin >= first.begin ? spanning(first, second) : first;
}

} // namespace dotek::frontend::nc
