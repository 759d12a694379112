// Macros, dialogs and defaults of GibbsCAM, alone and as the folder of a cycle.
#include "bench/Constructs.h"

#include <fmt/format.h>

namespace bench {

namespace {

struct Folder {
  std::string define = "X = 12\nI = 0\nG = 55\nZ = -5\nR = 40\n";
  std::string dialog =
      "dialog \"A\", 40, 40, 420, 290\n"
      "input   90,  50,  70, 24, G, G\ninput   90,  80,  70, 24, X, X\ninput   90, 110,  70, 24, I, I\n"
      "input   90, 140,  70, 24, Z, Z\ninput   90, 170,  70, 24, R, R\n";
  std::string checks;
  std::string path = "add_custom_drill_cycle_path feed_x, X\n";
  std::string post = "probe:\nIF CycleType?('a')\n SeqC ' G65 P9023 S'OpFieldData#('G')' "
                     "X'OpFieldData#('X')' I'OpFieldData#('I') EOL\nEND\nRETURN\n";
};

Input input(const Folder& folder, std::vector<std::string> arguments) {
  return {{{"a/DefineData.txt", folder.define},
           {"a/CycleData.dlg", folder.dialog + "cancel 230, 230,  80, 28\nok     130, 230,  80, 28\n"},
           {"a/CycleData.mac",
            ":ask\ndialog \"CycleData.dlg\"\nwrong = 0\n" + folder.checks + "if wrong > 0 then goto ask\n"},
           {"a/ToolPath.mac", "get_custom_drill_cycle_data retract_plane, plane\n" + folder.path +
                                  "add_custom_drill_cycle_path feed_z, R-plane\n"},
           {"post.txt", "#1 = '####.##;0'\nFORMAT(OpFieldData#,1)\n" + folder.post}},
          std::move(arguments)};
}

} // namespace

void addGibbs(std::vector<Construct>& out) {
  const auto macro = [&](const char* what, long size, std::function<std::string(long)> text) {
    out.push_back(
        {fmt::format("Gibbs macro: {}, lint", what), size, [text = std::move(text)](long n) {
           return Input{{{"a.mac", text(n)}}, {"lint", "--select", "all", "--from", "mac", "a.mac"}};
         }});
  };
  // Some 330 bytes a piece, as macros of probing cycles have them.
  macro("ordinary text (KB)", 60, [](long n) {
    return repeated(3 * n, [](long i) {
      return fmt::format(
          "! side {0}: where the ball touches\nif dia{0} < 0.5 then message \"hole {0} is too small\"\n"
          "reach{0} = dia{0}/2 + over*1.5\nif abs(reach{0}) > 40 then [\nstep{0} = reach{0} - 3.25\n"
          "] else [\nstep{0} = 0\n]\nfor k = 1 to {1}\npos{0} = pos{0} + step{0}*cos(k*30)\nnext k\n"
          "add_custom_drill_cycle_path feed_x, X+pos{0}\nadd_custom_drill_cycle_path feed_z, R-plane\n\n",
          i, 2 + i % 5);
    });
  });
  macro("variables", 1500,
        [](long n) { return repeated(n, [](long i) { return fmt::format("v{} = v{} + 1\n", i, i / 2); }); });
  macro("variables with IF", 1000, [](long n) {
    return repeated(n, [](long i) { return fmt::format("if v{0} > 1 then v{1} = v{0} + 1\n", i / 2, i); });
  });
  macro("variables under labels", 800, [](long n) {
    return repeated(n,
                    [](long i) { return fmt::format(":l{0}\nv{0} = 1\nif v{0} > w then goto l{0}\n", i); });
  });
  macro("unset variables", 1000, [](long n) {
    return "x = 0\n" + repeated(n, [](long i) { return fmt::format("x = x + u{}\n", i); });
  });
  macro("labels", 1000, [](long n) {
    return repeated(n, [](long i) { return fmt::format(":l{0}\nif x = {0} then goto l{0}\n", i); });
  });
  macro("GOTO to one label", 2000, [](long n) { return ":a\n" + times(n, "if x = 1 then goto a\n"); });
  macro("GOTO forwards to one label", 2000,
        [](long n) { return times(n, "if x = 1 then goto a\n") + ":a\n"; });
  macro("labels of one name", 2000, [](long n) { return times(n, ":a\nx = 1\n") + "goto a\n"; });
  macro("misspelt labels", 500, [](long n) {
    return repeated(n, [](long i) { return fmt::format(":label{0}\ngoto labl{0}\n", i); });
  });
  macro("loops", 1000, [](long n) { return times(n, "for k = 1 to 3\na = a + 1\nnext k\n"); });
  macro("FOR without NEXT", 1000, [](long n) { return times(n, "for k = 1 to 3\n"); });
  macro("NEXT without FOR", 1000, [](long n) { return times(n, "next k\n"); });
  macro("IF blocks", 1000, [](long n) { return times(n, "if a > 1 then [\nb = a\n] else [\nb = 2\n]\n"); });
  macro("IF blocks unclosed", 1000, [](long n) { return times(n, "if a > 1 then [\n"); });
  macro("brackets that close nothing", 1000, [](long n) { return times(n, "]\n"); });
  macro("a long sum", 50, [](long n) { return "x = y" + times(n, "+y") + "\n"; });
  macro("long sums", 100, [](long n) { return times(n, "x = y" + times(100, "+y") + "\n"); });
  macro("a long condition", 25, [](long n) { return "if a > 1" + times(n, " and a > 1") + " then b = 1\n"; });
  macro("unclosed brackets", 1000, [](long n) { return times(n, "x = (y + (z\n"); });
  macro("unclosed texts", 1000, [](long n) { return times(n, "message \"open\n"); });
  macro("a long text", 1000, [](long n) { return "message \"" + times(n, "a") + "\"\n"; });
  macro("commands", 1000, [](long n) { return times(n, "add_custom_drill_cycle_path feed_x, X\n"); });
  macro("unknown commands", 500, [](long n) {
    return repeated(n, [](long i) { return fmt::format("add_costum_{} feed_x, X\n", i); });
  });
  macro("one unknown command", 1000, [](long n) { return times(n, "add_costum feed_x, X\n"); });
  macro("unknown parameters", 500, [](long n) {
    return repeated(n, [](long i) { return fmt::format("get_op_data op, TOOL_N{}, t\n", i); });
  });
  macro("arguments on one line", 100, [](long n) { return "foo a" + times(n, ", a") + "\n"; });
  macro("declarations", 500, [](long n) {
    return repeated(n, [](long i) { return fmt::format("global a{0}, b{0}, c{0}\n", i); });
  });
  macro("calls", 500, [](long n) { return times(n, "call \"b.mac\", 1, 2\n"); });
  macro("comments", 4000, [](long n) { return times(n, "! note\nx = 1 ! note\n"); });
  macro("blank lines", 40000, [](long n) { return "x = 1\n" + times(n, "\n"); });
  macro("suppressions", 1000, [](long n) { return times(n, "x = 1 ! dotek: ignore value-never-used\n"); });
  macro("misspelt suppressions", 500, [](long n) {
    return repeated(n, [](long i) { return fmt::format("x = 1 ! dotek: ignore value-never-use{}\n", i); });
  });
  macro("damaged lines", 1000, [](long n) { return times(n, "= = ) x [ \x80\n"); });
  macro("messages", 1000, [](long n) {
    return repeated(n, [](long i) { return fmt::format("if a = {0} then message \"number {0}\"\n", i); });
  });
  out.push_back(
      {"Gibbs macro: included files, lint", 200, [](long n) {
         Input made{{{"a.mac", repeated(n, [](long i) { return fmt::format("#include \"i{}.mac\"\n", i); })}},
                    {"lint", "--select", "all", "--from", "mac", "a.mac"}};
         for (long i = 0; i < n; ++i)
           made.files.emplace_back(fmt::format("i{}.mac", i), fmt::format("v{} = 1\n", i));
         return made;
       }});

  const auto grown = [&](const char* what, long size, std::vector<std::string> command,
                         std::function<void(Folder&, long)> change) {
    command.insert(command.begin() + 1, "a");
    out.push_back({fmt::format("Gibbs folder: {}, {}", what, command.front()), size,
                   [command, change = std::move(change)](long n) {
                     Folder whole;
                     change(whole, n);
                     return input(whole, command);
                   }});
  };
  const std::vector<std::string> lint = {"lint", "post.txt", "--select", "all"};
  const std::vector<std::string> post = {"post", "--prog", "post.txt",     "--clearance",
                                         "5",    "--host", "tool_radius=3"};
  const std::vector<std::string> convert = {"convert", "--prog", "post.txt", "--to", "fanuc", "-o", "out.nc"};
  const auto inputs = [](Folder& f, long n) {
    f.dialog += repeated(
        n, [](long i) { return fmt::format("input 90, {}, 70, 24, F{}, F{}\n", 200 + 30 * i, i, i); });
    f.define += repeated(n, [](long i) { return fmt::format("F{} = {}\n", i, i); });
  };
  const auto labels = [](Folder& f, long n) {
    f.dialog += repeated(
        n, [](long i) { return fmt::format("label 20, {}, 60, 24, \"text {}\"\n", 200 + 30 * i, i); });
  };
  const auto checks = [](Folder& f, long n) {
    f.checks =
        repeated(n, [](long i) { return fmt::format("if X = {}.5 then wrong = {}\n", 100 + i, i + 1); });
  };
  const auto messages = [](Folder& f, long n) {
    f.checks = repeated(n, [](long i) {
      return fmt::format("if X = {0}.5 then wrong = {1}\nif wrong = {1} then message \"number {1}\"\n",
                         100 + i, i + 1);
    });
  };
  const auto moves = [](Folder& f, long n) {
    f.path =
        repeated(n, [](long i) { return fmt::format("add_custom_drill_cycle_path feed_x, X+{}\n", i % 7); });
  };
  const auto sums = [](Folder& f, long n) {
    f.path = repeated(n, [](long i) { return fmt::format("v{} = X + {}\n", i, i); }) + f.path;
  };
  const auto conditions = [](Folder& f, long n) {
    f.path = repeated(n, [](long i) {
      return fmt::format("if X > {} then add_custom_drill_cycle_path feed_x, {}\n", i, i);
    });
  };
  const auto loops = [](Folder& f, long n) {
    f.path = times(n, "for k = 1 to 3\nadd_custom_drill_cycle_path feed_x, k\nnext k\n");
  };
  const auto jumps = [](Folder& f, long n) {
    f.path += repeated(n, [](long i) { return fmt::format("goto l{0}\n:l{0}\n", i); });
  };
  const auto texts = [](Folder& f, long n) {
    f.post = "probe:\nIF CycleType?('a')\n" +
             repeated(n, [](long i) { return fmt::format(" SeqC ' G65 P9770 X{}.' EOL\n", i); }) +
             "END\nRETURN\n";
  };
  const auto fields = [](Folder& f, long n) {
    f.post =
        "probe:\nIF CycleType?('a')\n" +
        times(n, " SeqC ' G65 P9023 S'OpFieldData#('G')' X'OpFieldData#('X')' I'OpFieldData#('I') EOL\n") +
        "END\nRETURN\n";
  };
  const std::vector<std::string> toCycle = {"convert", "--prog", "post.txt", "--to",
                                            "cycle",   "-o",     "out.cycle"};
  grown("places in blocks of the Prog (to cycle)", 200, toCycle, [](Folder& f, long n) {
    f.post = "probe:\nIF CycleType?('a')\n SeqC SpinOff EOL\n" +
             repeated(n, [](long i) { return fmt::format(" SeqC ' G0 X{}.' EOL\n", i); }) +
             " SeqC ' G65 P9023 S'OpFieldData#('G')' X'OpFieldData#('X')' I'OpFieldData#('I') EOL\n"
             "END\nRETURN\n";
  });
  struct Grown {
    const char* what;
    long size;
    void (*change)(Folder&, long);
  };
  for (const Grown& one : {Grown{"inputs of a dialog", 100, inputs},
                           {"labels of a dialog", 300, labels},
                           {"checks", 300, checks},
                           {"messages", 100, messages},
                           {"moves", 500, moves},
                           {"values", 500, sums},
                           {"moves under IF", 200, conditions},
                           {"loops", 200, loops},
                           {"jumps", 300, jumps},
                           {"blocks of the Prog", 300, texts},
                           {"measurements of the Prog", 100, fields}}) {
    grown(one.what, one.size, lint, one.change);
    grown(one.what, one.size, post, one.change);
    grown(one.what, one.size, convert, one.change);
  }
  out.push_back({"Gibbs folders, lint", 20, [](long n) {
                   Input made{{}, {"lint", "--select", "all", "."}};
                   for (long i = 0; i < n; ++i)
                     for (auto& [name, text] : input(Folder{}, {}).files)
                       made.files.emplace_back(fmt::format("f{}/{}", i, name), text);
                   return made;
                 }});
  out.push_back({"Gibbs folders of one Prog, lint", 20, [](long n) {
                   Input made{{}, {"lint", "--select", "all", "."}};
                   std::string routine = "probe:\n";
                   for (long i = 0; i < n; ++i) {
                     for (auto& [name, text] : input(Folder{}, {}).files)
                       if (name.front() == 'a')
                         made.files.emplace_back(fmt::format("f{}{}", i, name.substr(1)), text);
                     routine += fmt::format("IF CycleType?('f{}')\n SeqC ' G65 P9770 X1.' EOL\nEND\n", i);
                   }
                   made.files.emplace_back("post.txt", routine + "RETURN\n");
                   return made;
                 }});
}

} // namespace bench
