// What the protocol asks of a server beside the languages: order, cancelling, errors in plain words.
#include "tests/LspClient.h"
#include "tests/TestFolder.h"

using namespace dotek;
using namespace dotek::tests::editor;
using dotek::tests::TestFolder;
using lsp::Server;

TEST_CASE("lsp: a request that is cancelled before it begins is answered with that") {
  Server server("");
  server.receive(R"({"id":1,"method":"initialize","params":{}})");
  server.queue(R"({"id":2,"method":"textDocument/hover","params":{}})");
  server.queue(R"({"id":"3","method":"textDocument/hover","params":{}})");
  server.queue(R"({"id":4,"method":"shutdown"})");
  server.queue(R"({"method":"$/cancelRequest","params":{"id":"3"}})");
  server.queue(R"({"method":"$/cancelRequest","params":{"id":99}})");
  server.queue(R"({"method":"$/cancelRequest","params":7})");
  std::vector<Json> answers;
  while (server.hasQueued())
    for (Json& one : server.next())
      answers.push_back(std::move(one));
  REQUIRE(answers.size() == 3);
  CHECK(answers[0]["error"]["code"] == -32602);
  CHECK(answers[1]["id"] == "3");
  CHECK(answers[1]["error"]["code"] == -32800);
  CHECK(answers[2].contains("result"));
}

TEST_CASE("lsp: a second initialize is an error, and the first counts") {
  Server server("");
  server.receive(
      R"({"id":1,"method":"initialize","params":{"capabilities":{"general":{"positionEncodings":["utf-8"]}}}})");
  CHECK(server.receive(R"({"id":2,"method":"initialize","params":{}})")[0]["error"]["code"] == -32600);
  CHECK(server.receive(R"({"id":3,"method":"shutdown"})")[0].contains("result"));
}

TEST_CASE("lsp: parameters of other types are refused in plain words") {
  const TestFolder folder("lsp-types");
  Client client;
  const std::string text = "O1\nGOTO10\nN10M99\n", path = folder.write("O1.nc", text);
  client.open(path, text);
  const auto refused = [&](const std::string& method, const Json& params) {
    const Json answer = client.ask(method, params);
    REQUIRE_MESSAGE(answer.contains("error"), answer.dump());
    CHECK_MESSAGE(answer["error"]["code"] == -32602, answer.dump());
    CHECK_MESSAGE(answer["error"]["message"].get<std::string>().find("json") == std::string::npos,
                  answer.dump());
  };
  const Json document = {{"uri", uriOf(path)}};
  refused("textDocument/hover", {{"textDocument", 7}});
  refused("textDocument/hover", Json::array({1}));
  refused("textDocument/hover",
          {{"textDocument", document}, {"position", {{"line", "1"}, {"character", 0}}}});
  Json named = at(path, 2, 1);
  named["newName"] = 7;
  refused("textDocument/rename", named);
  Json asked = at(path, 2, 1);
  asked["context"] = "all";
  refused("textDocument/references", asked);
  Json actions = all(path);
  actions["range"]["start"]["line"] = "first";
  refused("textDocument/codeAction", actions);
  refused("workspace/executeCommand", {{"command", 7}});
  refused("workspace/executeCommand", 7);
}

TEST_CASE("lsp: an empty batch is answered") {
  Client client;
  const auto answers = client.server().receive("[]");
  REQUIRE(answers.size() == 1);
  CHECK(answers.front()["error"]["code"] == -32600);
}

TEST_CASE("lsp: completion after GOTO lists each block of the program once, after # each variable") {
  const TestFolder folder("lsp-once");
  Client client;
  const std::string text = "O1\nGOTO40\nN40#1=#500\nGOTO \n#2=#\nM99\nO2\nN50#3=1\nM99\n",
                    path = folder.write("O1.nc", text);
  client.open(path, text);
  const auto labels = [&](int line, int character) { return client.labels(path, line, character); };
  CHECK(labels(3, 5) == std::vector<std::string>{"40"});
  CHECK(labels(1, 6) == std::vector<std::string>{"40"});
  CHECK(labels(4, 4) == std::vector<std::string>{"1", "500"});
}
