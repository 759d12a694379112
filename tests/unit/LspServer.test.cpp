// The language server in process: conversations, places, edits while typing.
#include "driver/Driver.h"
#include "lsp/Frames.h"
#include "lsp/Serve.h"
#include "lsp/Server.h"
#include "tests/Draws.h"
#include "tests/LspClient.h"
#include "tests/TestFolder.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <random>
#include <sstream>
#include <unistd.h>

using namespace dotek;
using namespace dotek::lsp;
using namespace dotek::tests::editor;
using dotek::tests::TestFolder;

namespace {

const std::string kProgram = "%\n"
                             "O7301 (CHECK THE VICE)\n"
                             "IF[#24EQ#0]GOTO40\n"
                             "G65P9811X#24S54.\n"
                             "#520=#5061\n"
                             "N40M99\n"
                             "%\n";

} // namespace

TEST_CASE("lsp: a program is checked as it is typed") {
  const TestFolder folder("lsp-typed");
  const std::string path = folder.write("O7301.nc", kProgram);
  Client client;
  CHECK(client.open(path, kProgram).size() == codes(client.findings(path)).size());
  // The target of the jump is lost, and comes back.
  const auto type = [&](int line, int from, int to, const std::string& text, int version) {
    client.note("textDocument/didChange", {{"textDocument", {{"uri", uriOf(path)}, {"version", version}}},
                                           {"contentChanges",
                                            {{{"range",
                                               {{"start", {{"line", line}, {"character", from}}},
                                                {"end", {{"line", line}, {"character", to}}}}},
                                              {"text", text}}}}});
    return codes(client.findings(path));
  };
  const auto lost = type(5, 1, 3, "41", 2);
  CHECK(std::find(lost.begin(), lost.end(), "goto-target-missing") != lost.end());
  const auto back = type(5, 1, 3, "40", 3);
  CHECK(std::find(back.begin(), back.end(), "goto-target-missing") == back.end());
}

TEST_CASE("lsp: hover, names, symbols and hints of a program") {
  const TestFolder folder("lsp-names");
  const std::string path = folder.write("O7301.nc", kProgram);
  Client client;
  client.open(path, kProgram);
  CHECK(client.result("textDocument/hover", at(path, 3, 1))["contents"]["value"].get<std::string>().find(
            "macro call") != std::string::npos);
  CHECK(client.result("textDocument/hover", at(path, 3, 13))["contents"]["value"].get<std::string>().find(
            "system") != std::string::npos);
  CHECK(client.result("textDocument/hover", at(path, 4, 7))["contents"]["value"].get<std::string>().find(
            "X of the skip position") != std::string::npos);
  const Json definition = client.result("textDocument/definition", at(path, 2, 16));
  REQUIRE(definition.size() == 1);
  CHECK(definition[0]["range"]["start"]["line"] == 5);
  CHECK(client.result("textDocument/references", at(path, 5, 1)).size() == 2);
  const Json symbols = client.result("textDocument/documentSymbol", at(path, 0, 0));
  REQUIRE(symbols.size() == 1);
  CHECK(symbols[0]["name"] == "O7301");
  CHECK(symbols[0]["detail"] == "CHECK THE VICE");
  CHECK(symbols[0]["children"][0]["name"] == "N40");
  const Json hints = client.result("textDocument/inlayHint", all(path));
  REQUIRE(hints.size() == 2);
  CHECK(hints[0]["label"] == "target x:");
  CHECK(hints[1]["label"] == "system:");
}

TEST_CASE("lsp: a block number is renamed with its jumps, other names are refused") {
  const TestFolder folder("lsp-rename");
  const std::string path = folder.write("O7301.nc", kProgram);
  Client client;
  client.open(path, kProgram);
  Json params = at(path, 5, 1);
  params["newName"] = "900";
  const Json edits = client.result("textDocument/rename", params)["changes"][uriOf(path)];
  REQUIRE(edits.size() == 2);
  CHECK(edits[0]["newText"] == "900");
  CHECK(edits[1]["newText"] == "N900");
  params["newName"] = "9X";
  CHECK(client.ask("textDocument/rename", params).contains("error"));
  Json variable = at(path, 4, 1); // another program may read it
  variable["newName"] = "521";
  CHECK(client.ask("textDocument/rename", variable).contains("error"));
  const std::string computed = "O1\nGOTO[#1]\nN10M99\n";
  const std::string other = folder.write("O1.nc", computed);
  client.open(other, computed);
  Json jump = at(other, 2, 1);
  jump["newName"] = "20";
  CHECK(client.ask("textDocument/rename", jump)["error"]["message"].get<std::string>().find("computes") !=
        std::string::npos);
}

