#include "lsp/Serve.h"

#include "lsp/Frames.h"
#include "lsp/Server.h"

#include <csignal>

namespace dotek::lsp {
namespace {

std::string textOf(const Json& message) {
  return message.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace

int serve(int input, int output, const std::string& scriptProgram) {
  std::signal(SIGPIPE, SIG_IGN); // an editor that is gone is the end of the input
  FrameReader reader(input);
  Server server(scriptProgram);
  while (!server.ended()) {
    const std::optional<std::string> text = reader.next();
    if (!text) return 1;
    for (const Json& message : server.receive(*text))
      if (!writeFrame(output, textOf(message))) return 1;
    if (reader.waiting()) continue; // what is typed at once is checked once
    for (const Json& message : server.idle())
      if (!writeFrame(output, textOf(message))) return 1;
  }
  return server.shutDown() ? 0 : 1;
}

} // namespace dotek::lsp
