// Names across files that are not open, what completion takes from them and from the tables of the languages.
#include "tests/GoldenRunner.h"
#include "tests/LspClient.h"
#include "tests/TestFolder.h"

#include <algorithm>

using namespace dotek;
using namespace dotek::tests::editor;
using dotek::tests::TestFolder;

namespace {

bool has(const std::vector<std::string>& labels, const std::string& label) {
  return std::find(labels.begin(), labels.end(), label) != labels.end();
}

std::string hover(Client& client, const std::string& path, int line, int character) {
  const Json found = client.result("textDocument/hover", at(path, line, character));
  return found.is_null() ? "" : found["contents"]["value"].get<std::string>();
}

// A cycle of GibbsCAM with its post, and another whose fields have the same names.
struct Shop {
  TestFolder folder;
  std::string prog, progPath, macro, macroPath, define;
  explicit Shop(const std::string& name) : folder(name) {
    for (const char* cycle : {"side", "top"}) {
      const std::string at = std::string(cycle) + "/";
      folder.write(at + "DefineData.txt", "X = 10\nG = 54\n");
      folder.write(at + "CycleData.dlg", "dialog \"Side\", 0, 0, 300, 200\n"
                                         "label 20, 20, 60, 24, \"Reach [mm]\"\n"
                                         "input 90, 20, 60, 24, X, X\n"
                                         "ok 20, 90, 60, 24\ncancel 90, 90, 60, 24\n");
      folder.write(at + "CycleData.mac", "call \"Checks\"\n");
      folder.write(at + "Checks.mac", "if X < 1 then message \"near\"\n");
    }
    macro = "add_custom_drill_cycle_path feed_x, X\n";
    macroPath = folder.write("side/ToolPath.mac", macro);
    folder.write("top/ToolPath.mac", macro);
    define = (folder / "side/DefineData.txt").string();
    prog = "probe:\nIF CycleType?('side')\n 'G1X'OpFieldData#('X') EOL\nEND\n"
           "IF CycleType?('top')\n 'G1X'OpFieldData#('X') EOL\nEND\nRETURN\n";
    progPath = folder.write("post.txt", prog);
    folder.write("dotek.toml", "schema = 1\nprog = \"post.txt\"\n");
  }
};

} // namespace

TEST_CASE("lsp: from the post to a cycle that is not open, and back") {
  const Shop shop("lsp-post-fields");
  Client client;
  client.open(shop.progPath, shop.prog);
  const Json field = client.result("textDocument/definition", at(shop.progPath, 2, 21));
  REQUIRE(field.size() == 1);
  CHECK(field[0]["uri"] == uriOf(shop.define));
  const Json cycle = client.result("textDocument/definition", at(shop.progPath, 1, 16));
  REQUIRE(cycle.size() == 1);
  CHECK(cycle[0]["uri"] == uriOf(shop.macroPath));
  const std::string text = hover(client, shop.progPath, 2, 21);
  CHECK_MESSAGE(text.find("10 at first") != std::string::npos, text);
  CHECK_MESSAGE(text.find("Reach [mm]") != std::string::npos, text);
  CHECK(client.labels(shop.progPath, 2, 21) == std::vector<std::string>{"X", "G"});
  // A word that is half typed is no proposal.
  const std::string half = "probe:\nIF CycleType?('side')\n 'G1X'OpFieldData#('XY') EOL\nEND\nRETURN\n";
  client.open(shop.progPath, half);
  CHECK(client.labels(shop.progPath, 2, 22) == std::vector<std::string>{"X", "G"});
  CHECK(client.labels(shop.progPath, 2, 4).empty()); // inside of a text that is printed
  CHECK(has(client.labels(shop.progPath, 2, 26), "EOL"));
  const Json actions = client.result("textDocument/codeAction", all(shop.progPath));
  const bool repairs = std::any_of(actions.begin(), actions.end(), [](const Json& one) {
    return one["title"].get<std::string>().find("write `'X'`") != std::string::npos;
  });
  CHECK_MESSAGE(repairs, actions.dump());
  client.open(shop.progPath, shop.prog);

  // From a macro: the dialog, the macros of the folder and the line of the post that prints this cycle.
  client.open(shop.macroPath, shop.macro);
  const Json uses = client.result("textDocument/references", at(shop.macroPath, 0, 36));
  std::size_t posts = 0;
  for (const Json& one : uses) {
    CHECK(one["uri"].get<std::string>().find("/top/") == std::string::npos);
    if (one["uri"] != uriOf(shop.progPath)) continue;
    ++posts;
    CHECK(one["range"]["start"]["line"] == 2);
  }
  CHECK(posts == 1);
  CHECK(hover(client, shop.macroPath, 0, 36).find("Reach [mm]") != std::string::npos);
  const std::string checks = "call \"Checks\"\n";
  const std::string checksPath = (shop.folder / "side/CycleData.mac").string();
  client.open(checksPath, checks);
  const Json file = client.result("textDocument/definition", at(checksPath, 0, 8));
  REQUIRE(file.size() == 1);
  CHECK(file[0]["uri"].get<std::string>().ends_with("/side/Checks.mac"));
}

