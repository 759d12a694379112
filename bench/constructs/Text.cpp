#include "bench/Constructs.h"

#include <fmt/format.h>

namespace bench {

std::string times(long n, std::string_view text) {
  std::string out;
  out.reserve(static_cast<std::size_t>(n) * text.size());
  for (long i = 0; i < n; ++i)
    out += text;
  return out;
}

namespace {

// Bodies of subprograms; {0} counts them and makes numbers differ, {1} and the following are common
// variables, {5} on are labels.
std::string surfaceBody(long i, long a, long b, long label) {
  return fmt::format("IF[#24 NE #0]GOTO {2}\n"
                     "#3000={3}(X MISSING)\n"
                     "N{2} #{0}=#5041 (START)\n"
                     "#{1}=#520/2\n"
                     "IF[#9 EQ #0]THEN #9=60.\n"
                     "G91 G31 X[#24-{4}.5] F#9\n"
                     "G90\n"
                     "#{0}=#5061-#{0}\n"
                     "IF[ABS[#{0}] LT #{1}]GOTO {5}\n"
                     "G0 X#5041 (BACK TO THE START)\n"
                     "#{1}=#{0}+[#24-#5061]*{4}\n"
                     "GOTO {6}\n"
                     "N{5} #3000={3}(NO CONTACT)\n"
                     "N{6} M99\n",
                     a, b, label, 101 + i % 90, 1 + i % 9, label + 1, label + 2);
}

std::string loopBody(long i, long a, long b, long label) {
  return fmt::format("#{0}=0 (COUNTER)\n"
                     "#{1}=0\n"
                     "WHILE[#{0} LT {3}]DO 1\n"
                     "G1 X[{4}.*COS[#{0}*30.]] Y[{4}.*SIN[#{0}*30.]] F500.\n"
                     "G31 Z-{5}.25 F100.\n"
                     "IF[#5063 LE -{5}.]GOTO {2}\n"
                     "#{1}=#{1}+#5063\n"
                     "G0 Z10.\n"
                     "#{0}=#{0}+1\n"
                     "END 1\n"
                     "#{1}=#{1}/{3}.\n"
                     "N{2} G0 Z50. (UP)\n"
                     "M99\n",
                     a, b, label, 3 + i % 8, 5 + i % 40, 2 + i % 7);
}

std::string callBody(long i, long a, long b, long label) {
  return fmt::format("G90 G54 G17\n"
                     "T{3} M6\n"
                     "G43 H{3} Z100. (LENGTH)\n"
                     "S{4} M3\n"
                     "G0 X{5}.125 Y-{5}.5\n"
                     "G1 Z-{6}.2 F250.\n"
                     "X{4}. Y{5}.375\n"
                     "G2 X{5}. Y{6}.5 I10. J-2.5\n"
                     "G65 P{7} X{5}. F60.\n"
                     "#{0}=[#{1}+{5}.25]*2.\n"
                     "IF[#{0} GT #{1}]THEN #{1}=#{0}\n"
                     "IF[#{1} NE {4}.]GOTO {2}\n"
                     "G0 Z100.\n"
                     "N{2} M5\n"
                     "G91 G28 Z0.\n"
                     "G90\n"
                     "M99\n",
                     a, b, label, 1 + i % 20, 500 + i % 3000, 1 + i % 60, 1 + i % 9, 1000 + i);
}

std::string body(long i, long a, long b, long label) {
  switch (i % 3) {
  case 0: return surfaceBody(i, a, b, label);
  case 1: return loopBody(i, a, b, label);
  default: return callBody(i, a, b, label);
  }
}

} // namespace

std::string ordinaryMacros(std::size_t bytes) {
  std::string out = "%\n";
  for (long i = 0; out.size() < bytes; ++i)
    out += fmt::format("O{} (CYCLE {}, SECTION {})\n", 1000 + i, i, i % 17) +
           body(i, 100 + i % 50, 500 + i % 400, 10 + i % 900);
  return out + "%\n";
}

std::string ordinaryProgram(std::size_t bytes) {
  std::string out = "%\nO1000 (ONE LONG PROGRAM)\n";
  for (long i = 0; out.size() < bytes; ++i) {
    std::string part = body(i, 100 + i % 50, 500 + i % 400, 10 + 3 * i);
    const std::size_t end = part.rfind("M99");
    part.replace(end, 3, "G4 X1.");
    out += part;
  }
  return out + "M30\n%\n";
}

} // namespace bench