TEST_CASE("lsp: a name is changed once at each place, and a label in its own macro alone") {
  const TestFolder folder("lsp-rename-once");
  Client client;
  const std::string cycle =
      "cycle two \"Two\"\n\nresult r : length\n\nrun_x = 1 mm\nrun_x = run_x + 1 mm\nr = run_x\n";
  const std::string path = folder.write("two.cycle", cycle);
  client.open(path, cycle);
  Json params = at(path, 4, 1);
  params["newName"] = "aside";
  const Json edits = client.result("textDocument/rename", params)["changes"][uriOf(path)];
  CHECK(edits.size() == 4);
  for (std::size_t i = 0; i < edits.size(); ++i)
    for (std::size_t k = i + 1; k < edits.size(); ++k)
      CHECK(edits[i]["range"] != edits[k]["range"]);

  folder.write("side/DefineData.txt", "X = 10\n");
  folder.write("side/CycleData.dlg", "");
  folder.write("side/ToolPath.mac", "GOTO ask\n:ask\n");
  const std::string text = "if X < 1 then message \"near\"\nGOTO ask\n:ask\n";
  const std::string macro = folder.write("side/CycleData.mac", text);
  client.open(macro, text);
  Json label = at(macro, 1, 6);
  label["newName"] = "again";
  const Json changes = client.result("textDocument/rename", label)["changes"];
  CHECK(changes.size() == 1);
  CHECK(changes[uriOf(macro)].size() == 2);
}

TEST_CASE("lsp: hover of the zeros of the work systems") {
  const TestFolder folder("lsp-zeros");
  const std::string text = "O1\n#1=#5221\n#2=#5242\n#3=#5263\nM99\n";
  folder.write("dotek.toml", "[lint]\ncontrol = \"fanuc-0i-md\"\n");
  const std::string path = folder.write("O1.nc", text);
  Client client;
  client.open(path, text);
  const auto hover = [&](int line) {
    return client.result("textDocument/hover", at(path, line, 5))["contents"]["value"].get<std::string>();
  };
  CHECK(hover(1).find("work offset G54, X") != std::string::npos);
  CHECK(hover(2).find("work offset G55, Y") != std::string::npos);
  CHECK(hover(3).find("work offset G56, Z") != std::string::npos);
}

TEST_CASE("lsp: a cycle's folder is one unit") {
  const TestFolder folder("lsp-cycle");
  const std::filesystem::path from = std::filesystem::current_path() / "examples/surface-x";
  const std::string data = folder.write("side/DefineData.txt", "X = 10\nI = 0\nG = 54\n");
  folder.write("side/CycleData.dlg", "");
  const std::string text = "if abs(X) < 1 then message \"too near\"\nGOTO again\n:again\n";
  const std::string macro = folder.write("side/CycleData.mac", text);
  Client client;
  client.open(macro, text);
  const Json definition = client.result("textDocument/definition", at(macro, 0, 7));
  REQUIRE(definition.size() == 1);
  CHECK(definition[0]["uri"] == uriOf(data));
  CHECK(client.result("textDocument/references", at(macro, 1, 6)).size() == 2);
}

TEST_CASE("lsp: a Prog and a file of the cycle language") {
  const TestFolder folder("lsp-others");
  Client client;
  const std::string prog =
      "probe:\n  IF CycleType?('edge')\n    clear\n  END\nRETURN\nclear:\n  'G0 Z' EOL\nRETURN\n";
  const std::string progPath = folder.write("post.txt", prog);
  client.open(progPath, prog);
  CHECK(client.result("textDocument/definition", at(progPath, 2, 5))[0]["range"]["start"]["line"] == 5);
  CHECK(client.result("textDocument/documentSymbol", at(progPath, 0, 0)).size() == 2);

  const std::string cycle = "cycle reach \"how far\"\n"
                            "parameter depth: length \"how deep\"\n"
                            "result found: length \"where\"\n"
                            "probe on\n"
                            "touch z by -depth -> floor\n"
                            "found = floor.at\n";
  const std::string cyclePath = folder.write("reach.cycle", cycle);
  client.open(cyclePath, cycle);
  CHECK(
      client.result("textDocument/hover", at(cyclePath, 4, 13))["contents"]["value"].get<std::string>().find(
          "how deep") != std::string::npos);
  CHECK(client.result("textDocument/references", at(cyclePath, 5, 9)).size() == 2);
}

