// Outputs that are inputs or one another are refused before anything is done; an input that is given twice is
// one.
#include "tests/GoldenRunner.h"
#include "tests/Process.h"

#include <doctest/doctest.h>

using namespace dotek::tests;

namespace {

constexpr const char* kProgram = "%\nO1\nG90 G0 X1.\nM30\n%\n";

} // namespace

TEST_CASE("two results of one command are two files") {
  const ProcessFolder folder;
  folder.write("p.nc", kProgram);
  folder.run("mkdir d; ln -s d e; ln -s new soft; echo old > hard1; ln hard1 hard2; mkfifo pipe");
  const std::string before = folder.names();
  const std::string convert = "dotek convert p.nc --to fanuc ";
  for (const std::string& command :
       {convert + "-o f --map f", convert + "-o f --map ./f", convert + "-o d/f --map e/f",
        convert + "-o new --map soft", convert + "-o hard1 --map hard2", convert + "--map -",
        convert + "-o - --map -", convert + "-o - --map /dev/stdout", convert + "-o pipe --map pipe",
        convert + "-o f 2> f", std::string("dotek sim p.nc --svg f --html f"),
        std::string("dotek sim p.nc --trace f --html f"),
        std::string("dotek sim p.nc --trace f --svg d/../f"), std::string("dotek sim p.nc --svg -"),
        std::string("dotek sim p.nc --json --trace -"), std::string("dotek sim p.nc --json --trace f > f")}) {
    const ShellResult result = folder.run(command + "; s=$?; cat f >&2 2> /dev/null; rm -f f; exit $s");
    CHECK_MESSAGE(result.status == 2, command << "\n" << result.err);
    // `--json` prints its object in every case.
    const bool json = command.find("--json --trace -") != std::string::npos;
    CHECK_MESSAGE(
        (json ? result.out.find("\"output-given-twice\"") != std::string::npos : result.out.empty()),
        command << "\n"
                << result.out);
    CHECK_MESSAGE(result.err.find("would write the same file; name another one [output-given-twice]") !=
                      std::string::npos,
                  command << "\n"
                          << result.err);
    CHECK_MESSAGE(folder.names() == before, command);
    CHECK(folder.read("hard1") == "old\n");
  }
  const ShellResult together =
      folder.run(convert + "> f 2>&1; echo $?; " + convert + "-o d/f --map d/m; echo $?; " +
                 "dotek sim p.nc --quiet --svg - > g; echo $?; " +
                 "dotek sim p.nc --svg /dev/null --html /dev/null > h; echo $?; "
                 "cmp d/f f");
  CHECK(together.out == "0\n0\n0\n0\n");
}

TEST_CASE("a result whose name only the command knows is another file than its other results") {
  const ProcessFolder folder;
  const std::string root = "'" + dotek::tests::root().string() + "/examples/";
  folder.run("cp -r " + root + "surface-x' .; cp " + root + "post.txt' .; mkdir out; ln -s out o2");
  folder.write("index.cycle", "cycle index \"Index\"\nspindle off\n");
  folder.write("a/twin.cycle", "cycle twin \"One\"\nspindle off\n");
  folder.write("b/twin.cycle", "cycle twin \"Other\"\nspindle off\n");
  const std::string convert = "convert surface-x --prog post.txt --form thesis-a -d out ";
  for (const std::string& command :
       {convert + "--to fanuc --map out/O8000.nc", convert + "--to fanuc --map o2/./O8000.nc",
        convert + "--to fanuc --assume probe-on --verify --report out/O8000.nc",
        convert + "--to fusion --helpers out/surfaceX.js", std::string("doc index.cycle -o out"),
        std::string("doc a/twin.cycle b/twin.cycle -o out")}) {
    const ShellResult result = folder.run("dotek " + command);
    CHECK_MESSAGE(result.status == 2, command << "\n" << result.err);
    CHECK_MESSAGE(result.err.find("would write the same file; name another one [output-given-twice]") !=
                      std::string::npos,
                  command << "\n"
                          << result.err);
    CHECK_MESSAGE(folder.run("ls -A out; rm -f out/*").out.empty(), command);
  }
  CHECK(folder.run("dotek doc a/twin.cycle b/../a/twin.cycle -o out").status == 0);
}

