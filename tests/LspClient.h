// A client of the language server, in process.
#pragma once

#include "lsp/Server.h"

#include <doctest/doctest.h>
#include <string>
#include <vector>

namespace dotek::tests::editor {

using lsp::Json;
using lsp::uriOf;

class Client {
public:
  explicit Client(const Json& capabilities = Json::object()) {
    result("initialize", {{"capabilities", capabilities}});
    note("initialized", Json::object());
  }

  Json ask(const std::string& method, const Json& params) {
    const std::vector<Json> out = server_.receive(
        Json{{"jsonrpc", "2.0"}, {"id", ++id_}, {"method", method}, {"params", params}}.dump());
    REQUIRE(out.size() == 1);
    CHECK(out.front()["id"] == id_);
    return out.front();
  }
  Json result(const std::string& method, const Json& params) {
    const Json answer = ask(method, params);
    REQUIRE_MESSAGE(answer.contains("result"), answer.dump());
    return answer["result"];
  }
  void note(const std::string& method, const Json& params) {
    CHECK(server_.receive(Json{{"jsonrpc", "2.0"}, {"method", method}, {"params", params}}.dump()).empty());
  }
  // Opens a text and gives what is found in it.
  Json open(const std::string& path, const std::string& text, const std::string& language = "nc") {
    note(
        "textDocument/didOpen",
        {{"textDocument", {{"uri", uriOf(path)}, {"languageId", language}, {"version", 1}, {"text", text}}}});
    return findings(path);
  }
  // Findings of the path that the server sends now.
  Json findings(const std::string& path) {
    Json out;
    for (const Json& message : server_.idle())
      if (message["params"]["uri"] == uriOf(path)) out = message["params"]["diagnostics"];
    return out;
  }
  // What may be written at a place.
  std::vector<std::string> labels(const std::string& path, int line, int character) {
    const Json found =
        result("textDocument/completion", {{"textDocument", {{"uri", uriOf(path)}}},
                                           {"position", {{"line", line}, {"character", character}}}});
    std::vector<std::string> out;
    for (const Json& one : found["items"])
      out.push_back(one["label"]);
    return out;
  }
  lsp::Server& server() { return server_; }

private:
  lsp::Server server_{""};
  int id_ = 0;
};

inline Json at(const std::string& path, int line, int character) {
  return {{"textDocument", {{"uri", uriOf(path)}}}, {"position", {{"line", line}, {"character", character}}}};
}

inline Json all(const std::string& path) {
  return {
      {"textDocument", {{"uri", uriOf(path)}}},
      {"context", {{"diagnostics", Json::array()}}},
      {"range", {{"start", {{"line", 0}, {"character", 0}}}, {"end", {{"line", 999}, {"character", 0}}}}}};
}

inline std::vector<std::string> codes(const Json& findings) {
  std::vector<std::string> out;
  for (const Json& one : findings)
    out.push_back(one["code"]);
  return out;
}

} // namespace dotek::tests::editor
