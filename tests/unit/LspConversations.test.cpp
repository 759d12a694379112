// Conversations of editors (tests/conversations), and random edits in all languages.
#include "driver/Driver.h"
#include "support/Version.h"
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"
#include "tests/Goldens.h"
#include "tests/LspClient.h"
#include "tests/TestFolder.h"

#include <algorithm>
#include <filesystem>
#include <random>
#include <sstream>

using namespace dotek;
using namespace dotek::tests::editor;
using dotek::tests::TestFolder;

namespace fs = std::filesystem;

namespace {

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

// What the server says to each message, when it has time to check after each.
std::string answers(const fs::path& file, const std::string& root) {
  lsp::Server server("");
  std::string out;
  std::istringstream lines(tests::readAll(file));
  for (std::string line; std::getline(lines, line);) {
    const Json message = Json::parse(replaced(line, "@ROOT@", root));
    out += "> " + message.value("method", "answer") + "\n";
    std::vector<Json> said = server.receive(message.dump());
    for (Json& one : server.idle())
      said.push_back(std::move(one));
    for (const Json& one : said)
      out += one.dump() + "\n";
  }
  CHECK(server.ended());
  CHECK(server.shutDown());
  return replaced(replaced(out, root, "@ROOT@"), std::string(kVersion), "@VERSION@");
}

} // namespace

TEST_CASE("lsp: conversations of editors") {
  const fs::path root = tests::root() / "tests/conversations";
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(root))
    if (entry.path().extension() == ".jsonl") files.push_back(entry.path());
  CHECK(files.size() >= 3);
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    const TestFolder folder("lsp-conversation");
    fs::path expected = file;
    expected.replace_extension(".out");
    const std::string differs = tests::settle({root, expected, ""}, answers(file, folder.path().string()),
                                              tests::settings().update, tests::settings().rewritten);
    CHECK_MESSAGE(differs.empty(), file.string(), ": ", differs);
  }
}

namespace {

struct Language {
  const char* name;
  const char* text;
  std::vector<const char*> pieces;
};

const std::vector<Language>& languages() {
  static const std::vector<Language> kLanguages = {
      {"O7301.nc",
       "%\nO7301(VICE)\nIF[#24EQ#0]GOTO40\nG65P9811X#24S54.\n#520=#5061\nN40M99\n%\n",
       {"G1X", "#", "[", "]", "GOTO", "N40", "IF[#1EQ#0]", "G65P9811", "10.", "%", "O", "(", "M99", "END1"}},
      {"mer.suf",
       "N10 G0 X10.000 Z5.000 ;start\nN20 P90=P90+1\nN30 G26 L60\nN40 M25 @MER.SOU\nN50 G31 Z-5.000 F6\nN60 "
       "M30\n",
       {"N", "G0", "P90", "L60", ";", "@", "X1.5", "=", "+"}},
      {"reach.cycle",
       "cycle reach \"How far\"\n\nparameter depth : length = 3 mm \"How deep\"\nresult found : length\n\n"
       "probe on\ntouch z by -depth -> floor\nfound = floor.at\nif found > 1 mm then\n  alarm \"Far\"\nend\n",
       {"\"", "call bore ", "->", "mm", "if ", "then", "end", ".", "parameter ", "= ", "(", ")"}},
      {"near.mac",
       "op = callback_op\nif X < 1 then message \"near\"\nfor i = 1 to 3\nX = X + i\nnext i\ngoto "
       "out\n:out\n",
       {"if ", "then ", "goto ", ":", "\"", "for ", "next ", "call \"a\"", "get_op_data ", ",", "[", "]",
        "!"}},
      {"ask.dlg",
       "dialog \"Ask\", 0, 0, 300, 200\nlabel 20, 20, 60, 24, \"X\"\ninput 90, 20, 60, 24, X, X\nok 20, 90, "
       "60, 24\n"
       "cancel 90, 90, 60, 24\n",
       {"input ", "label ", "\"", ",", "20", "ok ", "!", "X"}},
      {"DefineData.txt", "! fields\nX = 10\nG = 54\nDEPTH = -2.5\n", {"=", "X", "1", "-", "!", "."}},
      {"post.txt",
       "{ post }\n#1 = '###.##;0'\nFORMAT(OpFieldData#,1)\nprobe:\nIF CycleType?('side')\n SeqC SpinOff EOL\n"
       " SeqC ' G1X'OpFieldData#('X') EOL\nEND\nRETURN\n",
       {"IF ", "END\n", "'", "{", "}", "RETURN\n", "EOL", "OpFieldData#('", "clear:\n", "AND ", "NOT "}},
      {"mill.cps",
       "description = \"Mill\";\nextension = \"nc\";\nvar format = createFormat({decimals: 3});\n"
       "function onOpen() {\n  writeln(\"%\");\n}\nfunction onSection() {\n  var z = format.format(1);\n  "
       "writeln(z);\n}\n",
       {"{", "}", "(", ")", "var ", "=", ";", "function f", "\"", "z"}},
  };
  return kLanguages;
}

// Code and line of each finding in the file, or in no file: of lint of the file, or the folder of its cycle.
std::vector<std::string> fresh(const std::string& path) {
  driver::LintOptions options;
  options.paths = {lsp::Workspace::unitOf(path)};
  const driver::Outcome found = driver::lint(options);
  std::vector<std::string> out;
  for (const Diagnostic& one : found.diagnostics.all()) {
    const std::string where = one.range.hasPlace() ? found.sources.file(one.range.file).name() : "";
    if (where == path)
      out.push_back(std::string(one.code) + " " + std::to_string(found.sources.line(one.range) - 1));
    else if (where.empty() || where == options.paths.front())
      out.push_back(std::string(one.code) + " 0");
  }
  return out;
}

std::string listed(const std::vector<std::string>& all) {
  std::string out;
  for (const std::string& one : all)
    out += (out.empty() ? "" : ", ") + one;
  return out;
}

std::vector<std::string> codesAndLines(const Json& findings) {
  std::vector<std::string> out;
  for (const Json& one : findings)
    out.push_back(one["code"].get<std::string>() + " " + one["range"]["start"]["line"].dump());
  return out;
}

} // namespace