TEST_CASE("lsp: fields of DefineData, words of dialogs and macros") {
  const Shop shop("lsp-words");
  Client client;
  const std::string data = "X = 10\nG = 54\n";
  client.open(shop.define, data);
  CHECK(hover(client, shop.define, 0, 0).find("10 at first") != std::string::npos);
  CHECK(hover(client, shop.define, 0, 0).find("Reach [mm]") != std::string::npos);
  client.open(shop.macroPath, shop.macro);
  const auto words = client.labels(shop.macroPath, 0, 0);
  for (const char* word :
       {"X", "G", "if", "get_op_data", "add_custom_drill_cycle_path", "callback_op", "sin"})
    CHECK_MESSAGE(has(words, word), word);
  const std::string dialog = tests::readAll(shop.folder / "side/CycleData.dlg");
  const std::string dialogPath = (shop.folder / "side/CycleData.dlg").string();
  client.open(dialogPath, dialog);
  const auto controls = client.labels(dialogPath, 3, 0);
  CHECK(has(controls, "input"));
  CHECK(has(controls, "dropdown_new"));
  CHECK_FALSE(has(controls, "get_op_data"));
  CHECK(hover(client, dialogPath, 2, 1).find("INPUT") != std::string::npos);
  client.open(shop.progPath, shop.prog);
  const auto post = client.labels(shop.progPath, 7, 0);
  for (const char* word : {"SpinOff", "OpFieldData#('", "CycleType?('", "probe", "IF"})
    CHECK_MESSAGE(has(post, word), word);
  CHECK(post.size() > 25);
}

TEST_CASE("lsp: what commands read and fill") {
  const TestFolder folder("lsp-commands");
  folder.write("side/DefineData.txt", "X = 10\n");
  folder.write("side/CycleData.dlg", "");
  const std::string text = "get_op_data CALLBACK_OP, TOOL_NUM, t\nget_tool_data t, mtool_radius, ball\n"
                           "if X < ball then message \"too near\"\nget_tool_data t, \n";
  const std::string macro = folder.write("side/CycleData.mac", text);
  Client client;
  client.open(macro, text);
  CHECK(hover(client, macro, 1, 20).find("**mtool_radius** parameter of `tool_data`: number") !=
        std::string::npos);
  CHECK(hover(client, macro, 1, 20).find("--host tool_radius=VALUE") != std::string::npos);
  CHECK(hover(client, macro, 2, 8).find("first set in line 2 of CycleData.mac:\n\n    get_tool_data t") !=
        std::string::npos);
  const Json definition = client.result("textDocument/definition", at(macro, 2, 8));
  REQUIRE(definition.size() == 1);
  CHECK(definition[0]["range"]["start"]["line"] == 1);
  const auto words = client.labels(macro, 3, 17);
  CHECK(has(words, "MTOOL_RADIUS"));
  CHECK_FALSE(has(words, "if"));
  CHECK(has(client.labels(macro, 3, 14), "X"));
}

TEST_CASE("lsp: programs of the folder are completed, found and explained") {
  const TestFolder folder("lsp-own");
  const std::string called =
      folder.write("O9900.nc", "%\nO9900(BORE OF OURS)\nIF[#7EQ#0]THEN#3000=1(D MISSING)\n"
                               "#30=#7\nG0Z#26\nM99\n%\n");
  const std::string text = "%\nO1(MAIN)\nG65P9900D5.\nG65P\nG65P9900\nM98P\nM30\n%\n";
  const std::string path = folder.write("O1.nc", text);
  Client client;
  client.open(path, text);
  CHECK(client.labels(path, 3, 4).front() == "P9900");
  CHECK(client.labels(path, 5, 4) == std::vector<std::string>{"P9900"});
  const std::string typed = "%\nO1(MAIN)\nG65P9900 \nM30\n%\n";
  client.open(path, typed);
  CHECK(client.labels(path, 2, 9) == std::vector<std::string>{"D", "Z"});
  client.open(path, text);
  const Json definition = client.result("textDocument/definition", at(path, 2, 5));
  REQUIRE(definition.size() == 1);
  CHECK(definition[0]["uri"] == uriOf(called));
  CHECK(hover(client, path, 2, 5).find("BORE OF OURS") != std::string::npos);
}

