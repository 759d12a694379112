// Programs of Mikroprog.
#include "bench/Constructs.h"

#include <fmt/format.h>

namespace bench {

void addMikroprog(std::vector<Construct>& out) {
  const auto add = [&](const char* what, long size, std::vector<std::string> command,
                       std::function<std::string(long)> text) {
    out.push_back({fmt::format("Mikroprog: {}, {}", what, command.front()), size,
                   [text = std::move(text), command](long n) {
                     auto whole = command;
                     whole.push_back("A.SUF");
                     return Input{{{"A.SUF", text(n)}}, whole};
                   }});
  };
  const std::vector<std::string> lint = {"lint", "--select", "all", "--from", "suf"};
  const std::vector<std::string> sim = {"sim", "--quiet", "--control", "mikroprog-mill"};
  const auto linted = [&](const char* what, long size, std::function<std::string(long)> text) {
    add(what, size, lint, std::move(text));
  };
  const auto moves = [](long n) {
    return "N1 G17 G90 G94\nN2 G1 X0 F100\n" +
           repeated(n, [](long i) { return fmt::format("N{} G1 X{}\n", i + 3, i % 100); }) + "N999999 M30\n";
  };
  linted("blocks", 3000, moves);
  add("blocks", 3000, sim, moves);
  add("blocks", 3000, {"dump", "--stage", "ir"}, moves);
  // Some 250 bytes a piece.
  linted("ordinary text (KB)", 60, [](long n) {
    return "N1 G17 G90 G94\n" +
           repeated(
               4 * n,
               [](long i) {
                 return fmt::format(
                     "N{0} G0 X{4}.125 Y-{5}.5 ;TO SIDE {6}\nN{1} G1 Z-{5}.25 F250\nN{2} P1={4}.5\nN{3} G1 "
                     "X{5}.5 Y{4}.375 F500\n"
                     "N{3}1 G1 XP1 Y0\nN{3}2 X{4}.5\nN{3}3 G0 Z50 ;UP\nN{3}4 G4 H1\nN{3}5 X0 Y0\nN{3}6 M5\n",
                     10 * i + 2, 10 * i + 3, 10 * i + 4, 10 * i + 5, i % 90, 1 + i % 30, i);
               }) +
           "N99999999 M30\n";
  });
  linted("blocks without numbers", 3000, [](long n) { return times(n, "G1 X1 Z1\n"); });
  linted("words on one line", 2000, [](long n) { return "N1 G1" + times(n, " X1") + "\n"; });
  linted("words without blanks", 5000, [](long n) { return "N1 G1" + times(n, "X1") + "\n"; });
  linted("different words on one line", 2000,
         [](long n) { return "N1 G1" + times(n, " X1 Z1 F1 M5 G0") + "\n"; });
  linted("unreadable words on one line", 2000, [](long n) { return "N1 G1" + times(n, " X1..") + "\n"; });
  linted("unknown codes", 2000,
         [](long n) { return repeated(n, [](long i) { return fmt::format("N{} G{}\n", i + 1, 500 + i); }); });
  linted("parameters", 2000, [](long n) {
    return repeated(n, [](long i) { return fmt::format("N{} P{}={}\n", i + 1, i % 100, i); });
  });
  linted("parameters not set", 2000, [](long n) {
    return repeated(n, [](long i) { return fmt::format("N{} G1 X1 FP{}\n", i + 1, i % 100); });
  });
  linted("jumps to the next", 1000, [](long n) {
    return repeated(n, [](long i) { return fmt::format("N{} G26 L{}\n", i + 1, i + 2); }) + "N999999 M30\n";
  });
  linted("jumps to one block", 1000, [](long n) {
    return "N1 G4 H1\n" + repeated(n, [](long i) { return fmt::format("N{} G23 L1 O7\n", i + 2); }) +
           "N999999 M30\n";
  });
  linted("jumps nowhere", 1000, [](long n) {
    return repeated(n, [](long i) { return fmt::format("N{} G26 L{}\n", i + 1, 500000 + i); }) +
           "N999999 M30\n";
  });
  linted("blocks of one number", 2000, [](long n) { return times(n, "N1 G1 X1\n"); });
  linted("jumps between blocks of one number", 2000, [](long n) { return times(n, "N1 G26 L1\n"); });
  linted("probing", 500, [](long n) {
    return repeated(n,
                    [](long i) {
                      return fmt::format("N{} G31 X1 L{}\nN{} G26 L{}\n", 2 * i + 1, 2 * i + 3, 2 * i + 2,
                                         900000);
                    }) +
           "N900000 M0\nN999999 M30\n";
  });
  linted("subprograms", 500, [](long n) {
    return repeated(n, [](long i) { return fmt::format("N{} G27 L{}\n", i + 1, 100001 + 2 * i); }) +
           "N99999 M30\n" + repeated(n, [](long i) {
             return fmt::format("N{} G4 H1\nN{} M17\n", 100001 + 2 * i, 100002 + 2 * i);
           });
  });
  linted("calls within calls", 500, [](long n) {
    return "N1 G26 L100001\nN2 M30\n" + repeated(n, [](long i) {
             return fmt::format("N{} G26 L{}\nN{} M17\n", 100001 + 2 * i, 100003 + 2 * i, 100002 + 2 * i);
           });
  });
  linted("jumps out of subprograms", 500, [](long n) {
    return repeated(n, [](long i) { return fmt::format("N{} G26 L{}\n", i + 1, 100001 + 2 * i); }) +
           "N99999 M30\n" + repeated(n, [](long i) {
             return fmt::format("N{} G27 L{}\nN{} M17\n", 100001 + 2 * i, i + 1, 100002 + 2 * i);
           });
  });
  linted("comments", 3000, [](long n) { return times(n, ";note\n"); });
  linted("a long comment", 20000, [](long n) { return ";" + times(n, "note ") + "\n"; });
  linted("texts", 2000,
         [](long n) { return repeated(n, [](long i) { return fmt::format("N{} M0 ;TEXT\n", i + 1); }); });
  linted("files", 1000, [](long n) {
    return repeated(n, [](long i) { return fmt::format("N{} M25 @F{}.SOU\n", i + 1, i); });
  });
  linted("arcs", 1000, [](long n) {
    return "N1 G90\n" + repeated(n, [](long i) { return fmt::format("N{} G2 X{} Z1 R5\n", i + 2, i % 9); });
  });
  linted("suppressions", 1000, [](long n) {
    return repeated(n,
                    [](long i) { return fmt::format("N{} G999 ;dotek: ignore suf-unknown-code\n", i + 1); });
  });
  linted("misspelt suppressions", 500, [](long n) {
    return repeated(
        n, [](long i) { return fmt::format("N{} G999 ;dotek: ignore suf-unknown-cod{}\n", i + 1, i); });
  });
  linted("damaged lines", 2000, [](long n) { return times(n, "N1 ?? = \x80 X\n"); });
  linted("fields of the operator", 1000, [](long n) {
    return repeated(n, [](long i) { return fmt::format("N{} M42 H{}\n", i + 1, i % 300); });
  });
}

} // namespace bench
