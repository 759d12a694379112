// Private to Parse*.cpp: the pieces of a block as one text, each hole one character in it.
#pragma once

#include "frontend/nc/Block.h"
#include "support/Ascii.h"

#include <string_view>

namespace dotek::frontend::nc {

class Reader {
public:
  static constexpr char kEnd = '\0';
  static constexpr char kHole = '\x01';

  explicit Reader(const std::vector<Piece>& pieces);

  std::size_t position() const { return position_; }
  // The character here; kHole for a hole, kEnd after the last one.
  char peek() const { return position_ < text_.size() ? text_[position_] : kEnd; }
  // The same at a place.
  char at(std::size_t place) const { return place < text_.size() ? text_[place] : kEnd; }
  void skip(std::size_t count = 1) { position_ += count; }
  void skipBlanks();
  bool startsWith(std::string_view text) const {
    return std::string_view(text_).substr(position_).starts_with(text);
  }
  std::string_view text(std::size_t begin, std::size_t end) const {
    return std::string_view(text_).substr(begin, end - begin);
  }
  // The hole here; peek() is kHole.
  const HolePiece& hole() const;
  // Place of the bytes from `begin` to before `end`; of a piece that stands for other text the whole piece.
  SourceRange range(std::size_t begin, std::size_t end) const;
  SourceRange here() const { return range(position_, position_ + 1); }

private:
  struct Start {
    std::size_t offset;
    const Piece* piece;
  };
  const Start& pieceAt(std::size_t offset) const;

  std::string text_;
  std::vector<Start> starts_; // of pieces that are not empty
  std::size_t position_ = 0;
};

} // namespace dotek::frontend::nc
