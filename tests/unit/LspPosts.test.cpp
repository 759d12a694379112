// Posts of Fusion in the language server.
#include "tests/LspClient.h"
#include "tests/TestFolder.h"

#include <algorithm>

using namespace dotek;
using namespace dotek::tests::editor;
using dotek::tests::TestFolder;

namespace {

const std::string kPost = "description = \"Mill\";\n" // 0
                          "extension = \"nc\";\n"     // 1
                          "properties = {\n"          // 2
                          "  numbers: {title: \"Block numbers\", type: \"boolean\", value: false, group: "
                          "\"formats\", scope: \"post\"}\n"                    // 3
                          "};\n"                                               // 4
                          "var lengths = createFormat({decimals: 3});\n"       // 5
                          "function word(value) {\n"                           // 6
                          "  return \"X\" + lengths.format(value);\n"          // 7
                          "}\n"                                                // 8
                          "function onOpen() {\n"                              // 9
                          "  if (getProperty(\"numbers\")) writeln(\"N1\");\n" // 10
                          "  writeln(word(1));\n"                              // 11
                          "  if (getProperty(\"numbre\")) writeln(\"N2\");\n"  // 12
                          "}\n";

} // namespace

TEST_CASE("lsp: a post of Fusion: symbols, hover, definition, completion, findings") {
  const TestFolder folder("lsp-cps");
  const std::string path = folder.write("mill.cps", kPost);
  Client client;
  const Json found = client.open(path, kPost);
  const auto hover = [&](int line, int character) {
    const Json out = client.result("textDocument/hover", at(path, line, character));
    return out.is_null() ? "" : out["contents"]["value"].get<std::string>();
  };
  const Json symbols = client.result("textDocument/documentSymbol", at(path, 0, 0));
  REQUIRE(symbols.size() == 4);
  CHECK(symbols[0]["name"] == "properties");
  CHECK(symbols[0]["children"][0]["name"] == "numbers");
  CHECK(symbols[2]["name"] == "word");
  CHECK(symbols[3]["detail"] == "called by the engine");
  CHECK(hover(11, 11).find("function word(value)") != std::string::npos);
  CHECK(hover(11, 4).find("function of the engine") != std::string::npos);
  CHECK(hover(10, 20).find("Block numbers") != std::string::npos);
  CHECK(hover(7, 16).find("createFormat({decimals: 3})") != std::string::npos);
  const auto line = [&](int at_line, int character) {
    const Json out = client.result("textDocument/definition", at(path, at_line, character));
    return out.size() == 1 ? out[0]["range"]["start"]["line"].get<int>() : -1;
  };
  CHECK(line(11, 11) == 6);
  CHECK(line(10, 20) == 3);
  CHECK(line(7, 33) == 6); // the parameter
  CHECK(client.result("textDocument/references", at(path, 5, 5)).size() == 2);
  CHECK(client.labels(path, 10, 19) == std::vector<std::string>{"numbers"});
  const auto words = client.labels(path, 12, 0);
  for (const char* word : {"word", "lengths", "createFormat", "onSection", "writeln"})
    CHECK_MESSAGE(std::find(words.begin(), words.end(), word) != words.end(), word);

  // What a finding of a post offers, and that the comment silences it.
  REQUIRE(!found.empty());
  const Json actions = client.result("textDocument/codeAction", all(path));
  const std::string code = found[0]["code"];
  const auto named = [&](const std::string& title) {
    for (const Json& one : actions)
      if (one["title"] == title) return one;
    return Json();
  };
  CHECK(named("Explain " + code).is_object());
  const Json ignore = named("Ignore " + code + " in this line");
  REQUIRE(ignore.is_object());
  const Json edit = ignore["edit"]["changes"][uriOf(path)][0];
  client.note("textDocument/didChange",
              {{"textDocument", {{"uri", uriOf(path)}, {"version", 2}}},
               {"contentChanges", {{{"range", edit["range"]}, {"text", edit["newText"]}}}}});
  CHECK(client.findings(path).size() == found.size() - 1);
}

TEST_CASE("lsp: names that only a post sees are renamed in it") {
  const TestFolder folder("lsp-cps-rename");
  const std::string path = folder.write("mill.cps", kPost);
  Client client;
  client.open(path, kPost);
  const auto rename = [&](const std::string& file, int line, int character, const char* name) {
    Json params = at(file, line, character);
    params["newName"] = name;
    const Json answer = client.ask("textDocument/rename", params);
    return answer.contains("error") ? std::size_t{0} : answer["result"]["changes"][uriOf(file)].size();
  };
  CHECK(rename(path, 5, 5, "millimetres") == 2);
  CHECK(rename(path, 6, 15, "number") == 2);  // a parameter
  CHECK(rename(path, 11, 11, "axis") == 2);   // a function, from its call
  CHECK(rename(path, 9, 10, "open") == 0);    // the engine calls it
  CHECK(rename(path, 0, 2, "text") == 0);     // and reads this
  CHECK(rename(path, 10, 20, "blocks") == 0); // jobs name it
  for (const char* taken : {"word", "createFormat", "var", "onClose", "value", "1st"}) {
    CAPTURE(taken);
    CHECK(rename(path, 5, 5, taken) == 0);
  }
  // Where another script is read, what is outside of functions may be used there.
  const std::string more = "include(\"other.cps\");\n" + kPost;
  const std::string including = folder.write("more.cps", more);
  client.open(including, more);
  CHECK(rename(including, 6, 5, "millimetres") == 0);
  CHECK(rename(including, 7, 15, "number") == 2);
  const std::string both =
      "function onOpen() {\n  var one = 1, two = 2;\n  writeln({one, other: two}.one);\n}\n";
  const std::string pair = folder.write("pair.cps", both);
  client.open(pair, both);
  CHECK(rename(pair, 1, 7, "first") == 0); // the name of the property, too
  CHECK(rename(pair, 1, 16, "second") == 2);
}
