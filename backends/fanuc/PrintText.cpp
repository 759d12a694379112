#include "backends/fanuc/PrintText.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::backends::fanuc {

std::string portText(const ir::Port& port) {
  return port.open ? "POPEN" : "PCLOS";
}

std::string printText(const ir::Print& print) {
  std::string out = print.binary ? "BPRNT[" : "DPRNT[";
  for (const ir::PrintPiece& piece : print.pieces) {
    if (!piece.number) {
      std::string text = piece.text;
      std::replace(text.begin(), text.end(), ' ', '*');
      out += text;
    } else if (print.binary) {
      out += fmt::format("#{}[{}]", *piece.number, piece.decimals);
    } else {
      out += fmt::format("#{}[{}{}]", *piece.number, piece.integerDigits, piece.decimals);
    }
  }
  return out + "]";
}

} // namespace dotek::backends::fanuc
