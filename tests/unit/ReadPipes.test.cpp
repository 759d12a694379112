// What lies in a folder under a name that Dotek reads and is no regular file: nobody named it, so nobody
// waits for it, and it is not passed over in silence where something depends on it.
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"
#include "tests/Process.h"
#include "tests/Skips.h"

#include <doctest/doctest.h>
#include <string_view>
#include <vector>

using namespace dotek::tests;

namespace {

constexpr const char* kProgram = "%\nO1\nG90 G0 X1.\nM30\n%\n";

} // namespace

TEST_CASE("pipes: one with the name of a cycle's file makes a folder of programs no cycle") {
  const ProcessFolder folder;
  folder.write("mill/a.nc", "%\nO1\nM30\n%\n");
  folder.run("mkfifo mill/CycleData.mac");
  const ShellResult result = folder.run("dotek lint mill");
  CHECK(result.status == 0);
  CHECK_MESSAGE(result.err == "1 file checked, 1 skipped (CycleData.mac: no regular file)\n", result.err);
}

TEST_CASE("a pipe in a folder of cycles or of data files is no file") {
  const ProcessFolder folder;
  folder.write("good/spare.cycle", "cycle spare \"Spare\"\nspindle off\n");
  folder.write("p.nc", kProgram);
  folder.run("mkfifo good/grows.cycle; mkdir -p data/forms data/controls; mkfifo data/forms/x.toml; "
             "ln -s /dev/zero data/controls/y.toml");
  for (const char* command : {"doc good", "list forms --data data", "lint p.nc --data data",
                              "fmt good/grows.cycle good", "new form shop --prog p.nc --data data"}) {
    if (std::string_view(command).starts_with("fmt"))
      folder.run("rm good/grows.cycle; mkdir good/grows.cycle");
    const ShellResult result = folder.run(std::string("dotek ") + command);
    CHECK_MESSAGE(result.status == 2, std::string(command) << result.err);
    CHECK_MESSAGE((result.out + result.err).find("[file-not-readable]") != std::string::npos,
                  command << result.err);
  }
}

TEST_CASE("settings that cannot be read are an error of each command") {
  const ProcessFolder folder;
  folder.write("p.nc", kProgram);
  folder.write("spare.cycle", "cycle spare \"Spare\"\nspindle off\n");
  folder.write("post.txt", "progStart:\n SeqC SpinOff EOL\nRETURN\n");
  folder.run("cp -r '" + root().string() + "/examples/surface-x' x");
  for (const char* make : {"mkfifo dotek.toml", "ln -s /dev/zero dotek.toml", "ln -s dotek.toml dotek.toml",
                           "ln -s nowhere dotek.toml", "mkdir dotek.toml", "echo '[lint' > dotek.toml",
                           "echo 'schema = 1\nno-such-key = 1' > dotek.toml"}) {
    const std::string_view how = make;
    if (fewDraws() && !how.starts_with("mkfifo") && !how.starts_with("echo '[lint'")) continue;
    folder.run(std::string("rm -rf dotek.toml; ") + make);
    for (const char* command : {"lint p.nc",
                                "lint .",
                                "sim p.nc",
                                "sim --json p.nc",
                                "convert p.nc --to fanuc",
                                "verify p.nc --to fanuc",
                                "dump p.nc",
                                "lint post.txt",
                                "sim spare.cycle",
                                "convert spare.cycle --to fanuc",
                                "check spare.cycle",
                                "fmt spare.cycle",
                                "doc spare.cycle",
                                "doc",
                                "verify spare.cycle --to fanuc",
                                "preview x",
                                "post x --prog post.txt --clearance 5",
                                "convert x --prog post.txt --to fanuc",
                                "list forms",
                                "new form shop --prog post.txt",
                                "new control shop --from fanuc-31i-b"}) {
      const ShellResult result = folder.run(std::string("dotek ") + command);
      CHECK_MESSAGE(result.status > 0, std::string(make) << ": " << std::string(command) << result.err);
      CHECK_MESSAGE(result.status <= 2, std::string(make) << ": " << std::string(command) << result.status);
      CHECK_MESSAGE((result.out + result.err).find("dotek.toml") != std::string::npos,
                    std::string(make) << ": " << std::string(command) << "\n"
                                      << result.out << result.err);
    }
  }
}

