#include "cli/Cli.h"
#include "script/Script.h"
#include "script/Serve.h"
#include "support/Stack.h"
#include "support/Stream.h"
#include "support/Temporary.h"

#include <csignal>
#include <ostream>
#include <string_view>
#include <unistd.h>

namespace {

int run(int argc, char** argv) {
  if (argc == 2 && argv[1] == dotek::script::kWorkerCommand) return dotek::script::serve();
  dotek::DescriptorBuffer outBuffer(STDOUT_FILENO), errBuffer(STDERR_FILENO);
  std::ostream out(&outBuffer), err(&errBuffer);
  err << std::unitbuf;
  return dotek::cli::run(std::vector<std::string>(argv + 1, argv + argc), out, err);
}

} // namespace

int main(int argc, char** argv) {
  dotek::holdStandardDescriptors();
  if (argc != 2 || argv[1] != dotek::script::kWorkerCommand) {
    dotek::removeTemporariesOnSignals();
    // A file that grows too large is a failed write, not the end of the process.
    std::signal(SIGXFSZ, SIG_IGN);
    // How a worker ended is asked for, whatever who started us does with processes.
    std::signal(SIGCHLD, SIG_DFL);
  }
  const int status = dotek::runWithStack(run, argc, argv);
  if (status >= 0) return status;
  constexpr std::string_view kNoRoom =
      "error: there is no room for a stack of 8 MB: raise `ulimit -s`, `ulimit -v` or `ulimit -u`\n";
  dotek::writeFully(STDERR_FILENO, kNoRoom);
  return dotek::cli::kUsage;
}
