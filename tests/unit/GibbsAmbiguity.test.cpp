// The grammar has one reading for every line: exact ambiguity detection reports nothing.
#include "tests/GoldenRunner.h"
#include "tests/unit/GibbsHarness.h"

#include "GibbsMacroLexer.h"
#include "GibbsMacroParser.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::tests;

namespace {

class Listener final : public antlr4::BaseErrorListener {
public:
  int reports = 0;
  void reportAmbiguity(antlr4::Parser*, const antlr4::dfa::DFA&, std::size_t, std::size_t, bool,
                       const antlrcpp::BitSet&, antlr4::atn::ATNConfigSet*) override {
    ++reports;
  }
};

int ambiguities(const std::string& text, int kind) {
  antlr4::ANTLRInputStream input(text);
  grammar::GibbsMacroLexer lexer(&input);
  antlr4::CommonTokenStream tokens(&lexer);
  grammar::GibbsMacroParser parser(&tokens);
  Listener listener;
  parser.removeErrorListeners();
  parser.addErrorListener(&listener);
  parser.getInterpreter<antlr4::atn::ParserATNSimulator>()->setPredictionMode(
      antlr4::atn::PredictionMode::LL_EXACT_AMBIG_DETECTION);
  while (tokens.LA(1) != antlr4::Token::EOF) {
    const std::size_t before = tokens.index();
    if (kind == 0) parser.line();
    if (kind == 1) parser.controlLine();
    if (kind == 2) parser.definitionLine();
    if (tokens.index() == before) parser.consume();
  }
  return listener.reports;
}

} // namespace

TEST_CASE("gibbs: the grammar is not ambiguous") {
  CHECK(ambiguities("a = -(b-1)*2/c(3)+d[4]\nif (a) < (b) and not (c = 1) or ((d) > 2), then if e = 1 then f "
                    "(1), 2 else g\n"
                    "call a.b\\c, 1\ncall d$\ncall lib\n#include x.mac\n#include y\n:next\nfor:\nnext\nnext "
                    "to\ncall (1) = 2\n"
                    "for to = to to to step step\nadd_ path feed_ x, a_\nfoo (1)\nfoo(1) = 2\nto = 1\n[\n] "
                    "else [\nelse b = 1\n",
                    0) == 0);
  CHECK(ambiguities("set_state a = 1, b, hide\nframe 1,2,3,4, some 2 words\ninput 1, 2, 3, 4, next, -(to)\n",
                    1) == 0);
  CHECK(ambiguities("a = 1\nto = -2\nb$ = \"x\"\n", 2) == 0);
  std::filesystem::path folder;
  if (!haveCorpus(folder)) return;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "gibbs")) {
    if (!entry.is_regular_file()) continue;
    const std::string suffix = entry.path().extension().string();
    CHECK(ambiguities(readAll(entry.path()), suffix == ".mac" ? 0 : suffix == ".dlg" ? 1 : 2) == 0);
  }
}
