// Renaming refuses what would make another program of the text.
#include "tests/LspClient.h"
#include "tests/TestFolder.h"

using namespace dotek;
using namespace dotek::tests::editor;
using dotek::tests::TestFolder;

namespace {

struct Text {
  TestFolder folder;
  Client client;
  std::string path;
  Text(const std::string& name, const std::string& file, const std::string& text) : folder(name) {
    path = folder.write(file, text);
    client.open(path, text);
  }
  // Places that change; 0: refused, and why.
  std::size_t rename(int line, int character, const char* name) {
    Json params = at(path, line, character);
    params["newName"] = name;
    const Json answer = client.ask("textDocument/rename", params);
    why = answer.contains("error") ? answer["error"]["message"].get<std::string>() : "";
    return answer.contains("error") ? 0 : answer["result"]["changes"][uriOf(path)].size();
  }
  std::string why;
};

} // namespace

TEST_CASE("lsp: a label gets no name that another label or the language has, in any case") {
  Text text("lsp-rename-label", "c/CycleData.mac",
            "x = 1\n:ask\nx = x + 1\nif x < 5 then goto ask\n:done\nif x < 9 then goto done\n");
  for (const char* taken : {"done", "DONE", "Done"}) {
    CAPTURE(taken);
    CHECK(text.rename(1, 2, taken) == 0);
    CHECK(text.why.find("in use") != std::string::npos);
  }
  for (const char* word : {"then", "GOTO", "if", "Dialog"}) {
    CAPTURE(word);
    CHECK(text.rename(1, 2, word) == 0);
    CHECK(text.why.find("word of the language") != std::string::npos);
  }
  CHECK(text.rename(1, 2, "again") == 2);
  CHECK(text.rename(1, 2, "Ask") == 2); // the same label in other letters
}

TEST_CASE("lsp: a block number is a number, whatever zeros begin it") {
  Text text("lsp-rename-block", "O1.nc", "O1\n#1=0\nN10 #1=#1+1\nIF[#1 LT 5]GOTO 10\nGOTO 20\nN20 M30\n");
  for (const char* taken : {"20", "020", "0020"}) {
    CAPTURE(taken);
    CHECK(text.rename(3, 17, taken) == 0);
    CHECK(text.why.find("in use") != std::string::npos);
  }
  for (const char* none : {"0", "00", "10000", "999999999999", "-5", "1.5"}) {
    CAPTURE(none);
    CHECK(text.rename(3, 17, none) == 0);
  }
  CHECK(text.rename(3, 17, "9999") == 2); // of the 0i-MD, the control of a text without one
}

TEST_CASE("lsp: a routine gets no name of the language or of another routine") {
  Text text("lsp-rename-routine", "post.txt",
            "probe:\nIF CycleType?('a')\n helper\nEND\nRETURN\nhelper:\n SeqC 'M1' EOL\nRETURN\nother:\n "
            "'M2' EOL\nRETURN\n");
  for (const char* taken :
       {"RETURN", "IF", "END", "EOL", "SeqC", "SpinOff", "seqc", "other", "OTHER", "probe"}) {
    CAPTURE(taken);
    CHECK(text.rename(2, 2, taken) == 0);
  }
  CHECK(text.rename(2, 2, "optional_stop") == 2);
}

TEST_CASE("lsp: a name of a cycle is none of the language") {
  Text text("lsp-rename-cycle", "two.cycle",
            "cycle two \"Two\"\n\nresult r : length\n\nrun_x = 1 mm\nrun_x = run_x + 1 mm\nr = run_x\n");
  for (const char* taken : {"if", "touch", "then", "end", "x", "mm", "start", "ball_radius", "Run", "r"}) {
    CAPTURE(taken);
    CHECK(text.rename(4, 1, taken) == 0);
  }
  CHECK(text.rename(4, 1, "reach") == 4);
}

TEST_CASE("lsp: a common variable is found in the programs beside the text, and in no other folder") {
  const TestFolder folder("lsp-common");
  const std::string first = "O1\n#101=5\nG65 P2\nM30\n";
  const std::string path = folder.write("one/O0001.nc", first);
  const std::string beside = folder.write("one/O0002.nc", "O2\n#102=#101\nM99\n");
  const std::string elsewhere = "O3\n#101=7\nM99\n";
  const std::string other = folder.write("two/O0003.nc", elsewhere);
  Client client;
  client.open(path, first);
  client.open(other, elsewhere);
  Json params = at(path, 1, 2);
  params["context"] = {{"includeDeclaration", true}};
  const Json found = client.result("textDocument/references", params);
  REQUIRE(found.size() == 2);
  CHECK(found[0]["uri"] == uriOf(path));
  CHECK(found[1]["uri"] == uriOf(beside));
}
