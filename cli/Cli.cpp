#include "cli/Cli.h"

#include <ostream>

namespace dotek::cli {

int run(const std::vector<std::string>&, std::ostream&, std::ostream& err) {
  err << "dotek: no command\n";
  return kUsage;
}

} // namespace dotek::cli
