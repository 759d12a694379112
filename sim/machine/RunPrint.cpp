// POPEN, PCLOS, DPRNT, BPRNT.
#include "sim/machine/Run.h"
#include "sim/machine/Value.h"
#include "support/Decimal.h"

#include <cmath>
#include <fmt/format.h>

namespace dotek::sim {

bool Run::openPort(bool open) {
  if (open == portOpen_)
    return refuse(open ? "POPEN while the port is open" : "PCLOS while the port is not open");
  portOpen_ = open;
  if (listener_ != nullptr) listener_->portSwitched(open);
  return true;
}

bool Run::print(const ir::Print& print) {
  if (!portOpen_) return refuse("printing without POPEN before it");
  std::string line;
  for (const ir::PrintPiece& piece : print.pieces) {
    if (!piece.number) {
      line += piece.text;
      continue;
    }
    if (ahead_) noteRead(*piece.number);
    const std::optional<double> value = machine_.read(*piece.number);
    if (!value) return false;
    if (!unset_.empty() && *piece.number > control_.locals && isFresh(machine_.common(*piece.number)))
      noteUnset(*piece.number);
    if (listener_ != nullptr) tellRead(*piece.number, *value);
    // A variable without a value prints as 0.
    if (!(print.binary ? printBinary(piece, nullAsZero(*value), line)
                       : printDecimal(piece, nullAsZero(*value), line)))
      return false;
  }
  if (Trace* const trace = machine_.trace(); trace != nullptr) {
    if (print.binary) {
      std::string hex;
      for (const char c : line)
        hex += fmt::format("{:02x}", static_cast<unsigned char>(c));
      trace->begin("print-binary").text(hex).end();
    } else {
      trace->begin("print").text(line).end();
    }
  }
  if (listener_ != nullptr) listener_->printed(print.binary, line);
  output_ += line;
  output_ += '\n';
  if (output_.size() > limits_.outputBytes)
    return machine_.overLimit(fmt::format(
        "the program printed more than {} bytes; `--limit output-bytes=N` allows more", limits_.outputBytes));
  return true;
}

// Whole part, point, decimals. A whole part that is longer than its digits is printed all the same.
bool Run::printDecimal(const ir::PrintPiece& piece, double value, std::string& out) {
  const std::string text = fixedText(value, static_cast<int>(piece.decimals));
  const std::size_t sign = text.starts_with('-') ? 1 : 0;
  const std::size_t point = std::min(text.find('.'), text.size());
  const std::size_t digits = point - sign;
  if (digits < piece.integerDigits) {
    if (!control_.printPadding) return refuse("whether DPRNT pads with blanks is not known of this control");
    if (*control_.printPadding) out.append(piece.integerDigits - digits, ' ');
  }
  out += text;
  return true;
}

// 32 bits, the highest first, of the value with `decimals` after the point.
bool Run::printBinary(const ir::PrintPiece& piece, double value, std::string& out) {
  const double scaled = std::round(value * std::pow(10.0, piece.decimals));
  if (!(scaled >= -2147483648.0 && scaled <= 2147483647.0))
    return refuse("the value does not fit the 32 bits of BPRNT");
  const auto bits = static_cast<std::uint32_t>(static_cast<std::int32_t>(scaled));
  for (int shift = 24; shift >= 0; shift -= 8)
    out += static_cast<char>(bits >> shift & 0xFF);
  return true;
}

} // namespace dotek::sim
