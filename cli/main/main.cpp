#include "cli/Cli.h"
#include "support/Stream.h"
#include "support/Temporary.h"

#include <csignal>
#include <ostream>
#include <unistd.h>

int main(int argc, char** argv) {
  dotek::holdStandardDescriptors();
  dotek::removeTemporariesOnSignals();
  // A file that grows too large is a failed write, not the end of the process.
  std::signal(SIGXFSZ, SIG_IGN);
  dotek::DescriptorBuffer outBuffer(STDOUT_FILENO), errBuffer(STDERR_FILENO);
  std::ostream out(&outBuffer), err(&errBuffer);
  err << std::unitbuf;
  return dotek::cli::run(std::vector<std::string>(argv + 1, argv + argc), out, err);
}
