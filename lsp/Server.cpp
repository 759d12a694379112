#include "lsp/Server.h"

#include "support/Version.h"

#include <exception>
#include <map>

namespace dotek::lsp {
namespace {

constexpr int kParseError = -32700, kInvalidRequest = -32600, kNoMethod = -32601, kInternal = -32603,
              kNotInitialized = -32002, kCancelled = -32800;

Json failure(const Json& id, int code, const std::string& message) {
  return {{"jsonrpc", "2.0"}, {"id", id}, {"error", {{"code", code}, {"message", message}}}};
}

std::string textAt(const Json& object, const char* name) {
  const auto at = object.is_object() ? object.find(name) : object.end();
  return object.is_object() && at != object.end() && at->is_string() ? at->get<std::string>() : "";
}

const Json& objectAt(const Json& object, const char* name) {
  static const Json kNone = Json::object();
  if (!object.is_object()) return kNone;
  const auto at = object.find(name);
  return at == object.end() ? kNone : *at;
}

using Request = Json (*)(Workspace& workspace, const Json& params);
const std::map<std::string, Request>& requests() {
  static const std::map<std::string, Request> kRequests = {
      {"textDocument/hover", hover},
      {"textDocument/definition", definition},
      {"textDocument/references", references},
      {"textDocument/documentHighlight", highlights},
      {"textDocument/prepareRename", prepareRename},
      {"textDocument/rename", rename},
      {"textDocument/documentSymbol", documentSymbols},
      {"textDocument/inlayHint", inlayHints},
      {"textDocument/completion", completion},
      {"textDocument/codeAction", codeActions},
      {"textDocument/codeLens", codeLenses},
      {"textDocument/formatting", formatting},
      {"workspace/executeCommand", execute},
      {"dotek/run", runCommand},
  };
  return kRequests;
}

} // namespace

void Server::queue(std::string_view text) {
  Json message = Json::parse(text, nullptr, false);
  if (message.is_array() && !message.empty()) {
    for (Json& one : message)
      queued_.push_back({std::move(one)});
    return;
  }
  cancel(message);
  queued_.push_back({std::move(message)});
}

void Server::cancel(const Json& message) {
  if (textAt(message, "method") != "$/cancelRequest") return;
  const Json& params = objectAt(message, "params");
  const auto id = params.is_object() ? params.find("id") : params.end();
  if (!params.is_object() || id == params.end()) return;
  for (Queued& one : queued_)
    if (one.message.is_object() && one.message.contains("method") && one.message.value("id", Json()) == *id)
      one.cancelled = true;
}

std::vector<Json> Server::next() {
  const Queued one = std::move(queued_.front());
  queued_.pop_front();
  if (one.message.is_discarded()) return {failure(nullptr, kParseError, "the message is no JSON")};
  if (one.cancelled && initialized_ && !shutDown_)
    return {failure(one.message["id"], kCancelled, "the request was cancelled")};
  return dispatch(one.message);
}

std::vector<Json> Server::receive(std::string_view text) {
  std::vector<Json> out;
  for (queue(text); hasQueued();)
    for (Json& answer : next())
      out.push_back(std::move(answer));
  return out;
}

std::vector<Json> Server::dispatch(const Json& message) {
  if (!message.is_object()) return {failure(nullptr, kInvalidRequest, "the message is no object")};
  const std::string method = textAt(message, "method");
  const bool asks = message.contains("id");
  const Json id = asks ? message["id"] : Json();
  if (method.empty()) {
    if (message.contains("result") || message.contains("error")) return {}; // an answer of the client
    return {failure(id, kInvalidRequest, "the message has no `method`")};
  }
  const Json& params = objectAt(message, "params");
  try {
    if (!asks) {
      notified(method, params);
      return {};
    }
    if (!initialized_ && method != "initialize")
      return {failure(id, kNotInitialized, "`initialize` comes first")};
    if (shutDown_) return {failure(id, kInvalidRequest, "the server is shut down")};
    return {{{"jsonrpc", "2.0"}, {"id", id}, {"result", answer(method, params)}}};
  } catch (const Refusal& refusal) {
    return {failure(id, refusal.code, refusal.message)};
  } catch (const Json::exception&) {
    if (!asks) return {};
    return {failure(id, kInvalidParams,
                    "a parameter of `" + method + "` is of another type than the protocol gives it")};
  } catch (const std::exception& error) {
    if (!asks) return {};
    return {failure(id, kInternal, error.what())};
  }
}

Json Server::answer(const std::string& method, const Json& params) {
  if (method == "initialize") {
    if (initialized_) throw Refusal{kInvalidRequest, "the server is initialized"};
    return initialize(params);
  }
  if (method == "shutdown") {
    shutDown_ = true;
    return nullptr;
  }
  const auto found = requests().find(method);
  if (found == requests().end()) throw Refusal{kNoMethod, "no method `" + method + "`"};
  return found->second(workspace_, params);
}

Json Server::initialize(const Json& params) {
  initialized_ = true;
  const Json& encodings =
      objectAt(objectAt(objectAt(params, "capabilities"), "general"), "positionEncodings");
  if (encodings.is_array())
    for (const Json& one : encodings)
      if (one == "utf-8") workspace_.units = Units::Utf8;
  workspace_.showsDisabled =
      objectAt(objectAt(objectAt(objectAt(params, "capabilities"), "textDocument"), "codeAction"),
               "disabledSupport") == true;
  Json capabilities = {
      {"positionEncoding", workspace_.units == Units::Utf8 ? "utf-8" : "utf-16"},
      {"textDocumentSync", {{"openClose", true}, {"change", 2}, {"save", true}}},
      {"hoverProvider", true},
      {"definitionProvider", true},
      {"referencesProvider", true},
      {"documentHighlightProvider", true},
      {"documentSymbolProvider", true},
      {"renameProvider", {{"prepareProvider", true}}},
      {"inlayHintProvider", true},
      {"documentFormattingProvider", true},
      {"codeLensProvider", Json::object()},
      {"codeActionProvider",
       {{"codeActionKinds", {"quickfix", "refactor.rewrite.dotek.renumber", "source.fixAll.dotek"}}}},
      {"completionProvider", {{"triggerCharacters", {"'", "#", " ", "."}}}},
      {"executeCommandProvider", {{"commands", commandNames()}}},
      {"experimental", {{"dotekRun", true}}},
  };
  return {{"capabilities", capabilities},
          {"serverInfo", {{"name", "dotek"}, {"version", std::string(kVersion)}}}};
}

void Server::notified(const std::string& method, const Json& params) {
  if (method == "exit") {
    ended_ = true;
    return;
  }
  if (!initialized_ || shutDown_) return;
  const Json& document = objectAt(params, "textDocument");
  const auto version = [&] {
    const Json& number = objectAt(document, "version");
    return number.is_number_integer() ? number.get<std::int64_t>() : 0;
  };
  if (method == "textDocument/didOpen")
    workspace_.open(textAt(document, "uri"), textAt(document, "languageId"), version(),
                    textAt(document, "text"));
  else if (method == "textDocument/didChange")
    workspace_.change(textAt(document, "uri"), version(), objectAt(params, "contentChanges"));
  else if (method == "textDocument/didClose")
    workspace_.close(textAt(document, "uri"));
  else if (method == "textDocument/didSave" || method == "workspace/didChangeWatchedFiles" ||
           method == "workspace/didChangeConfiguration")
    workspace_.touchAll();
}

std::vector<Json> Server::idle() {
  try {
    return initialized_ && !shutDown_ && workspace_.hasChanges() ? workspace_.check() : std::vector<Json>();
  } catch (const std::exception& error) {
    return {{{"jsonrpc", "2.0"},
             {"method", "window/logMessage"},
             {"params", {{"type", 1}, {"message", std::string("dotek: ") + error.what()}}}}};
  }
}

} // namespace dotek::lsp