TEST_CASE("a pipe that a file names, or a folder holds, is refused and nobody waits for it") {
  const ProcessFolder folder;
  const std::string root = "'" + dotek::tests::root().string() + "/examples/";
  folder.write("p.nc", kProgram);
  folder.write("caller.nc", "%\nO1\nM98 P9\nM30\n%\n");
  folder.write("st/dotek.toml", "schema = 1\nprog = \"pf\"\n");
  folder.write("post.cps", "include(\"lib.js\");\n");
  folder.run(
      "cp -r " + root + "surface-x' st/sx; cp -r " + root +
      "surface-x' sy; rm sy/ToolPath.mac; mkfifo st/pf sy/ToolPath.mac lib.js pipe; mkdir programs; mkfifo "
      "programs/O9.nc");
  for (const char* command : {"lint st/sx", "convert st/sx --to fanuc", "post st/sx",
                              "verify st/sx --to fanuc", "dump st/sx --stage ir", "dump sy", "lint sy",
                              "new job --from post.cps", "run-post post.cps --matrix probing",
                              "sim caller.nc --programs programs", "flatten caller.nc --programs programs"}) {
    const ShellResult result = folder.run(std::string("timeout 20 \"$DOTEK\" ") + command);
    CHECK_MESSAGE(result.status > 0, command);
    CHECK_MESSAGE(result.status < 3, std::string(command) << result.status);
    CHECK_MESSAGE((result.out + result.err).find("no regular file") != std::string::npos,
                  std::string(command) << "\n"
                                       << result.out << result.err);
  }
  // Nothing can be changed in place there, and nobody waits for a reader.
  for (const char* command : {"renumber --all pipe", "fmt --write pipe", "renumber p.nc pipe"}) {
    const ShellResult result = folder.run(std::string("timeout 20 \"$DOTEK\" ") + command);
    CHECK_MESSAGE(result.status == 2, std::string(command) << result.err);
    CHECK_MESSAGE(result.err.find("`pipe` cannot be written: it is no regular file") != std::string::npos,
                  result.err);
  }
  CHECK(folder.run("timeout 20 \"$DOTEK\" renumber - < p.nc").status == 0);
}

TEST_CASE("a link that leads out is refused with the folder that it leads to") {
  const ProcessFolder folder;
  folder.write("out/part.stl", "solid\nendsolid\n");
  folder.write("in/part.toml",
               "schema = 1\n[[shape]]\nkind = \"mesh\"\nfile = \"part.stl\"\nunit = \"mm\"\n");
  folder.write("p.nc", kProgram);
  folder.run("ln -s ../out/part.stl in/part.stl");
  const ShellResult result =
      folder.run("dotek sim p.nc --part in/part.toml --include in --tool 1 --length 50 --diameter 6");
  CHECK(result.status > 0);
  CHECK_MESSAGE(result.err.find("is not in `in/`, and is not read; allow its folder by `--include out`") !=
                    std::string::npos,
                result.err);
}

TEST_CASE("a file that is an input and included by another one is opened once") {
  const ProcessFolder folder;
  if (folder.run("strace -V && strace -o /dev/null true").status != 0) return skip("there is no strace");
  const std::string root = "'" + dotek::tests::root().string() + "/examples/";
  folder.run("cp -r " + root + "surface-x' tw");
  folder.write("tw/t.mac", "add_custom_drill_cycle_path feed_x, 77\n");
  folder.run("printf '#include \"t.mac\"\\n' >> tw/ToolPath.mac");
  const ShellResult result =
      folder.run("strace -f -e trace=open,openat -o trace \"$DOTEK\" lint tw; grep -c 't\\.mac' trace");
  CHECK_MESSAGE(result.out.ends_with("1\n"), result.out << result.err);
}
