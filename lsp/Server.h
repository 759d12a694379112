// The protocol: messages in, messages out. One thread; nothing is thrown.
#pragma once

#include "lsp/Places.h"
#include "lsp/Workspace.h"

#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::lsp {

inline constexpr int kInvalidParams = -32602, kRequestFailed = -32803;

// Why a request has no answer.
struct Refusal {
  int code = kInvalidParams;
  std::string message;
};

class Server {
public:
  explicit Server(std::string scriptProgram) : workspace_(std::move(scriptProgram)) {}

  // Takes a message of the client, or a batch of them, to answer it after those before. A request that is
  // cancelled while it waits is answered with that alone.
  void queue(std::string_view text);
  std::size_t queued() const { return queued_.size(); }
  bool hasQueued() const { return queued() > 0; }
  // The answer to the message that waits longest, and what is sent with it.
  std::vector<Json> next();
  // One message and its answers, with those of what waits.
  std::vector<Json> receive(std::string_view text);
  // Nothing more waits: what has changed is checked, and the findings are sent.
  std::vector<Json> idle();

  bool ended() const { return ended_; }       // after `exit`
  bool shutDown() const { return shutDown_; } // after `shutdown`

private:
  struct Queued {
    Json message;
    bool cancelled = false;
  };
  void cancel(const Json& message);
  std::vector<Json> dispatch(const Json& message);
  Json answer(const std::string& method, const Json& params);
  void notified(const std::string& method, const Json& params);
  Json initialize(const Json& params);

  Workspace workspace_;
  std::deque<Queued> queued_;
  bool initialized_ = false, shutDown_ = false, ended_ = false;
};

// Requests about one document, each in the room of its name. They throw Refusal.
Json hover(Workspace& workspace, const Json& params);
Json definition(Workspace& workspace, const Json& params);
Json references(Workspace& workspace, const Json& params);
Json highlights(Workspace& workspace, const Json& params);
Json prepareRename(Workspace& workspace, const Json& params);
Json rename(Workspace& workspace, const Json& params);
Json documentSymbols(Workspace& workspace, const Json& params);
Json inlayHints(Workspace& workspace, const Json& params);
Json completion(Workspace& workspace, const Json& params);
Json codeActions(Workspace& workspace, const Json& params);
Json codeLenses(Workspace& workspace, const Json& params);
Json formatting(Workspace& workspace, const Json& params);
// `dotek/run`: what post, convert, run, verify or preview give, as a page or a text.
Json runCommand(Workspace& workspace, const Json& params);
Json execute(Workspace& workspace, const Json& params);
// The names of execute().
Json commandNames();

// The document that a request is about; throws Refusal where it is not open.
const Document& documentOf(const Workspace& workspace, const Json& params);
// The place that a request is about, in the text of the index.
std::uint32_t placeOf(const Workspace& workspace, const Index& index, const Json& params);

} // namespace dotek::lsp
