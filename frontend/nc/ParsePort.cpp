// POPEN, PCLOS, DPRNT and BPRNT in the block of a post.
#include "frontend/nc/BlockParser.h"

namespace dotek::frontend::nc {
namespace {

constexpr std::size_t kMostDigits = 8;

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

// The last piece as text, a new one where it is none.
std::string& textOf(ir::Print& print) {
  if (print.pieces.empty() || print.pieces.back().number) print.pieces.emplace_back();
  return print.pieces.back().text;
}

} // namespace

bool BlockParser::port(Block& block, std::string_view word) {
  const std::size_t begin = in_.position();
  take(word);
  PortStatement out{ir::Port{word == "POPEN"}, {}};
  if (word == "DPRNT" || word == "BPRNT") {
    ir::Print print{word == "BPRNT", {}};
    if (!printed(print, begin)) return false;
    out.node = std::move(print);
  }
  out.range = in_.range(begin, in_.position());
  block.port = std::move(out);
  return true;
}

bool BlockParser::printed(ir::Print& print, std::size_t begin) {
  in_.skipBlanks();
  if (in_.peek() != '[') return syntax(in_.here(), "what is printed is in brackets, `DPRNT[X#100[53]]`");
  in_.skip();
  while (in_.peek() != ']') {
    const char c = in_.peek();
    if (c == Reader::kEnd)
      return syntax(in_.range(begin, in_.position()),
                    "the bracket of what is printed is not closed; write `]`");
    if (c == Reader::kHole)
      return syntax(
          in_.here(),
          "the post writes {} into what the control prints; store it in a variable before (`#600=..`), and "
          "print that (`#600[53]`)",
          in_.hole().hole.name);
    if (c == '#') {
      if (!printedVariable(print)) return false;
      continue;
    }
    textOf(print) += c == '*' ? ' ' : c;
    in_.skip();
  }
  in_.skip();
  return true;
}

bool BlockParser::printedVariable(ir::Print& print) {
  const std::size_t begin = in_.position();
  const auto digits = [&] {
    const std::size_t first = in_.position();
    while (isDigit(in_.peek()))
      in_.skip();
    return std::string(in_.text(first, in_.position()));
  };
  in_.skip();
  const std::string number = digits();
  const bool open = in_.peek() == '[';
  if (open) in_.skip();
  const std::string format = open ? digits() : "";
  const std::size_t wanted = print.binary ? 1 : 2;
  if (number.empty() || number.size() > kMostDigits || format.size() != wanted || in_.peek() != ']') {
    const SourceRange here = in_.range(begin, in_.position());
    if (print.binary) return syntax(here, "BPRNT takes a variable with one digit in brackets, `#100[3]`");
    return syntax(
        here, "DPRNT takes a variable with two digits in brackets, before and after the point: `#100[53]`");
  }
  in_.skip();
  const auto digit = [&](std::size_t i) { return static_cast<std::uint32_t>(format[i] - '0'); };
  print.pieces.push_back({"", static_cast<std::uint32_t>(std::stoul(number)), print.binary ? 0 : digit(0),
                          digit(format.size() - 1)});
  return true;
}

} // namespace dotek::frontend::nc
