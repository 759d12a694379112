#include "cli/Cli.h"
#include "script/Script.h"
#include "script/Serve.h"
#include "support/Stream.h"
#include "support/Temporary.h"

#include <csignal>
#include <ostream>
#include <unistd.h>

int main(int argc, char** argv) {
  dotek::holdStandardDescriptors();
  if (argc == 2 && argv[1] == dotek::script::kWorkerCommand) return dotek::script::serve();
  dotek::removeTemporariesOnSignals();
  // A file that grows too large is a failed write, not the end of the process.
  std::signal(SIGXFSZ, SIG_IGN);
  // How a worker ended is asked for, whatever who started us does with processes.
  std::signal(SIGCHLD, SIG_DFL);
  dotek::DescriptorBuffer outBuffer(STDOUT_FILENO), errBuffer(STDERR_FILENO);
  std::ostream out(&outBuffer), err(&errBuffer);
  err << std::unitbuf;
  return dotek::cli::run(std::vector<std::string>(argv + 1, argv + argc), out, err);
}