// In bursts, as somebody types: after each the findings are those of lint of the text.
TEST_CASE("lsp: 10,000 random edits in all languages") {
  constexpr const char* kMethods[] = {"hover",      "definition",     "references", "documentHighlight",
                                      "completion", "documentSymbol", "codeLens",   "prepareRename"};
  std::mt19937 random(31);
  const int edits = tests::draws(10000, 400) / static_cast<int>(languages().size());
  for (const Language& language : languages()) {
    const TestFolder folder("lsp-edits");
    CAPTURE(language.name);
    const std::string original = language.text;
    std::string text = original;
    const std::string path = folder.write(language.name, text);
    Client client;
    client.open(path, text);
    for (int edit = 0; edit < edits;) {
      const int burst = 1 + static_cast<int>(random() % 5);
      if (random() % 8 == 0 || text.size() > 2000) { // the text as it was
        text = original;
        client.note("textDocument/didChange", {{"textDocument", {{"uri", uriOf(path)}, {"version", edit}}},
                                               {"contentChanges", {{{"text", text}}}}});
      }
      for (int i = 0; i < burst; ++i, ++edit) {
        const auto size = static_cast<std::uint32_t>(text.size());
        const auto begin = static_cast<std::uint32_t>(random() % (size + 1));
        const auto end = std::min(size, begin + static_cast<std::uint32_t>(random() % 4));
        const SourceFile file("x", text, Encoding::Utf8);
        const Json start = lsp::positionOf(file, begin, lsp::Units::Utf16),
                   stop = lsp::positionOf(file, end, lsp::Units::Utf16);
        const auto from = lsp::offsetOf(text, start, lsp::Units::Utf16),
                   to = lsp::offsetOf(text, stop, lsp::Units::Utf16);
        REQUIRE((from && to));
        std::string piece = language.pieces[random() % language.pieces.size()];
        const auto kind = random() % 8;
        if (kind == 0) piece = "\n";
        if (kind == 1) piece = "\xC4\x8D";
        if (kind == 2) piece = original.substr(random() % original.size(), random() % 30);
        if (kind == 3) piece = "";
        client.note("textDocument/didChange",
                    {{"textDocument", {{"uri", uriOf(path)}, {"version", edit + 2}}},
                     {"contentChanges", {{{"range", {{"start", start}, {"end", stop}}}, {"text", piece}}}}});
        text.replace(*from, *to - *from, piece);
      }
      const auto found = codesAndLines(client.findings(path));
      folder.write(language.name, text);
      const auto expected = fresh(path);
      CHECK_MESSAGE(found == expected, text, "\nfound ", listed(found), "\nexpected ", listed(expected));
      Json place = at(path, static_cast<int>(random() % 12), static_cast<int>(random() % 30));
      place["context"] = {{"includeDeclaration", true}};
      client.ask(std::string("textDocument/") + kMethods[random() % std::size(kMethods)], place);
      if (random() % 10 == 0) client.ask("textDocument/formatting", place);
      if (random() % 10 == 0) client.ask("textDocument/codeAction", all(path));
    }
  }
}
