// Parts near the limits of what a cycle measures: of its calls, and of comparisons of its own.
#include "tests/Draws.h"
#include "tests/Process.h"

#include <doctest/doctest.h>
#include <string>

namespace dotek::tests {

namespace {

// A bore or a boss, with what the branch does with its size.
class Measured {
public:
  Measured() {
    folder_.run("mkdir eye");
    folder_.write("eye/CycleData.dlg", "dialog \"Eye\", 40, 40, 300, 200\n"
                                       "label 10, 10, 80, 24, \"BORE [mm]\"\n"
                                       "input 100, 10, 80, 24, BORE, BORE\n"
                                       "label 10, 40, 80, 24, \"DEPTH [mm]\"\n"
                                       "input 100, 40, 80, 24, DEPTH, DEPTH\n"
                                       "label 10, 70, 80, 24, \"UTOL [mm]\"\n"
                                       "input 100, 70, 80, 24, UTOL, UTOL\n"
                                       "label 10, 100, 80, 24, \"SAFE [mm]\"\n"
                                       "input 100, 100, 80, 24, SAFE, SAFE\n"
                                       "ok 10, 140, 60, 24\ncancel 100, 140, 60, 24\n");
    folder_.write("eye/CycleData.mac", "callback_returncode = 0\n"
                                       "get_proc_data callback_proc, TOOL_NUM, tool\n"
                                       "get_tool_data tool, MTOOL_RADIUS, ball\n"
                                       ":ask\n"
                                       "dialog \"CycleData.dlg\"\n"
                                       "if BORE > 2*ball+4 then goto wide\n"
                                       "message \"The bore is too small\"\n"
                                       "goto ask\n"
                                       ":wide\n"
                                       "if UTOL > 0.02 then goto fine\n"
                                       "message \"The tolerance is too small\"\n"
                                       "goto ask\n"
                                       ":fine\n"
                                       "if UTOL < 0.2 then goto safe\n"
                                       "message \"The tolerance is too large\"\n"
                                       "goto ask\n"
                                       ":safe\n"
                                       "if SAFE > DEPTH+20 then goto done\n"
                                       "message \"SAFE is too low\"\n"
                                       "goto ask\n"
                                       ":done\n"
                                       "callback_returncode = 0\n");
    folder_.write("eye/DefineData.txt", "BORE = 32\nDEPTH = -6\nUTOL = 0.05\nSAFE = 40\n");
    folder_.write("eye/ToolPath.mac", "op = callback_op\n"
                                      "get_custom_drill_cycle_data x, atx\n"
                                      "get_custom_drill_cycle_data y, aty\n"
                                      "get_custom_drill_cycle_data retract_plane, plane\n"
                                      "get_op_data op, TOOL_NUM, tool\n"
                                      "get_tool_data tool, MTOOL_RADIUS, ball\n"
                                      "add_custom_drill_cycle_path feed_z, DEPTH-plane\n"
                                      "add_custom_drill_cycle_path feed_x, BORE/2-ball\n"
                                      "add_custom_drill_cycle_path feed_x, 0\n"
                                      "add_custom_drill_cycle_path feed_x, -BORE/2+ball\n"
                                      "add_custom_drill_cycle_path feed_x, 0\n"
                                      "add_custom_drill_cycle_path feed_y, BORE/2-ball\n"
                                      "add_custom_drill_cycle_path feed_y, 0\n"
                                      "add_custom_drill_cycle_path feed_y, -BORE/2+ball\n"
                                      "add_custom_drill_cycle_path feed_y, 0\n"
                                      "add_custom_drill_cycle_path feed_z, SAFE-plane\n");
  }