TEST_CASE("lsp: repairs, suppressions and layout are offered") {
  const TestFolder folder("lsp-actions");
  const std::string text = "cycle   reach \"how far\"\nparameter depth: length \"how deep\"\nprobe on\ntouch "
                           "z by -depth -> floor\n";
  const std::string path = folder.write("reach.cycle", text);
  Client client;
  client.open(path, text);
  const Json edits = client.result("textDocument/formatting", at(path, 0, 0));
  REQUIRE(edits.size() == 1);
  CHECK(edits[0]["newText"].get<std::string>().starts_with("cycle reach \"how far\"\n"));

  // What has no layout is left as it is: an editor may ask for each file that it saves.
  const std::string blank = folder.write("blank.cps", "\n\n\n");
  client.open(blank, "\n\n\n");
  CHECK(client.result("textDocument/formatting", at(blank, 0, 0)).empty());

  const std::string program = "O7302\nG0Z5\nX10.Y20.\nX0.Y5.\nZ3.\n#1=#1\nM99\n";
  const std::string ncPath = folder.write("O7302.nc", program);
  const Json found = client.open(ncPath, program);
  const Json laid = client.result("textDocument/formatting", at(ncPath, 0, 0));
  REQUIRE(laid.size() == 1);
  CHECK(laid[0]["newText"].get<std::string>().find("X10. Y20.\n") != std::string::npos);
  const Json actions = client.result("textDocument/codeAction", all(ncPath));
  REQUIRE(!found.empty());
  for (const Json& one : found) {
    const std::string code = one["code"];
    const bool explained = std::any_of(actions.begin(), actions.end(), [&](const Json& action) {
      return action["title"] == "Explain " + code;
    });
    CHECK_MESSAGE(explained, code);
  }
  // What a suppression writes silences its finding.
  for (const Json& action : actions) {
    if (!action["title"].get<std::string>().starts_with("Ignore ")) continue;
    client.note("textDocument/didChange",
                {{"textDocument", {{"uri", uriOf(ncPath)}, {"version", 2}}},
                 {"contentChanges",
                  {action["edit"]["changes"][uriOf(ncPath)][0].is_object()
                       ? Json{{"range", action["edit"]["changes"][uriOf(ncPath)][0]["range"]},
                              {"text", action["edit"]["changes"][uriOf(ncPath)][0]["newText"]}}
                       : Json()}}});
    const std::string code = action["diagnostics"][0]["code"];
    const auto left = codes(client.findings(ncPath)), before = codes(found);
    CHECK(std::count(left.begin(), left.end(), code) == std::count(before.begin(), before.end(), code) - 1);
    break;
  }
}

TEST_CASE("lsp: columns in both units, names of files with blanks and accents") {
  const std::string text = "(\xC3\xA9\xF0\x9D\x84\x9E) N10\n";
  CHECK(columnsOf("\xC3\xA9\xF0\x9D\x84\x9E", Units::Utf16) == 3);
  CHECK(columnsOf("\xC3\xA9\xF0\x9D\x84\x9E", Units::Utf8) == 6);
  const Json sixteen = {{"line", 0}, {"character", 6}}, eight = {{"line", 0}, {"character", 9}};
  CHECK(offsetOf(text, sixteen, Units::Utf16) == 9u);
  CHECK(offsetOf(text, eight, Units::Utf8) == 9u);
  const Json beyond = {{"line", 7}, {"character", 3}};
  CHECK(offsetOf(text, beyond, Units::Utf16) == text.size());
  CHECK_FALSE(offsetOf(text, Json("no place"), Units::Utf16).has_value());
  const SourceFile czech("x", "(\xE8) N10", Encoding::Cp1250);
  CHECK(positionOf(czech, 4, Units::Utf8)["character"] == 5);
  CHECK(offsetOf(czech, {{"line", 0}, {"character", 5}}, Units::Utf8) == 4u);
  const std::string path = "/shop/m\xC4\x9B\xC5\x99"
                           "en\xC3\xAD 1/O 1#2.nc";
  CHECK(pathOf(uriOf(path)) == path);
  CHECK_FALSE(pathOf("untitled:Untitled-1").has_value());
  CHECK_FALSE(pathOf("file:///a%0").has_value());
}

