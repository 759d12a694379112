// Sources of posts.
#include "bench/Constructs.h"

#include <fmt/format.h>

namespace bench {

void addComPost(std::vector<Construct>& out) {
  const auto linted = [&](const char* what, long size, std::function<std::string(long)> text) {
    out.push_back(
        {fmt::format("Prog: {}, lint", what), size, [text = std::move(text)](long n) {
           return Input{{{"post.txt", text(n)}}, {"lint", "--select", "all", "--from", "prog", "post.txt"}};
         }});
  };
  const auto body = [](const std::string& text) {
    return "probe:\nIF CycleType?('a')\n" + text + "END\nRETURN\n";
  };
  linted("routines", 1000, [](long n) {
    return repeated(n, [](long i) { return fmt::format("routine{}:\nSeqC ' G0 X1.' EOL\nRETURN\n", i); });
  });
  // Some 330 bytes a piece, as posts have them.
  linted("ordinary text (KB)", 60, [](long n) {
    return repeated(3 * n, [](long i) {
      return fmt::format(
          "! cycle {0}\nprobe{0}:\nIF CycleType?('c{0}')\n SeqC ' (SIDE {0})' EOL\n SeqC ' G65 P9770 "
          "Z'OpFieldData#('Z')' "
          "F3000' EOL\n IF Flag?('F{0}')\n  SeqC ' G65 P9023 S'OpFieldData#('G')' X'OpFieldData#('X{0}')' "
          "I'OpFieldData#('I') EOL\n"
          " ELSE\n  SeqC ' G65 P9019 D'OpFieldData#('D') EOL\n END\n SeqC ' M5' EOL\nEND\nRETURN\n\n",
          i);
    });
  });
  linted("routines that call the next", 1000, [](long n) {
    return repeated(n, [](long i) {
      return fmt::format("routine{}:\nroutine{}\nSeqC ' G0 X1.' EOL\nRETURN\n", i, i + 1);
    });
  });
  linted("routines that call one", 1000, [](long n) {
    return "last:\nSeqC ' M5' EOL\nRETURN\n" +
           repeated(n, [](long i) { return fmt::format("routine{}:\nlast last\nRETURN\n", i); });
  });
  linted("calls of itself", 1000, [](long n) { return "same:\n" + times(n, "same\n") + "RETURN\n"; });
  linted("words in a routine that calls itself", 1000,
         [](long n) { return "same:\n" + times(n, "SeqC ' X1.' EOL\nsame\n") + "RETURN\n"; });
  linted("routines of one name", 1000,
         [](long n) { return times(n, "same:\nSeqC ' G0 X1.' EOL\nRETURN\n"); });
  linted("routines misspelt", 500, [](long n) {
    return repeated(n, [](long i) { return fmt::format("routine{}:\nroutin{}\nRETURN\n", i, i); });
  });
  linted("unclosed routines", 1000, [](long n) {
    return repeated(n, [](long i) { return fmt::format("routine{}:\nSeqC ' G0' EOL\n", i); });
  });
  linted("branches", 500, [](long n) {
    return "probe:\n" +
           repeated(n,
                    [](long i) {
                      return fmt::format(
                          "IF CycleType?('c{}')\nSeqC ' G65 P9770 Z'OpFieldData#('Z') EOL\nEND\n", i);
                    }) +
           "RETURN\n";
  });
  linted("branches for one cycle", 500, [](long n) {
    return "probe:\n" + times(n, "IF CycleType?('c')\nSeqC ' G65 P9770 Z'OpFieldData#('Z') EOL\nEND\n") +
           "RETURN\n";
  });
  linted("blocks of a branch", 1000, [&](long n) {
    return body(repeated(n, [](long i) { return fmt::format("SeqC ' G1 X{}.' EOL\n", i); }));
  });
  linted("equal blocks of a branch", 1000, [&](long n) { return body(times(n, "SeqC ' G1 X1.' EOL\n")); });
  linted("fields", 500, [&](long n) {
    return body(repeated(n, [](long i) { return fmt::format("SeqC ' X'OpFieldData#('F{}') EOL\n", i); }));
  });
  linted("flags", 500, [&](long n) {
    return body(
        repeated(n, [](long i) { return fmt::format("IF Flag?('F{}')\nSeqC ' X1.' EOL\nEND\n", i); }));
  });
  linted("words on one line", 100, [&](long n) { return body(times(n, "SeqC ' X1.' ") + "EOL\n"); });
  linted("lines without EOL", 1000, [&](long n) { return body(times(n, "SeqC ' X1.'\n")); });
  linted("conditions joined", 50, [](long n) {
    return "probe:\nIF RigidTap?" + times(n, " AND RigidTap?") + "\nSeqC ' X1.' EOL\nEND\nRETURN\n";
  });
  linted("IF without END", 1000, [](long n) { return "probe:\n" + times(n, "IF RigidTap?\n") + "RETURN\n"; });
  linted("END without IF", 1000, [](long n) { return "probe:\n" + times(n, "END\n") + "RETURN\n"; });
  linted("ELSE without IF", 1000, [](long n) { return "probe:\n" + times(n, "ELSE\n") + "RETURN\n"; });
  linted("unknown words", 500,
         [&](long n) { return body(repeated(n, [](long i) { return fmt::format("SpinOf{} EOL\n", i); })); });
  linted("one unknown word", 1000, [&](long n) { return body(times(n, "SpinOf EOL\n")); });
  linted("pictures", 500,
         [](long n) { return repeated(n, [](long i) { return fmt::format("#{} = '###.##;0'\n", i + 1); }); });
  linted("one picture again", 500, [](long n) { return times(n, "#1 = '###.##;0'\n"); });
  linted("formats", 500, [](long n) { return "#1 = '##.##'\n" + times(n, "FORMAT(OpFieldData#,1)\n"); });
  linted("comments", 4000,
         [](long n) { return "probe:\n" + times(n, "{ note }\n") + "SeqC ' M5' EOL\nRETURN\n"; });
  linted("a long comment", 20000,
         [](long n) { return "{ " + times(n, "word\n") + "}\nprobe:\nSeqC ' M5' EOL\nRETURN\n"; });
  linted("unclosed comments", 2000,
         [](long n) { return "probe:\nSeqC ' M5' EOL\nRETURN\n" + times(n, "{ note\n"); });
  linted("branches of equal blocks", 100, [](long n) {
    const std::string blocks = repeated(n, [](long i) { return fmt::format("SeqC ' G1 X{}.' EOL\n", i); });
    return "probe:\nIF CycleType?('a')\n" + blocks + "END\nIF CycleType?('b')\n" + blocks +
           "END\nIF CycleType?('c')\n" + blocks + "END\nRETURN\n";
  });
  linted("routines that tell cycles apart", 100, [](long n) {
    return repeated(n, [](long i) {
      return fmt::format("r{0}:\nIF CycleType?('a')\nSeqC ' M5' EOL\nEND\nIF CycleType?('b')\nSeqC ' M6' "
                         "EOL\nEND\nIF CycleType?('c{0}')\nSeqC ' M6' EOL\nEND\nRETURN\n",
                         i);
    });
  });
  linted("unclosed comment and words", 4000,
         [](long n) { return "probe:\n{ note\n" + times(n, "SeqC ' M5' EOL\n") + "RETURN\n"; });
  linted("unclosed literals", 1000, [&](long n) { return body(times(n, "SeqC ' M5 EOL\n")); });
  linted("unclosed brackets", 1000, [&](long n) { return body(times(n, "SeqC OpFieldData#('Z' EOL\n")); });
  linted("stray words", 1000, [](long n) { return times(n, "SeqC ' M5' EOL\n"); });
  linted("stray signs", 1000, [](long n) { return "probe:\n" + times(n, "= , )\n") + "RETURN\n"; });
  linted("suppressions", 1000, [&](long n) {
    return body(times(n, "SeqC ' M5' EOL { dotek: ignore literal-duplicates-command }\n"));
  });
  linted("misspelt suppressions", 500, [&](long n) {
    return body(repeated(n, [](long i) {
      return fmt::format("SeqC ' M5' EOL {{ dotek: ignore literal-duplicate{} }}\n", i);
    }));
  });
  linted("macro calls", 500, [&](long n) {
    return body(times(n, "SeqC ' G65 P9770 Z'OpFieldData#('Z')' F500' EOL\nSeqC ' G65 P9023 "
                         "S'OpFieldData#('G')' X'OpFieldData#('X') EOL\n"));
  });
}

} // namespace bench
