// Plain NC text through the scanner and the machine, in small chunks; what is read must not depend on the
// buffer.
#include "frontend/nc/Scan.h"
#include "sim/machine/Machine.h"
#include "stdlib/DataFiles.h"

#include <cstdint>
#include <cstdlib>
#include <string>

// The first byte chooses control and buffer.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dotek;
  static const stdlib::DataFiles files;
  static const stdlib::Control calculator = *stdlib::Control::load(files, "fanuc-0i-md");
  static const stdlib::Control increment = *stdlib::Control::load(files, "fanuc-6m");
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  LineChunks first(text);
  frontend::nc::mayHoldMacros(first);
  first.rewind();
  LineChunks second(text, 64u + data[0]);
  frontend::nc::Scanner whole(first), parts(second);
  sim::Machine machine((data[0] & 1) != 0 ? calculator : increment);
  std::size_t printed = 0;
  sim::Trace trace([&](std::string_view piece) { printed += piece.size(); });
  machine.setTrace((data[0] & 2) != 0 ? &trace : nullptr);
  ir::NcWords one, other;
  using Result = frontend::nc::Scanner::Result;
  for (bool same = true;;) {
    const Result result = whole.next(one);
    if (same) {
      const Result again = parts.next(other);
      same = parts.error().fault != frontend::nc::ScanFault::LineTooLong;
      if (same && (again != result ||
                   (result == Result::Block && (one.present != other.present || one.line != other.line))))
        std::abort();
    }
    if (result == Result::End) break;
    if (result == Result::Block) machine.execute(one);
    if (result == Result::Error) frontend::nc::findWord(whole.lineText(), 'G');
  }
  for (const std::uint32_t number : {5001u, 5041u, 5061u, 4001u, 4009u})
    machine.read(number);
  return 0;
}