  // Writes the post whose branch goes on so after the probe is at the depth.
  void post(const std::string& name, const std::string& blocks) {
    folder_.write(name, "#1 = '#####.###;0.'\nFORMAT(OpFieldData#,1)\n\nprobe:\nIF CycleType?('eye')\n"
                        " SeqC SpinOff EOL\n SeqC CoolOff EOL\n SeqC ' G90 G94' EOL\n SeqC ' G65 P9832' EOL\n"
                        " SeqC ' G65 P9810' ZCP1 ' F2500.' EOL\n"
                        " SeqC ' G65 P9810 Z'OpFieldData#('DEPTH')' F1500.' EOL\n" +
                            blocks +
                            " SeqC ' G65 P9810 Z'OpFieldData#('SAFE')' F2500.' EOL\n"
                            " SeqC ' G65 P9833' EOL\nEND\nRETURN\n");
  }
  // Of `source` against what is written of `other`.
  std::string verdict(const std::string& source, const std::string& other, const std::string& to,
                      const std::string& written) {
    const std::string cycle = "dotek convert eye --form thesis-a --to " + to + " --prog ";
    const ShellResult made = folder_.run(cycle + other + " -d out");
    REQUIRE_MESSAGE(made.status == 0, made.out << made.err);
    const ShellResult found = folder_.run("dotek verify eye --form thesis-a --to " + to + " --prog " +
                                          source + " --allow-edits --translation out/" + written +
                                          " --jobs 1 --cases " + std::to_string(draws(10U, 8U)));
    folder_.run("rm -r out");
    return found.out + found.err;
  }

private:
  ProcessFolder folder_;
};

std::string limit(const std::string& relation, const std::string& tolerance) {
  return " SeqC ' G65 P9814 D'OpFieldData#('BORE') EOL\n"
         " SeqC ' IF [#138 " +
         relation + " [' OpFieldData#('BORE')'+" + tolerance +
         "]] GOTO 520' EOL\n SeqC ' #550=#138' EOL\n SeqC ' GOTO 530' EOL\n"
         " 'N520 #3000=70(OUT OF LIMITS)' EOL\n 'N530 G90' EOL\n";
}

const std::string kOnce = "'OpFieldData#('UTOL')'", kTwice = "2.*'OpFieldData#('UTOL')'";

} // namespace

TEST_CASE("verify: a limit of what is measured that is another one differs") {
  Measured cycle;
  cycle.post("once.txt", limit("GT", kOnce));
  cycle.post("twice.txt", limit("GT", kTwice));
  const std::string fanuc = "fanuc --control fanuc-31i-b";
  const std::string sound = cycle.verdict("once.txt", "once.txt", fanuc, "O8000.nc");
  CHECK_MESSAGE(sound.starts_with("AGREES"), sound);
  const std::string damaged = cycle.verdict("once.txt", "twice.txt", fanuc, "O8000.nc");
  CHECK_MESSAGE(damaged.starts_with("DIFFERS"), damaged);
  CHECK_MESSAGE(damaged.find("farther along its touch") != std::string::npos, damaged);
}

TEST_CASE("verify: where both sides count in eight digits, a limit that is met exactly tells GE from GT") {
  Measured cycle;
  cycle.post("above.txt", limit("GT", kOnce));
  cycle.post("from.txt", limit("GE", kOnce));
  const std::string fanuc = "fanuc --control fanuc-0i-md";
  const std::string sound = cycle.verdict("from.txt", "from.txt", fanuc, "O8000.nc");
  CHECK_MESSAGE(sound.starts_with("AGREES"), sound);
  const std::string damaged = cycle.verdict("above.txt", "from.txt", fanuc, "O8000.nc");
  CHECK_MESSAGE(damaged.starts_with("DIFFERS"), damaged);
}

TEST_CASE("verify to cycle: the size tolerance of a bore is met") {
  Measured cycle;
  const std::string bore = " SeqC ' G65 P9814 D'OpFieldData#('BORE')";
  cycle.post("with.txt", bore + "' H'OpFieldData#('UTOL') EOL\n");
  cycle.post("twice.txt", bore + "' H[2.*'OpFieldData#('UTOL')']' EOL\n");
  cycle.post("without.txt", bore + " EOL\n");
  const std::string sound = cycle.verdict("with.txt", "with.txt", "cycle", "eye.cycle");
  CHECK_MESSAGE(sound.starts_with("AGREES"), sound);
  const std::string without = cycle.verdict("with.txt", "without.txt", "cycle", "eye.cycle");
  CHECK_MESSAGE(without.starts_with("DIFFERS"), without);
  const std::string twice = cycle.verdict("with.txt", "twice.txt", "cycle", "eye.cycle");
  CHECK_MESSAGE(twice.starts_with("DIFFERS"), twice);
}

} // namespace dotek::tests
