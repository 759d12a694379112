// What convert writes for other targets, and verify reading it back.
#include "bench/Constructs.h"

#include <fmt/format.h>

namespace bench {

namespace {

struct Cycle {
  std::string moves = "add_custom_drill_cycle_path feed_x, X\n";
  std::string defines, inputs, checks;
  std::string blocks =
      " SeqC ' G65 P9023 S'OpFieldData#('G')' X'OpFieldData#('X')' I'OpFieldData#('I') EOL\n";
};

Input files(const Cycle& cycle, std::vector<std::string> arguments) {
  return {{{"a/DefineData.txt", "X = 12\nI = 0\nG = 55\n" + cycle.defines},
           {"a/CycleData.dlg",
            "dialog \"A\", 40, 40, 420, 290\ninput 90, 50, 70, 24, G, G\ninput 90, 80, 70, 24, X, X\ninput "
            "90, 110, 70, 24, I, I\n" +
                cycle.inputs + "cancel 230, 230, 80, 28\nok 130, 230, 80, 28\n"},
           {"a/CycleData.mac", ":ask\ndialog \"CycleData.dlg\"\nwrong = 0\nif G < 54 then wrong = 1\nif G > "
                               "59 then wrong = 1\nif abs(X) < 4 then wrong = 2\n" +
                                   cycle.checks + "if wrong > 0 then goto ask\n"},
           {"a/ToolPath.mac", cycle.moves},
           {"post.txt", "#1 = '####.##;0'\nFORMAT(OpFieldData#,1)\nprobe:\nIF CycleType?('a')\n SeqC SpinOff "
                        "EOL\n SeqC CoolOff EOL\n" +
                            cycle.blocks + "END\nRETURN\n"}},
          std::move(arguments)};
}

} // namespace

void addTargets(std::vector<Construct>& out) {
  const std::vector<std::string> source = {"a", "--prog", "post.txt", "--assume", "probe-on"};
  struct Target {
    const char* name;
    std::vector<std::string> more;
    bool fewArguments = false; // a call hands over 21 values
  };
  const std::vector<Target> targets = {
      {"fanuc", {"--control", "fanuc-0i-md"}, true},
      {"fusion", {}},
      {"mikroprog",
       {"--control", "mikroprog-mill", "--clearance", "5", "--host", "tool_radius=3", "--host",
        "overtravel=5", "--host", "return_feed=1000", "--host", "start_x=-15", "--host", "start_y=10"}}};
  struct Grown {
    const char* what;
    long size;
    void (*change)(Cycle&, long);
  };
  const auto checks = [](Cycle& c, long n) {
    c.checks =
        repeated(n, [](long i) { return fmt::format("if I = {}.5 then wrong = {}\n", 100 + i, i + 3); });
  };
  const auto moves = [](Cycle& c, long n) {
    c.blocks = repeated(n, [](long i) { return fmt::format(" SeqC ' G65 P9770 X{}. F500' EOL\n", i % 5); }) +
               c.blocks;
  };
  const auto comments = [](Cycle& c, long n) {
    c.blocks += repeated(n, [](long i) { return fmt::format(" SeqC ' (NOTE {})' EOL\n", i); });
  };
  const auto measures = [](Cycle& c, long n) { c.blocks = times(n, c.blocks); };
  const auto fields = [](Cycle& c, long n) {
    c.defines = repeated(n, [](long i) { return fmt::format("V{0} = {0}\n", i); });
  };
  const auto inputs = [](Cycle& c, long n) {
    c.defines = repeated(n, [](long i) { return fmt::format("V{0} = {0}\n", i); });
    c.inputs = repeated(
        n, [](long i) { return fmt::format("input 90, {}, 70, 24, V{}, V{}\n", 140 + 30 * i, i, i); });
  };
  const auto used = [](Cycle& c, long n) {
    c.defines = repeated(n, [](long i) { return fmt::format("V{0} = {0}\n", i); });
    c.inputs = repeated(
        n, [](long i) { return fmt::format("input 90, {}, 70, 24, V{}, V{}\n", 140 + 30 * i, i, i); });
    c.checks = repeated(n, [](long i) { return fmt::format("if V{} > {} then wrong = 3\n", i, 900 - i); });
  };
  for (const Target& target : targets) {
    for (const Grown& grown : {Grown{"checks", 110, checks},
                               {"fields that nothing reads", 40, fields},
                               {"inputs that nothing reads", 40, inputs},
                               {"inputs that a check reads each", 20, used},
                               {"protected moves", 20, moves},
                               {"comments", 50, comments},
                               {"measurements", 10, measures}}) {
      if (grown.change == +used && target.fewArguments) continue;
      for (const bool verify : {false, true}) {
        std::vector<std::string> arguments = {verify ? "verify" : "convert"};
        arguments.insert(arguments.end(), source.begin(), source.end());
        arguments.insert(arguments.end(), {"--to", target.name});
        arguments.insert(arguments.end(), target.more.begin(), target.more.end());
        if (verify) arguments.insert(arguments.end(), {"--cases", "20", "--jobs", "1"});
        out.push_back({fmt::format("{} to {}: {}", arguments.front(), target.name, grown.what), grown.size,
                       [arguments, change = grown.change](long n) {
                         Cycle cycle;
                         change(cycle, n);
                         return files(cycle, arguments);
                       }});
      }
    }
  }
}

} // namespace bench