TEST_CASE("lsp: calls of the cycle language know the parameters and results of the cycle beside them") {
  const TestFolder folder("lsp-calls");
  const std::string own =
      folder.write("bore.cycle", "cycle bore \"Bore of ours\"\n\nparameter wide : length \"Width\"\n"
                                 "parameter deep : length = 5 mm\n\nresult middle : length\n\n"
                                 "probe on\ntouch x by wide -> right\nmiddle = right.at\n");
  const std::string text =
      "cycle two \"Two\"\n\ncall bore wide = 3 mm -> first\ncall bore \ncall bore wide = 2 mm, \n"
      "run_x = first.\ncall \ntouch x by 3 mm -> side\nrun_y = side.\n";
  const std::string path = folder.write("two.cycle", text);
  Client client;
  client.open(path, text);
  CHECK(client.labels(path, 3, 10) == std::vector<std::string>{"wide", "deep"});
  CHECK(client.labels(path, 4, 23) == std::vector<std::string>{"deep"});
  CHECK(client.labels(path, 5, 14) == std::vector<std::string>{"middle"});
  CHECK(client.labels(path, 8, 13) == std::vector<std::string>{"at", "error"});
  CHECK(client.labels(path, 6, 5).front() == "bore");
  const Json definition = client.result("textDocument/definition", at(path, 2, 6));
  REQUIRE(definition.size() == 1);
  CHECK(definition[0]["uri"] == uriOf(own));
  CHECK(hover(client, path, 2, 6).find("Bore of ours") != std::string::npos);
}

TEST_CASE("lsp: Mikroprog: codes, parameters, block numbers") {
  const TestFolder folder("lsp-suf");
  const std::string text =
      "N10 G0 X10.000 Z5.000 ;START\nN20 P1=12 ;DEPTH\nN30 G26 L60\nN40 G1 ZP1 F5\nN60 M30\n";
  const std::string path = folder.write("a.suf", text);
  Client client;
  client.open(path, text);
  CHECK(hover(client, path, 3, 8).find("`P1=12` in N20: DEPTH") != std::string::npos);
  CHECK(hover(client, path, 1, 5).find("**P1**") != std::string::npos);
  CHECK(has(client.labels(path, 2, 5), "G26"));
  CHECK(client.labels(path, 2, 9).front() == "L10");
  std::vector<std::string> symbols; // blocks with a comment, and those that something jumps to
  for (const Json& one : client.result("textDocument/documentSymbol", all(path)))
    symbols.push_back(one["name"]);
  CHECK(symbols == std::vector<std::string>{"N10", "N20", "N60"});
  CHECK(has(client.labels(path, 3, 9), "P1"));
  Json params = at(path, 4, 1);
  params["newName"] = "600";
  const Json edits = client.result("textDocument/rename", params)["changes"][uriOf(path)];
  REQUIRE(edits.size() == 2);
  CHECK(edits[0]["newText"] == "L600");
  CHECK(edits[1]["newText"] == "N600");
  params["newName"] = "40";
  CHECK(client.ask("textDocument/rename", params).contains("error"));
}

TEST_CASE("lsp: a cycle and the post that dotek.toml names are checked together") {
  const Shop shop("lsp-together");
  Client client;
  // The post asks for a field that the cycle has not, and leaves the work system out.
  std::string prog = shop.prog;
  prog.replace(prog.find("#('X')"), 6, "#('Z')");
  const Json missing = client.open(shop.progPath, prog);
  CHECK_MESSAGE(has(codes(missing), "field-not-defined"), missing.dump());
  const std::string define = "X = 10\nG = 54\n";
  const Json unused = client.open(shop.define, define);
  CHECK_MESSAGE(has(codes(unused), "field-never-printed"), unused.dump());

  // A field that the cycle gets, and the post that prints the system.
  const std::string wider = "X = 10\nG = 54\nZ = 1\n";
  client.note("textDocument/didChange", {{"textDocument", {{"uri", uriOf(shop.define)}, {"version", 2}}},
                                         {"contentChanges", {{{"text", wider}}}}});
  client.findings(shop.define);
  client.note("textDocument/didChange", {{"textDocument", {{"uri", uriOf(shop.progPath)}, {"version", 2}}},
                                         {"contentChanges", {{{"text", prog + "\n"}}}}});
  const Json now = client.findings(shop.progPath);
  CHECK_MESSAGE(!has(codes(now), "field-not-defined"), now.dump());
  std::string printed = prog;
  printed.insert(printed.find(" EOL"), " 'G'OpFieldData#('G')");
  client.note("textDocument/didChange", {{"textDocument", {{"uri", uriOf(shop.progPath)}, {"version", 3}}},
                                         {"contentChanges", {{{"text", printed}}}}});
  // What is found in the cycle changes with the post.
  for (const Json& one : client.findings(shop.define))
    CHECK_MESSAGE((one["code"] != "field-never-printed" || one["range"]["start"]["line"] != 1), one.dump());
}

