// Texts of names in UTF-8 and in the encodings of the languages.
#include "tests/LspClient.h"
#include "tests/TestFolder.h"

using namespace dotek;
using namespace dotek::tests::editor;
using dotek::tests::TestFolder;

TEST_CASE("lsp: symbols keep the accents of an editor's text") {
  const TestFolder folder("lsp-accents");
  Client client;
  const auto symbols = [&](const std::string& name, const std::string& text) {
    const std::string path = folder.write(name, text);
    client.open(path, text);
    return client.result("textDocument/documentSymbol", at(path, 0, 0)).dump();
  };
  const std::string word = "M\xC4\x9A\xC5\x98"
                           "EN\xC3\x8D";
  CHECK(symbols("O1.nc", "%\nO1 (" + word + ")\nG0 X1.\nN10 G0 Z5. (" + word + " Z)\nM99\n%\n")
            .find(word + " Z") != std::string::npos);
  CHECK(symbols("a.suf", "N10 G00 X10.000 Z5.000 ;" + word + "\nN20 M30\n").find(word) != std::string::npos);
  CHECK(symbols("side/CycleData.dlg", "DIALOG \"" + word + "\", 10, 10, 300, 200\nLABEL \"" + word +
                                          "\", 5, 5, 50, 20\nOK \"OK\", 5, 50, 50, 20\n")
            .find(word) != std::string::npos);
}
