// New numbers for the blocks of a program, as an action of the editor.
#include "tests/LspClient.h"
#include "tests/TestFolder.h"

using namespace dotek;
using namespace dotek::tests::editor;
using dotek::tests::TestFolder;

TEST_CASE("lsp: blocks are renumbered by an action, with their jumps") {
  const TestFolder folder("lsp-renumber");
  const std::string text = "%\nO1\nN5 G0 X1.\nGOTO7\nN7 G0 X2.\nM30\n%\n";
  const std::string path = folder.write("O1.nc", text);
  const auto action = [&](Client& client, const std::string& of, const Json& context) {
    Json params = all(of);
    params["context"] = context;
    const Json found = client.result("textDocument/codeAction", params);
    for (const Json& one : found)
      if (one["title"].get<std::string>().starts_with("Renumber")) return one;
    return Json();
  };
  Client client;
  client.open(path, text);
  const Json found = action(client, path, {{"diagnostics", Json::array()}});
  REQUIRE(found.is_object());
  const Json edits = found["edit"]["changes"][uriOf(path)];
  REQUIRE(edits.size() == 3);
  CHECK(edits[0]["newText"] == "N10 G0 X1.");
  CHECK(edits[1]["newText"] == "GOTO20");
  CHECK(edits[2]["newText"] == "N20 G0 X2.");
  CHECK(action(client, path, {{"diagnostics", Json::array()}, {"triggerKind", 2}}).is_null());
  CHECK(action(client, path, {{"diagnostics", Json::array()}, {"only", {"refactor"}}}).is_object());
  CHECK(action(client, path, {{"diagnostics", Json::array()}, {"only", {"quickfix"}}}).is_null());
  // Where nobody can follow a jump, an editor that can show it gets the reason.
  const std::string computed = "%\nO2\nN5 #1=#2*3\nGOTO#1\nN7 M30\n%\n",
                    other = folder.write("O2.nc", computed);
  client.open(other, computed);
  CHECK(action(client, other, {{"diagnostics", Json::array()}}).is_null());
  Client shows(Json{{"textDocument", {{"codeAction", {{"disabledSupport", true}}}}}});
  shows.open(other, computed);
  const Json refused = action(shows, other, {{"diagnostics", Json::array()}});
  REQUIRE(refused.is_object());
  CHECK(refused.contains("disabled"));
}
