// What an editor shows beside the text: `dotek/run`, its values that are missing, the lenses.
#include "tests/GoldenRunner.h"
#include "tests/LspClient.h"
#include "tests/TestFolder.h"

#include <filesystem>

using namespace dotek;
using namespace dotek::tests::editor;
using dotek::tests::TestFolder;

namespace {

const std::string kCycle = "cycle reach \"How far\"\n"
                           "parameter depth : length \"How deep\"\n"
                           "parameter side : length = 2 mm\n"
                           "result found : length \"Where\"\n"
                           "probe on\n"
                           "touch z by -depth -> floor\n"
                           "found = floor.at\n";

Json asked(const std::string& path, const std::string& command, const Json& more = Json::object()) {
  Json out = {{"textDocument", {{"uri", uriOf(path)}}}, {"command", command}};
  out.update(more);
  return out;
}

std::string textOf(const Json& result) {
  return result["text"].get<std::string>();
}

std::vector<std::string> lenses(Client& client, const std::string& path) {
  const Json found = client.result("textDocument/codeLens", at(path, 0, 0));
  std::vector<std::string> out;
  for (const Json& one : found)
    out.push_back(one["command"]["title"]);
  return out;
}

} // namespace

TEST_CASE("lsp: a run names the values that it needs, and takes them") {
  const TestFolder folder("lsp-run");
  const std::string path = folder.write("reach.cycle", kCycle);
  Client client;
  client.open(path, kCycle);
  CHECK(lenses(client, path) == std::vector<std::string>{"convert", "run (asks for depth)", "verify"});
  const Json without = client.result("dotek/run", asked(path, "run"));
  CHECK(without["status"] != 0);
  REQUIRE(without["missing"].size() == 1);
  CHECK(without["missing"][0]["option"] == "set");
  CHECK(without["missing"][0]["name"] == "depth");
  const Json page = client.result("dotek/run", asked(path, "run", {{"set", {{"depth", 7}}}}));
  CHECK(page["status"] == 0);
  CHECK(page["language"] == "html");
  CHECK(textOf(page).find("<html") != std::string::npos);
  const Json text =
      client.result("dotek/run", asked(path, "run", {{"set", {{"depth", "7"}}}, {"format", "text"}}));
  CHECK(text["language"] == "plaintext");
  CHECK(textOf(text).find("result found") != std::string::npos);
  CHECK(text["missing"].empty());
}

TEST_CASE("lsp: what runs is the text of the editor, saved or not") {
  const TestFolder folder("lsp-unsaved");
  const std::string path = folder.write("O1.nc", "%\nO1\nG0 X1.\nM30\n%\n");
  Client client;
  client.open(path, "%\nO1\nG0 X2.\nM30\n%\n");
  CHECK(textOf(client.result("dotek/run", asked(path, "run", {{"format", "text"}}))).find("X2.000000") !=
        std::string::npos);
  const std::string never = (std::filesystem::path(path).parent_path() / "O2.nc").string();
  client.open(never, "%\nO2\nG0 X3.\nM30\n%\n");
  CHECK(textOf(client.result("dotek/run", asked(never, "run", {{"format", "text"}}))).find("X3.000000") !=
        std::string::npos);
  CHECK(lenses(client, path) == std::vector<std::string>{"convert", "run", "verify"});
}

TEST_CASE("lsp: a macro that needs arguments says which call it waits for") {
  const TestFolder folder("lsp-call");
  const std::string text =
      "%\nO9001(CALL: G65 P9001 Z5.)\nIF[#26EQ#0]THEN#3000=1(Z MISSING)\nG0Z#26\nM99\n%\n";
  const std::string path = folder.write("O9001.nc", text);
  Client client;
  client.open(path, text);
  const Json without = client.result("dotek/run", asked(path, "run", {{"format", "text"}}));
  REQUIRE(without["missing"].size() == 1);
  CHECK(without["missing"][0]["option"] == "call");
  const Json with = client.result("dotek/run", asked(path, "run", {{"format", "text"}, {"call", "Z5."}}));
  CHECK(textOf(with).find("Z5.000000") != std::string::npos);
}

