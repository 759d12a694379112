// What lies in a folder under a name that Dotek reads and is no regular file: nobody named it, so nobody
// waits for it, and it is not passed over in silence where something depends on it.
#include "tests/GoldenRunner.h"
#include "tests/Process.h"

#include <doctest/doctest.h>
#include <vector>

using namespace dotek::tests;

namespace {

constexpr const char* kProgram = "%\nO1\nG90 G0 X1.\nM30\n%\n";

} // namespace

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