TEST_CASE("no result is written over an input, whatever its name") {
  const ProcessFolder folder;
  folder.write("p.nc", kProgram);
  folder.write("sub/q.nc", "%\nO2\nG0 X2.\nM99\n%\n");
  folder.run("ln -s p.nc soft.nc; ln p.nc hard.nc; chmod 444 sub/q.nc");
  const std::string root = "'" + dotek::tests::root().string() + "/examples/";
  folder.run("cp -r " + root + "surface-x' .; cp " + root + "'*.toml .; cp " + root +
             "'mill-post.txt post.txt");
  const ShellResult before = folder.run("sha256sum $(find . -type f | sort)");
  for (const std::string& command :
       {std::string("sim p.nc --trace p.nc"), std::string("sim p.nc --trace ./p.nc"),
        std::string("sim p.nc --html soft.nc"), std::string("sim p.nc --svg hard.nc"),
        std::string("sim soft.nc --svg p.nc"), std::string("convert p.nc --to fanuc -o p.nc"),
        std::string("convert p.nc --to fanuc --map p.nc"), std::string("convert p.nc --to fanuc -d ."),
        std::string("sim p.nc --programs sub --trace sub/q.nc --force"),
        std::string("post surface-x --prog post.txt --clearance 5 -o post.txt"),
        std::string(
            "post surface-x --prog post.txt --clearance 5 --host tool_radius=3 -o surface-x/CycleData.mac"),
        std::string("sim p.nc --part plate-part.toml --machine probe-machine.toml --svg plate-part.toml"),
        std::string("verify p.nc --to fanuc -o p.nc")}) {
    const ShellResult result = folder.run("dotek " + command);
    CHECK_MESSAGE(result.status == 2, command << "\n" << result.err);
    CHECK_MESSAGE(result.err.find("would overwrite the input") != std::string::npos, command << "\n"
                                                                                             << result.err);
    CHECK_MESSAGE(result.err.find("[output-is-input]") != std::string::npos, command);
  }
  CHECK(folder.run("sha256sum $(find . -type f | sort)").out == before.out);
}

TEST_CASE("a report of verify is written where cases ran, and nothing is where none did") {
  const ProcessFolder folder;
  const std::string root = "'" + dotek::tests::root().string() + "/examples/";
  folder.run("cp -r " + root + "surface-x' .; cp " + root + "'post.txt .; ln -s surface-x/ToolPath.mac soft");
  folder.write("bad.toml", "x\n");
  folder.write("rep", "old\n");
  folder.write("rep.html", "old\n");
  folder.write("p.nc", kProgram);
  const ShellResult before = folder.run("sha256sum $(find . -type f | sort)");
  const std::string verify = "dotek verify surface-x --prog post.txt --form thesis-a --to fanuc --cases 2 ";
  for (const std::string& early :
       {verify + "--job bad.toml", verify + "--part bad.toml", verify + "--machine bad.toml",
        verify + "--routine nosuch", verify + "--translation nosuch", verify + "--limit steps=1",
        std::string("dotek verify p.nc --to fanuc --cases 2 --part bad.toml")})
    for (const char* output :
         {"surface-x/ToolPath.mac", "./surface-x/../surface-x/ToolPath.mac", "soft", "rep", "rep.html"}) {
      const ShellResult result = folder.run(early + " -o " + output);
      CHECK_MESSAGE(result.status > 0, early << result.out);
      CHECK_MESSAGE(folder.run("sha256sum $(find . -type f | sort)").out == before.out,
                    early << " -o " << output << "\n"
                          << result.err);
    }
  folder.write("dotek.toml", "x\n");
  CHECK(folder.run(verify + "-o surface-x/ToolPath.mac").status > 0);
  folder.run("rm dotek.toml");
  CHECK(folder.run("sha256sum $(find . -type f | sort)").out == before.out);
}

TEST_CASE("a data file of --data is an input of the command that writes a new one") {
  const ProcessFolder folder;
  folder.write("post.txt", "progStart:\n SeqC SpinOff EOL\nRETURN\n");
  const ShellResult result =
      folder.run("mkdir -p data/forms; dotek new form shop --prog post.txt -o data/forms/shop.toml; echo $?; "
                 "cp data/forms/shop.toml before; dotek new form shop --prog post.txt --data data -o "
                 "data/forms/shop.toml; echo $?; cmp before data/forms/shop.toml");
  CHECK(result.out == "0\n2\n");
}

TEST_CASE("an input that is given twice is one") {
  const ProcessFolder folder;
  folder.write("p.nc", kProgram);
  folder.write("post.txt",
               "progStart:\n SeqC SpinOff EOL\n IF Flag? ('a')\n  SeqC' M5''' EOL\n END\nRETURN\n");
  folder.run("ln -s p.nc soft.nc; mkdir sub; cp p.nc sub/O2.nc; ln -s ../post.txt sub/post.txt");
  const ShellResult lint =
      folder.run("dotek lint --select all post.txt > one; dotek lint --select all post.txt "
                 "./post.txt sub/../post.txt > two; cmp one two");
  CHECK(lint.out.empty());
  const ShellResult convert =
      folder.run("dotek convert p.nc --to fanuc > one; dotek convert p.nc soft.nc ./p.nc "
                 "--to fanuc -o two; cmp one two; dotek sim p.nc --programs sub --programs "
                 "./sub; echo $?");
  CHECK(convert.out.ends_with("\n0\n"));
  CHECK_MESSAGE(convert.err.find("error") == std::string::npos, convert.err);
  // Through a folder and by its name: the file is mended once.
  const ShellResult fixed = folder.run(
      "cp post.txt kept; dotek lint --select all --fix kept; dotek lint --select all --fix sub post.txt; "
      "cmp kept post.txt && test -L sub/post.txt && echo same");
  CHECK(fixed.out.ends_with("same\n"));
}