TEST_CASE("lsp: a text of a few letters is what the editor says, or its name") {
  const TestFolder folder("lsp-young");
  struct Young {
    const char* file;
    const char* language;
    const char* text;
  };
  for (const Young& one : {Young{"a.suf", "dotek-mikroprog", "N"}, Young{"b.suf", "", "\xC5\xAF"},
                           Young{"c.cps", "javascript", "description"}, Young{"d.nc", "dotek-macrob", "O"},
                           Young{"e.txt", "dotek-compost", "a:"}, Young{"f.txt", "dotek-compost", "IF"},
                           Young{"g.cycle", "dotek-cycle", "cy"}, Young{"h.mac", "dotek-gibbs", "x"}}) {
    const std::string path = folder.write(one.file, one.text);
    Client client;
    CAPTURE(one.file);
    for (const Json& finding : client.open(path, one.text, one.language))
      CHECK(finding["code"] != "unknown-kind");
  }
  // What tells what it is, is that.
  const std::string text = "%\nO1\nG0 X1.\nM30\n%\n";
  const std::string path = folder.write("z.txt", text);
  Client client;
  CHECK(codes(client.open(path, text, "plaintext")).empty());
}

TEST_CASE("lsp: arguments of a program of the shop are what its comments say") {
  const TestFolder folder("lsp-own-macro");
  folder.write("O0002.nc",
               "O2(BORE)\n(A #1  DEPTH     MM   GIVE)\n(  D  NOMINAL DIAMETER, MM)\n#100=#1+#7\nM99\n");
  const std::string text = "O1\nG65 P2 A1. D2. E3.\nM30\n";
  const std::string path = folder.write("O0001.nc", text);
  Client client;
  client.open(path, text);
  CHECK(hover(client, path, 1, 8).find("DEPTH") != std::string::npos);
  CHECK(hover(client, path, 1, 12).find("NOMINAL DIAMETER, MM") != std::string::npos);
  CHECK(hover(client, path, 1, 16).find("`#8`") != std::string::npos);
  std::vector<std::string> labels;
  for (const Json& hint : client.result("textDocument/inlayHint", all(path)))
    labels.push_back(hint["label"]);
  CHECK(labels == std::vector<std::string>{"depth:", "nominal diameter:"});
  CHECK(hover(client, path, 1, 5).find("O0002.nc") != std::string::npos);
}

TEST_CASE("lsp: what is offered for two findings of a line alike is offered once") {
  const TestFolder folder("lsp-alike");
  const std::string text = "N10 G83\nN30 M30\n";
  const std::string path = folder.write("a.suf", text);
  Client client;
  CHECK(codes(client.open(path, text)).size() > 1);
  std::vector<std::string> titles;
  for (const Json& action : client.result("textDocument/codeAction", all(path))) {
    titles.push_back(action["title"]);
    if (titles.back() == "Ignore suf-address-missing in this line") CHECK(action["diagnostics"].size() == 2);
  }
  CHECK(std::count(titles.begin(), titles.end(), "Ignore suf-address-missing in this line") == 1);
  CHECK(std::count(titles.begin(), titles.end(), "Explain suf-address-missing") == 1);
}

TEST_CASE("lsp: the repair that a message of a cycle states is offered") {
  const TestFolder folder("lsp-repairs");
  const std::string text = "cycle side \"Side\"\n\nparameter reach : lenght = 10 mm \"Reach\"\n"
                           "result size : length \"Size\"\n\nspindle off\nprobe on\n"
                           "touch x by 5 -> right\nsize = rght.at - right.att + sqr(2)\n"
                           "size = right + 1 mm\nprobe off\n";
  const std::string path = folder.write("side.cycle", text);
  Client client;
  client.open(path, text);
  std::vector<std::string> titles;
  for (const Json& action : client.result("textDocument/codeAction", all(path)))
    if (action["kind"] == "quickfix") titles.push_back(action["title"]);
  for (const char* wanted :
       {"write `length`", "add `mm`", "write `right`", "write `at`", "write `sqrt`", "write `right.at`"})
    CHECK_MESSAGE(
        std::any_of(titles.begin(), titles.end(),
                    [&](const std::string& title) { return title.find(wanted) != std::string::npos; }),
        wanted);
}
