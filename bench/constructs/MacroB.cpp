// Programs of macro B.
#include "bench/Constructs.h"

#include <fmt/format.h>

namespace bench {

namespace {

using Line = std::function<std::string(long)>;

Input nc(std::string text, std::vector<std::string> command) {
  command.push_back("a.nc");
  return {{{"a.nc", std::move(text)}}, std::move(command)};
}

std::string program(const std::string& blocks) {
  return "%\nO1\n" + blocks + "M30\n%\n";
}

const std::vector<std::string> kLint = {"lint", "--select", "all", "--from", "nc"};
const std::vector<std::string> kSim = {"sim", "--quiet"};
const std::vector<std::string> kConvert = {
    "convert", "--to", "fanuc", "--control", "fanuc-31i-b", "--from-control", "fanuc-31i-b", "-o", "out.nc"};
// Numbers and codes are looked up on both.
const std::vector<std::string> kAcross = {
    "convert", "--to", "fanuc", "--control", "fanuc-31i-b", "--from-control", "fanuc-0i-md", "-o", "out.nc"};

} // namespace

void addMacroB(std::vector<Construct>& out) {
  const auto linted = [&](const char* what, long size, std::function<std::string(long)> text) {
    const std::pair<const char*, const std::vector<std::string>*> commands[] = {
        {"lint", &kLint}, {"sim", &kSim}, {"convert to another control", &kAcross}};
    for (const auto& [verb, command] : commands)
      out.push_back({fmt::format("macro B: {}, {}", what, verb), size,
                     [text, command = command](long n) { return nc(text(n), *command); }});
  };
  const auto blocks = [&](const char* what, long size, Line line) {
    linted(what, size, [line = std::move(line)](long n) { return program(repeated(n, line)); });
  };
  const auto both = [&](const char* what, long size, std::function<std::string(long)> text,
                        const std::vector<std::string>& command, const char* verb) {
    out.push_back({fmt::format("macro B: {}, {}", what, verb), size,
                   [text = std::move(text), command](long n) { return nc(text(n), command); }});
  };
  const auto programs = [](long n) { return ordinaryMacros(static_cast<std::size_t>(n) * 1000); };
  const auto onePlain = [](long n) { return ordinaryProgram(static_cast<std::size_t>(n) * 1000); };
  linted("ordinary programs (KB)", 60, programs);
  linted("one ordinary program (KB)", 60, onePlain);
  both("one ordinary program (KB)", 60, onePlain, kConvert, "convert");
  both("one ordinary program (KB)", 60, onePlain, {"dump", "--stage", "ir"}, "dump");
  both("ordinary programs (KB)", 60, programs, {"dump", "--stage", "ast"}, "dump");
  both("ordinary programs (KB)", 60, programs, {"dump", "--stage", "tokens"}, "dump tokens");
  both("ordinary programs (KB)", 60, programs, kConvert, "convert");

  linted("short programs", 400, [](long n) {
    return "%\n" + repeated(n, [](long i) { return fmt::format("O{}\nG0 X1.\nM99\n", i + 1); }) + "%\n";
  });
  linted("a program that calls the others", 400, [](long n) {
    return "%\nO9000\n" + repeated(n, [](long i) { return fmt::format("G65 P{}\n", i + 1); }) + "M99\n" +
           repeated(n, [](long i) { return fmt::format("O{}\nG0 X1.\nM99\n", i + 1); }) + "%\n";
  });
  blocks("computed numbers of variables", 500,
         [](long i) { return fmt::format("#[{0}]=#[#[{0}]]\n", 500 + i % 400); });
  blocks("copies of positions asked for again", 500, [](long i) {
    return fmt::format("#{0}=#5061\nIF[#{0} EQ #{1}]GOTO 9\n", 100 + i % 50, 500 + i % 500);
  });
  linted("variables after a watched move", 400, [](long n) {
    return program(
        "G90 G31 X-10. F100\nIF[#5061 GT -9.9]GOTO 9\n" +
        repeated(n, [](long i) { return fmt::format("#{}=#{}+1.\n", 100000 + i, 100000 + i / 2); }) +
        "M99\nN9 #3000=1(HIT)\n");
  });
  blocks("variables", 2000, [](long i) { return fmt::format("#{}=#{}+1.\n", 100000 + i, 100000 + i / 2); });
  blocks("variables with IF", 1000,
         [](long i) { return fmt::format("IF[#{0} GT 1.]THEN #{1}=#{0}+1.\n", 100000 + i / 2, 100000 + i); });
  linted("variables in many programs", 1000, [](long n) {
    return "%\n" +
           repeated(n,
                    [](long i) { return fmt::format("O{}\n#{}=#{}+1.\nM99\n", 1 + i, 500 + i, 501 + i); }) +
           "%\n";
  });
  blocks("variables under labels", 800,
         [](long i) { return fmt::format("N{0} #{1}=#1\nIF[#{1} GT #2]GOTO {0}\n", 1 + i, 100000 + i); });
  blocks("labels", 4000, [](long i) { return fmt::format("N{0} G0 X{0}.\n", i + 1); });
  blocks("GOTO backwards and forwards", 2000, [](long i) {
    return fmt::format("N{0} IF[#1 EQ {0}.]GOTO {1}\n", i + 1, i % 2 == 0 ? i + 2 : std::max(1L, i - 1));
  });
  linted("GOTO to one number", 4000,
         [](long n) { return program("N1 G4 X1.\n" + times(n, "IF[#1 EQ 2.]GOTO 1\n")); });
  linted("GOTO forwards to one number", 4000,
         [](long n) { return program(times(n, "IF[#1 EQ 2.]GOTO 1\n") + "N1 G4 X1.\n"); });
  linted("GOTO to one number after each block", 20000,
         [](long n) { return program("N1 G4 X1.\n" + times(n, "GOTO 1\n")); });
  linted("GOTO nowhere", 4000, [](long n) {
    return program(repeated(n, [](long i) { return fmt::format("IF[#1 EQ 2.]GOTO {}\n", i + 1); }));
  });
  linted("GOTO between blocks of one number", 4000, [](long n) { return program(times(n, "N1 GOTO 1\n")); });
  linted("one number on each block", 4000,
         [](long n) { return program(times(n, "N1 G0 X1.\n") + "GOTO 1\n"); });
  linted("computed GOTO", 1000, [](long n) {
    return program(repeated(n, [](long i) { return fmt::format("N{0} GOTO #{1}\n", i + 1, 100 + i % 50); }));
  });
  blocks("loops", 1000, [](long i) {
    return fmt::format("#{0}=0\nWHILE[#{0} LT 5.]DO1\n#{0}=#{0}+1\nEND1\n", 100 + i % 50);
  });
  linted("DO without END", 4000, [](long n) { return program(times(n, "WHILE[#1 LT 5.]DO1\n")); });
  linted("END without DO", 4000, [](long n) { return program(times(n, "END1\n")); });
  linted("a jump into each loop", 1000, [](long n) {
    return program(repeated(
        n, [](long i) { return fmt::format("GOTO {0}\nWHILE[#1 LT 5.]DO1\nN{0} #1=#1+1\nEND1\n", i + 1); }));
  });
  // The other line is deeper than the scanner reads: the grammar makes its tables for it at every size.
  linted("a long sum", 50,
         [](long n) { return program("#1=#2" + times(150, "+#3") + "\n#1=#2" + times(n, "+#3") + "\n"); });
  linted("long sums", 100, [](long n) { return program(times(n, "#1=#2" + times(100, "+#3") + "\n")); });
  linted("brackets after one another", 50,
         [](long n) { return program("#1=#2" + times(n, "+[#3*#4]") + "\n"); });
  linted("unclosed brackets on lines", 2000, [](long n) { return program(times(n, "#1=[#2+[#3*#4\n")); });
  linted("unclosed brackets on one line", 1000, [](long n) { return program("#1=" + times(n, "[") + "\n"); });
  linted("closing brackets on one line", 1000, [](long n) { return program("#1=" + times(n, "]") + "\n"); });
  linted("words on one line", 1000, [](long n) { return program("G1" + times(n, " X1.") + "\n"); });
  linted("words of variables on one line", 1000,
         [](long n) { return program("G1" + times(n, " X#1") + "\n"); });
  linted("one long number", 1000, [](long n) { return program("G1 X" + times(n, "12") + ".\n"); });
  // A line has at most 262,144 bytes.
  linted("a long comment", 9000, [](long n) { return program("(" + times(n, "AB ") + ")\n"); });
  linted("comments", 4000, [](long n) { return program(times(n, "(NOTE) G4 X1. (NOTE)\n")); });
  linted("comments on one line", 4000, [](long n) { return program(times(n, "(NOTE)") + "\n"); });
  linted("unclosed comments", 4000, [](long n) { return program(times(n, "G0 X1. (NOTE\n")); });
  // Up to the limit of a line's length, and above it.
  linted("unclosed comments on one line", 2000, [](long n) { return program(times(n, "(") + "\n"); });
  linted("unclosed comments on a line too long", 20000, [](long n) { return program(times(n, "(") + "\n"); });
  linted("comments over lines", 2000, [](long n) { return program(times(n, "(ONE\nTWO)\n")); });
  linted("lines of text", 2000, [](long n) { return program(times(n, "cutter on the left side\n")); });
  linted("misprints", 2000, [](long n) { return program(times(n, "GO X5,5 YO.\n")); });
  linted("misprints on one line", 1000, [](long n) { return program(times(n, "XO.") + "\n"); });
  linted("misprinted loops", 2000, [](long n) { return program(times(n, "D01\nEND1\n")); });
  linted("blocks over lines", 2000, [](long n) { return program(times(n, "G1 X[#1*\n*#2]\n")); });
  linted("blank lines", 40000, [](long n) { return program(times(n, "\n")); });
  linted("semicolons", 20000, [](long n) { return program(times(n, ";") + "\n"); });
  linted("per cent signs", 4000, [](long n) { return times(n, "%\nO1\nM30\n"); });
  linted("text before the start", 20000, [](long n) { return times(n, "no program yet\n") + program(""); });
  linted("text after the end", 8000, [](long n) { return program("") + times(n, "G0 X1.\n"); });
  linted("programs", 2000, [](long n) {
    return "%\n" + repeated(n, [](long i) { return fmt::format("O{}\nG0 X1.\nM99\n", i + 1); }) + "%\n";
  });
  linted("programs of one number", 2000,
         [](long n) { return "%\n" + times(n, "O7\nG0 X1.\nM99\n") + "%\n"; });
  linted("programs that call one", 2000, [](long n) {
    return "%\nO9000\nM99\n" +
           repeated(n, [](long i) { return fmt::format("O{}\nG65 P9000 X1.\nM99\n", i + 1); }) + "%\n";
  });
  linted("programs of one number that call themselves", 1000,
         [](long n) { return "%\n" + times(n, "O7\nG65 P7 X1.\nM98 P7\nM99\n") + "%\n"; });
  linted("programs that call the next", 1000, [](long n) {
    return "%\n" +
           repeated(
               n,
               [](long i) { return fmt::format("O{}\nG65 P{} X#24\nM98 P{}\nM99\n", i + 1, i + 2, i + 2); }) +
           "%\n";
  });
  blocks("suppressions", 2000,
         [](long i) { return fmt::format("N{} GOTO {} (DOTEK: IGNORE JUMP-TO-ITSELF)\n", i + 1, i + 1); });
  blocks("misspelt suppressions", 500,
         [](long i) { return fmt::format("G0 X1. (DOTEK: IGNORE JUMP-TO-ITSELF{})\n", i); });
  linted("one misspelling suppressed", 2000,
         [](long n) { return program(times(n, "G0 X1. (DOTEK: IGNORE JUMPTO-ITSELF)\n")); });
  linted("codes of one suppression", 150, [](long n) {
    return program("G0 X1. (DOTEK: IGNORE" + repeated(n, [](long i) { return fmt::format(" CODE-{},", i); }) +
                   ")\n");
  });
  linted("regions of suppression", 1000, [](long n) {
    return program(
        times(n, "(DOTEK: IGNORE-START JUMP-TO-ITSELF)\nN1 GOTO 1\n(DOTEK: IGNORE-END JUMP-TO-ITSELF)\n"));
  });
  linted("regions within regions", 1000, [](long n) {
    return program(times(n, "(DOTEK: IGNORE-START JUMP-TO-ITSELF)\n") + times(n, "N1 GOTO 1\n"));
  });
  linted("findings", 4000, [](long n) { return program(times(n, "G1 X1. X2. M3.0\n")); });
  linted("alarms", 2000, [](long n) {
    return program(repeated(
        n, [](long i) { return fmt::format("IF[#1 EQ {0}.]THEN #3000={1}(TEXT {0})\n", i, 1 + i % 99); }));
  });
  linted("printing", 2000,
         [](long n) { return program("POPEN\n" + times(n, "DPRNT[X#1[53]*Y#2[53]]\n") + "PCLOS\n"); });
  linted("macro calls", 2000,
         [](long n) { return program(times(n, "G65 P9810 X1. F500.\nG65 P9811 X10. S1.\n")); });
  linted("skip moves", 2000, [](long n) { return program(times(n, "G31 X1. F100.\n#100=#5061\nG0 X0.\n")); });
  linted("damaged bytes", 8000, [](long n) { return program(times(n, "G0 X\x80\xff?\n")); });
  both(
      "names of a listing", 2000, [](long n) { return program(times(n, "#1=*130+54.\nA #1 = DIA\n")); },
      {"lint", "--from", "listing"}, "lint as listing");
  both(
      "blocks", 40000,
      [](long n) {
        return program(repeated(n, [](long i) { return fmt::format("G1 X{}. Y2.5 F100.\n", i % 900); }));
      },
      kSim, "sim");
  both(
      "macro blocks", 4000,
      [](long n) {
        return program(repeated(
            n, [](long i) { return fmt::format("#{}=#{}+1.\n", 100 + i % 50, 100 + (i + 1) % 50); }));
      },
      kSim, "sim");
  both(
      "GOTO to the next block", 4000,
      [](long n) {
        return program(repeated(n, [](long i) { return fmt::format("GOTO {0}\nN{0}\n", i + 1); }));
      },
      kSim, "sim");
  both(
      "GOTO to a block near the end", 4000,
      [](long n) {
        return program("#1=0\nN1 #1=#1+1\nIF[#1 LT 300.]GOTO 2\nGOTO 3\n" + times(n, "G4 X0\n") +
                       "N2 GOTO 1\nN3\n");
      },
      kSim, "sim");
  both(
      "programs called in turn", 1000,
      [](long n) {
        return "%\nO9999\n" + repeated(n, [](long i) { return fmt::format("M98 P{}\n", i + 1); }) + "M30\n" +
               repeated(n, [](long i) { return fmt::format("O{}\n#100=#100+1\nM99\n", i + 1); }) + "%\n";
      },
      kSim, "sim");
  both(
      "blocks", 4000,
      [](long n) {
        return program("G21 G90 G54\n" +
                       repeated(n, [](long i) { return fmt::format("G1 X{}. Y2.5 F100.\n", i % 900); }));
      },
      {"sim", "--quiet", "--html", "out.html", "--svg", "out.svg"}, "sim with pictures");
  both(
      "blocks", 4000,
      [](long n) {
        return program("G21 G90 G54\n" +
                       repeated(n, [](long i) { return fmt::format("G1 X{}. Y2.5 F100.\n", i % 900); }));
      },
      {"sim", "--json"}, "sim with JSON");
  both(
      "blocks", 2000,
      [](long n) {
        return program("G21 G90 G54\n" +
                       repeated(n, [](long i) { return fmt::format("G1 X{}. Y2.5 F100.\n", i % 900); }));
      },
      kConvert, "convert");
  both(
      "variables", 1000,
      [](long n) {
        return program(repeated(
            n, [](long i) { return fmt::format("#{}=#{}+1.\n", 500 + i % 500, 500 + i / 2 % 500); }));
      },
      kConvert, "convert");
  both(
      "labels and jumps", 1000,
      [](long n) {
        return program(
            repeated(n, [](long i) { return fmt::format("N{0} IF[#1 EQ {0}.]GOTO {0}\n", i + 1); }));
      },
      kConvert, "convert");
  both(
      "programs that call the next", 500,
      [](long n) {
        return "%\n" +
               repeated(n, [](long i) { return fmt::format("O{}\nG65 P{} X#24\nM99\n", i + 1, i + 2); }) +
               "%\n";
      },
      kConvert, "convert");
  both(
      "labels and jumps", 1000,
      [](long n) {
        return program(
            repeated(n, [](long i) { return fmt::format("N{0} IF[#1 EQ {0}.]GOTO {0}\n", i + 1); }));
      },
      {"dump", "--stage", "ir"}, "dump");
  both(
      "loops", 1000, [](long n) { return program(times(n, "WHILE[#1 LT 5.]DO1\n#1=#1+1\nEND1\n")); },
      {"dump", "--stage", "ir"}, "dump");
  both(
      "repairs", 500,
      [](long n) {
        return program(times(n, "(DOTEK: IGNORE-START JUMP-TO-ITSELF)\n") + times(n, "N10G1X5.\n"));
      },
      {"lint", "--fix"}, "lint with repairs");
}

} // namespace bench
