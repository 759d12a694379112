#include "lsp/Serve.h"

#include "lsp/Frames.h"
#include "lsp/Server.h"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <ostream>

namespace dotek::lsp {
namespace {

constexpr std::size_t kMostQueued = 1000;

std::string textOf(const Json& message) {
  return message.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// The status after a message that could not be written.
int lost(int error, std::ostream& err) {
  if (error == EPIPE) return 1;
  err << "dotek: error: the answers of the language server cannot be written: "
      << (error == EBADF ? "standard output is closed" : std::strerror(error)) << '\n';
  return 2;
}

} // namespace

int serve(int input, int output, const std::string& scriptProgram, std::ostream& err) {
  std::signal(SIGPIPE, SIG_IGN); // an editor that is gone is the end of the input
  FrameReader reader(input);
  Server server(scriptProgram);
  bool more = true; // the input has not ended
  while (!server.ended()) {
    // What has come is read at once: it may cancel what waits.
    while (more && server.queued() < kMostQueued && (!server.hasQueued() || reader.waiting())) {
      const std::optional<std::string> text = reader.next();
      if (text)
        server.queue(*text);
      else
        more = false;
    }
    if (!server.hasQueued()) {
      if (reader.broken()) {
        err << "dotek: error: what came on standard input is no message of the language server protocol; "
               "`dotek lsp` is started by an editor\n";
        return 2;
      }
      err << "dotek: the editor ended without `shutdown` and `exit`\n";
      return 1;
    }
    for (const Json& message : server.next())
      if (!writeFrame(output, textOf(message))) return lost(errno, err);
    if (server.hasQueued() || (more && reader.waiting())) continue; // what is typed at once is checked once
    for (const Json& message : server.idle())
      if (!writeFrame(output, textOf(message))) return lost(errno, err);
  }
  return server.shutDown() ? 0 : 1;
}

} // namespace dotek::lsp