TEST_CASE("lsp: post, convert, verify and preview as a page or a text") {
  const TestFolder folder("lsp-results");
  const std::filesystem::path from = tests::root() / "examples";
  for (const char* name : {"CycleData.dlg", "CycleData.mac", "DefineData.txt", "ToolPath.mac"})
    folder.write(std::string("surface-x/") + name, tests::readAll(from / "surface-x" / name));
  folder.write("post.txt", tests::readAll(from / "post.txt"));
  folder.write("dotek.toml", "schema = 1\nprog = \"post.txt\"\nform = \"thesis-a\"\n");
  const std::string text = tests::readAll(from / "surface-x/ToolPath.mac");
  const std::string path = folder.write("surface-x/ToolPath.mac", text);
  Client client;
  client.open(path, text);
  const Json without = client.result("dotek/run", asked(path, "post"));
  REQUIRE(without["missing"].size() == 1);
  CHECK(without["missing"][0]["option"] == "host");
  CHECK(without["missing"][0]["name"] == "clearance");
  const Json blocks = client.result("dotek/run", asked(path, "post", {{"host", {{"clearance", 5}}}}));
  CHECK(blocks["language"] == "dotek-macrob");
  CHECK(textOf(blocks).find("G65 P9770") != std::string::npos);
  const Json page =
      client.result("dotek/run", asked(path, "post", {{"host", {{"clearance", 5}}}, {"format", "html"}}));
  CHECK(page["language"] == "html");
  CHECK(textOf(page).find("<pre>") != std::string::npos);
  CHECK(textOf(client.result("dotek/run", asked(path, "convert"))).find("O8000") != std::string::npos);
  CHECK(client.result("dotek/run", asked(path, "verify", {{"format", "text"}}))["language"] == "markdown");
  CHECK(textOf(client.result("dotek/run", asked(path, "preview"))).find("<html") != std::string::npos);
}

TEST_CASE("lsp: dotek/run refuses what it does not know") {
  const TestFolder folder("lsp-run-wrong");
  const std::string path = folder.write("reach.cycle", kCycle);
  Client client;
  client.open(path, kCycle);
  for (const Json& params :
       {asked(path, "engrave"), asked(path, "run", {{"format", "pdf"}}), asked(path, "run", {{"set", 7}}),
        asked(path, "run", {{"set", {{"depth", true}}}}), asked(path, "convert", {{"target", 7}}), Json(7)}) {
    const Json answer = client.ask("dotek/run", params);
    CHECK_MESSAGE(answer["error"]["code"] == -32602, params.dump());
  }
  CHECK(client.ask("dotek/run", asked(path + "x", "run")).contains("error"));
}

TEST_CASE("lsp: commands in a post are about one of its cycles") {
  const TestFolder folder("lsp-runs-prog");
  const std::filesystem::path from = tests::root() / "examples";
  for (const char* name : {"CycleData.dlg", "CycleData.mac", "DefineData.txt", "ToolPath.mac"})
    for (const char* cycle : {"surface-x", "surface-z"})
      folder.write(std::string(cycle) + "/" + name, tests::readAll(from / cycle / name));
  std::string text = tests::readAll(from / "post.txt");
  text.insert(text.find("IF CycleType?('surface-x')"), "IF CycleType?('surface-z')\n SeqC 'M0' EOL\nEND\n");
  const std::string path = folder.write("post.txt", text);
  Client client;
  client.open(path, text);
  const std::vector<std::string> all = lenses(client, path);
  CHECK(std::count(all.begin(), all.end(), "convert surface-x") == 1);
  CHECK(std::count(all.begin(), all.end(), "verify surface-z") == 1);
  const Json host = {{"clearance", 5}};
  const Json one = client.result("dotek/run", asked(path, "post", {{"host", host}, {"cycle", "surface-x"}}));
  CHECK_MESSAGE(textOf(one).find("G65 P9770") != std::string::npos, one.dump());
  const std::size_t at = text.find("'surface-z'");
  REQUIRE(at != std::string::npos);
  const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  const Json byLine = client.result(
      "dotek/run", asked(path, "preview", {{"position", {{"line", line + 1}, {"character", 0}}}}));
  CHECK(byLine["status"] == 0);
  const Json none = client.ask("dotek/run", asked(path, "post"));
  CHECK(none["error"]["message"].get<std::string>().find("`surface-x`") != std::string::npos);
  CHECK(client.ask("dotek/run", asked(path, "post", {{"cycle", "other"}})).contains("error"));
  const Json byLens =
      client.result("workspace/executeCommand",
                    {{"command", "dotek.convert"}, {"arguments", {uriOf(path), nullptr, "surface-x"}}});
  CHECK(byLens["status"] == 0);
  CHECK(textOf(byLens).find("O") != std::string::npos);
}