TEST_CASE("lsp: what is no message of the protocol gets an error or no answer") {
  Server server("");
  CHECK(server.receive("{]")[0]["error"]["code"] == -32700);
  CHECK(server.receive("7")[0]["error"]["code"] == -32600);
  CHECK(server.receive(R"({"id":1,"method":"textDocument/hover"})")[0]["error"]["code"] == -32002);
  server.receive(R"({"id":2,"method":"initialize","params":{}})");
  CHECK(server.receive(R"({"id":3,"method":"textDocument/hover","params":{"textDocument":7}})")[0].contains(
      "error"));
  CHECK(server.receive(R"({"id":4,"method":"no/such"})")[0]["error"]["code"] == -32601);
  CHECK(
      server
          .receive(
              R"({"method":"textDocument/didChange","params":{"textDocument":{"uri":"file:///x"},"contentChanges":[{}]}})")
          .empty());
  CHECK(server.receive(R"({"method":"$/setTrace","params":null})").empty());
  CHECK(
      server
          .receive(
              R"({"id":5,"method":"workspace/executeCommand","params":{"command":"dotek.run","arguments":[1]}})")
              [0]
          .contains("error"));
  CHECK(server.receive(R"({"id":6,"method":"shutdown"})")[0]["result"].is_null());
  server.receive(R"({"method":"exit"})");
  CHECK(server.ended());
  CHECK(server.shutDown());
}

TEST_CASE("lsp: frames over a pipe, split anywhere") {
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  const std::string text =
      "content-length: 2\r\nContent-Type: x\r\n\r\n{}Content-Length: 3\r\n\r\n[1]Content-Length: x\r\n\r\n";
  for (const char c : text)
    REQUIRE(::write(ends[1], &c, 1) == 1);
  FrameReader reader(ends[0]);
  CHECK(reader.next() == "{}");
  CHECK(reader.waiting());
  CHECK(reader.next() == "[1]");
  CHECK_FALSE(reader.next().has_value());
  ::close(ends[1]);
  ::close(ends[0]);
}

// Typing at random: what the server finds is what lint of the text finds.
TEST_CASE("lsp: after random edits the findings are those of a fresh lint") {
  const TestFolder folder("lsp-random");
  std::mt19937 random(20);
  const std::vector<std::string> pieces = {"G1X", "#",          "[",        "]",   "GOTO", "N40",
                                           "\n",  "IF[#1EQ#0]", "G65P9811", "10.", "%",    "O",
                                           "(",   "\xC3\xA9",   "M99",      " ",   "END1"};
  std::string text = kProgram;
  const std::string path = folder.write("O7301.nc", text);
  Client client;
  client.open(path, text);
  for (int edit = 0; edit < tests::draws(300); ++edit) {
    const auto begin = static_cast<std::uint32_t>(random() % (text.size() + 1));
    const auto end = std::min<std::uint32_t>(static_cast<std::uint32_t>(text.size()), begin + random() % 4);
    const SourceFile file("x", text, Encoding::Utf8);
    const Json start = positionOf(file, begin, Units::Utf16), stop = positionOf(file, end, Units::Utf16);
    const auto from = offsetOf(text, start, Units::Utf16), to = offsetOf(text, stop, Units::Utf16);
    REQUIRE((from && to));
    const std::string piece = pieces[random() % pieces.size()];
    client.note("textDocument/didChange",
                {{"textDocument", {{"uri", uriOf(path)}, {"version", edit + 2}}},
                 {"contentChanges", {{{"range", {{"start", start}, {"end", stop}}}, {"text", piece}}}}});
    text.replace(*from, *to - *from, piece);
    const auto found = codes(client.findings(path));
    folder.write("O7301.nc", text);
    driver::LintOptions options;
    options.paths = {path};
    const driver::Outcome fresh = driver::lint(options);
    std::vector<std::string> expected;
    for (const Diagnostic& one : fresh.diagnostics.all())
      expected.emplace_back(one.code);
    CHECK_MESSAGE(found == expected, text);
    client.result("textDocument/documentSymbol", at(path, 0, 0));
    client.result("textDocument/hover",
                  at(path, static_cast<int>(random() % 9), static_cast<int>(random() % 20)));
    client.result("textDocument/completion",
                  at(path, static_cast<int>(random() % 9), static_cast<int>(random() % 20)));
  }
}

TEST_CASE("lsp: an output that fails, and an input that is no protocol, are failures with a word") {
  const TestFolder folder("lsp-streams");
  const auto served = [&](const std::string& input, const char* output, std::string& said) {
    const int in = ::open(folder.write("in", input).c_str(), O_RDONLY | O_CLOEXEC);
    const int out = ::open(output, O_WRONLY | O_CLOEXEC);
    std::ostringstream err;
    const int status = serve(in, out, "", err);
    ::close(in);
    ::close(out);
    said = err.str();
    return status;
  };
  const auto message = [](const std::string& body) {
    return "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
  };
  const std::string begin = message(R"({"id":1,"method":"initialize","params":{"capabilities":{}}})");
  const std::string end = message(R"({"id":2,"method":"shutdown"})") + message(R"({"method":"exit"})");
  std::string said;
  CHECK(served(begin + end, "/dev/null", said) == 0);
  CHECK(said.empty());
  CHECK(served(begin + end, "/dev/full", said) == 2);
  CHECK(said.find("No space left") != std::string::npos);
  CHECK(served(begin, "/dev/null", said) == 1);
  CHECK(said.find("shutdown") != std::string::npos);
  for (const std::string& bad :
       {std::string("garbage"), begin.substr(0, 40), "Content-Length: 99999999999\r\n\r\n{}" + begin,
        "Length: 2\r\n\r\n{}" + begin}) {
    CAPTURE(bad);
    CHECK(served(bad, "/dev/null", said) == 2);
    CHECK(said.find("no message") != std::string::npos);
  }
}
