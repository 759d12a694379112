#include "ComPostHelper.h"
#include "tests/GoldenRunner.h"

#include <doctest/doctest.h>

#include <string>

using namespace dotek;
using namespace dotek::tests;
using namespace dotek::frontend::compost;

TEST_CASE("a routine is the same in one line, in CR LF, in CR and with comments everywhere") {
  const std::string text =
      "go:\nIF Flag?('f') AND Ready?\nSeq 'a'Num#('d')''EOL\nELSE\nIF Other? {nothing}\nEND\nEND\nRETURN\n";
  const Prog plain(text);
  CHECK(plain.diagnostics.empty());
  CHECK(!plain.program.hasErrorNodes);
  std::string expected = plain.shape();
  expected.erase(expected.find("  comment"));
  const auto variant = [&](const std::string& lineEnd, const std::string& blank) {
    std::string changed;
    for (const char c : text)
      changed += c == '\n' ? lineEnd : c == ' ' ? blank : std::string(1, c);
    Prog prog(changed);
    CHECK(prog.diagnostics.empty());
    std::string shape = prog.shape();
    if (shape.find("  comment") != std::string::npos) shape.erase(shape.find("  comment"));
    CHECK(shape == expected);
  };
  variant("\r\n", " ");
  variant("\r", "\t");
  variant(" ", "\t \t");
  variant("{x}\n{y 'it' \n z}", " {c} ");
}

TEST_CASE("the tree keeps words, kinds, texts and places") {
  const Prog prog(
      "FORMAT ( Num# , 7 )\n# 7='##.#'\nx1: {why}\n  Aa('b','c') D#('e')'' 'q''r' EOL F?\nRETURN");
  CHECK(prog.diagnostics.empty());
  CHECK(prog.dump() == "program\n"
                       "  1:1-1:20 format Num# picture 7\n"
                       "  2:1-2:11 picture 7 '##.#'\n"
                       "  3:1-5:7 routine x1\n"
                       "    4:3-4:14 command Aa 'b' 'c'\n"
                       "    4:15-4:22 numeric D# 'e'\n"
                       "    4:22-4:24 literal ''\n"
                       "    4:25-4:28 literal 'q'\n"
                       "    4:28-4:31 literal 'r'\n"
                       "    4:32-4:35 end-of-line\n"
                       "    4:36-4:38 boolean F?\n"
                       "    5:1-5:7 return\n"
                       "  3:5-3:10 comment\n");
  CHECK(prog.program.comments.at(0).text == "why");
}

TEST_CASE("conditions: chains, brackets, NOT") {
  const Prog prog("a: IF NOT (A? OR B?) AND NOT NOT C?('x') END RETURN");
  CHECK(prog.diagnostics.empty());
  CHECK(
      prog.shape() ==
      "program\n  routine a\n    if\n      condition\n        not\n        condition\n          boolean A?\n"
      "          or\n          boolean B?\n        and\n        not\n        not\n        boolean C? 'x'\n"
      "      then\n    return\n");
}

TEST_CASE("one slip gives one error, and the routine goes on") {
  const auto one = [](const std::string& slip, const std::string& finding) {
    CAPTURE(slip);
    Prog prog("a: 'x' EOL\n" + slip + "\nIF Q? 'in' END Last EOL RETURN\nb: a RETURN\n");
    CHECK(prog.only() == finding);
    CHECK(prog.program.hasErrorNodes);
    const std::string shape = prog.shape();
    CHECK(shape.find("command Last") != std::string::npos);
    CHECK(shape.find("routine b") != std::string::npos);
    CHECK(shape.find("without end") == std::string::npos);
  };
  one(")", "2:1 syntax-error");
  one("(", "2:1 syntax-error");
  one("'q' ('r')", "2:5 syntax-error");
  one(",", "2:1 syntax-error");
  one("=", "2:1 syntax-error");
  one("X = 5", "2:3 syntax-error");
  one("12", "2:1 syntax-error");
  one("@", "2:1 unexpected-character");
  one("\xC2\xA0 EOL", "2:1 unexpected-character");
  one("a \xE2\x82\xAC $ %", "2:3 unexpected-character");
  one("}", "2:1 unexpected-character");
  one("END", "2:1 end-without-if");
  one("ELSE", "2:1 else-without-if");
  one("IF A? ELSE ELSE END", "2:12 else-without-if");
  one("IF A? ELSE: EOL END", "2:11 syntax-error");
  one("EOL:", "2:4 syntax-error");
  one("AND A?", "2:1 syntax-error");
  one("'x' OR A?('f')", "2:5 syntax-error");
  one("NOT A?", "2:1 syntax-error");
  one("IF EOL END", "2:1 syntax-error");
  one("IF 'x' END", "2:1 syntax-error");
  one("IF A? AND 'x' END", "2:7 syntax-error");
  one("IF (A? 'x' END", "2:4 syntax-error");
  one("IF ( ) END", "2:4 syntax-error");
  one("IF Num# > 3 END", "2:4 condition-not-boolean");
  one("IF Word('x') END", "2:4 condition-not-boolean");
  one("Num#('x' 'y' EOL", "2:5 syntax-error");
  one("Num#('x' 'y') EOL", "2:5 syntax-error");
  one("IF A?('x' SetFlag('y') END", "2:6 syntax-error");
  one("Word(x) EOL", "2:6 syntax-error");
  one("Word(-5.2) EOL", "2:6 syntax-error");
  one("Word() EOL", "2:6 syntax-error");
  one("Word(,'x')", "2:6 syntax-error");
  one("Word((('x')))", "2:6 syntax-error");
  one("Word(IF A? END", "2:5 syntax-error");
  one("'open EOL", "2:1 unterminated-text");
  one("Word('open) EOL", "2:6 unterminated-text");
  one("SeqC ' Z'D#('a') F200' EOL", "2:22 unterminated-text");
  one("name : 'x'", "2:6 syntax-error");
  one("#3 '##'", "2:1 syntax-error");
  one("#3 = EOL", "2:1 syntax-error");
  one("#99999999999 = '#'", "2:1 syntax-error");
  one("FORMAT EOL", "2:1 syntax-error");
  one("FORMAT('N#',3)", "2:8 syntax-error");
  one("FORMAT(N#,'3')", "2:11 syntax-error");
  one("FORMAT(N#)", "2:1 syntax-error");
  one("FORMAT(N#,3 EOL", "2:7 syntax-error");
}

TEST_CASE("quotes of a word processor give one error a line") {
  Prog utf8("a:\n\xE2\x80\x98 G1 (x) #1\xE2\x80\x99 EOL W(\xE2\x80\x9Cq\xE2\x80\x9D) \xE2\x80\x9E\n'ok' "
            "EOL\n'half\xE2\x80\x99 EOL\nRETURN");
  CHECK(utf8.only() == "2:1 typographic-quote, 4:1 typographic-quote");
  Prog cp1250("a:\n\x91 G1\x92 EOL W(\x84q\x94)\n'ok' EOL RETURN", Encoding::Cp1250);
  CHECK(cp1250.only() == "2:1 typographic-quote");
  Prog inText("a: 'don\xE2\x80\x99t' EOL RETURN");
  CHECK(inText.only() == "");
}

TEST_CASE("comments that are not closed, braces in comments") {
  Prog lost("a: 'x' EOL RETURN\nb: IF A? { lost EOL END RETURN\nc: RETURN");
  CHECK(lost.only() == "2:10 unterminated-comment");
  Prog nested("a: { x { y } RETURN");
  CHECK(nested.only() == "");
  CHECK(!nested.program.hasErrorNodes);
}

TEST_CASE("an IF that is open at RETURN is repaired before it") {
  Prog prog("a:\nIF A?\n 'x' EOL\nRETURN\nb: RETURN\n");
  CHECK(prog.only() == "2:1 open-if-at-return");
  CHECK(!prog.program.hasErrorNodes);
  const Diagnostic& finding = prog.at(0);
  REQUIRE(finding.fix);
  CHECK(finding.fix->applicability == Fix::Applicability::Display);
  CHECK(finding.fix->title == "insert END before line 4");
  CHECK(finding.notes.size() == 1);
  Prog repaired(prog.fixed(finding));
  CHECK(repaired.diagnostics.empty());
  CHECK(repaired.sources.file(0).bytes() == "a:\nIF A?\n 'x' EOL\nEND\nRETURN\nb: RETURN\n");
  CHECK(prog.shape().find("if without end") != std::string::npos);
}

TEST_CASE("a repair keeps the line ends, and is before a RETURN that shares its line") {
  Prog crlf("a:\r\nIF A?\r\n  RETURN\r\n");
  CHECK(crlf.fixed(crlf.at(0)) == "a:\r\nIF A?\r\nEND\r\n  RETURN\r\n");
  Prog glued("a: IF A? 'x' EOL RETURN");
  CHECK(glued.fixed(glued.at(0)) == "a: IF A? 'x' EOL END RETURN");
  Prog comment("a: IF A?\n{c} RETURN");
  CHECK(comment.fixed(comment.at(0)) == "a: IF A?\n{c} END RETURN");
}

TEST_CASE("each open IF gives one error; the innermost END belongs to the innermost IF") {
  Prog prog("a:\nIF A?\nIF B?\nIF C?\nEND\nRETURN\n");
  CHECK(prog.only() == "2:1 open-if-at-return, 3:1 open-if-at-return");
}

TEST_CASE("no repair where the END has several places") {
  Prog sibling("a:\nIF CycleType?('A')\n 'x' EOL\nIF CycleType?('B')\n 'y' EOL\nEND\nRETURN\n");
  CHECK(sibling.only() == "2:1 open-if-at-return");
  CHECK(!sibling.at(0).fix);
  REQUIRE(sibling.at(0).notes.size() == 2);
  CHECK(sibling.sources.line(sibling.at(0).notes[1].range) == 4);
  Prog both("a: IF CycleType?('A') IF CycleType?('A') END RETURN");
  CHECK(both.at(0).fix);
  Prog combined("a: IF CycleType?('A') AND F? IF CycleType?('B') AND F? END RETURN");
  CHECK(!combined.at(0).fix);
  Prog either("a: IF CycleType?('A') OR CycleType?('B') IF CycleType?('B') END RETURN");
  CHECK(either.at(0).fix);
  Prog chain("a: IF CycleType?('A') 'x' ELSE IF CycleType?('B') 'y' END RETURN");
  CHECK(chain.at(0).fix);
  Prog behind("a: IF CycleType?('A') 'x' ELSE IF CycleType?('B') 'y' END 'z' RETURN");
  CHECK(!behind.at(0).fix);
  Prog other("a: IF Flag?('A') IF CycleType?('B') END RETURN");
  CHECK(other.at(0).fix);
}

TEST_CASE("an END after RETURN: the RETURN may be an early one") {
  Prog prog("a:\nIF A?\nRETURN\nEND\n'x' EOL\nRETURN\nb: RETURN\n");
  CHECK(prog.only() == "2:1 open-if-at-return");
  CHECK(!prog.at(0).fix);
  CHECK(prog.program.hasErrorNodes);
}

TEST_CASE("a missing RETURN") {
  Prog label("a:\n 'x' EOL\n\nb: RETURN\n");
  CHECK(label.only() == "1:1 missing-return");
  CHECK(label.fixed(label.at(0)) == "a:\n 'x' EOL\n\nRETURN\nb: RETURN\n");
  CHECK(!label.program.hasErrorNodes);
  Prog end("a: 'x' EOL\n");
  CHECK(end.fixed(end.at(0)) == "a: 'x' EOL\nRETURN\n");
  CHECK(Prog(end.fixed(end.at(0))).diagnostics.empty());
  // A line or a branch that the file's end cuts off has no one reading.
  Prog cutLine("a: 'x' EO");
  CHECK(cutLine.only() == "1:1 missing-return");
  CHECK(!cutLine.at(0).fix);
  Prog cutBranch("a:\nIF A? 'x' EOL\n");
  CHECK(cutBranch.only() == "1:1 missing-return, 2:1 open-if-at-return");
  CHECK((!cutBranch.at(0).fix && !cutBranch.at(1).fix));
  Prog empty("a:");
  CHECK(empty.only() == "1:1 missing-return");
  Prog directive("a: 'x' EOL\n#1 = '#'\nFORMAT(N#,1)\nb: RETURN");
  CHECK(directive.only() == "1:1 missing-return");
  CHECK(directive.fixed(directive.at(0)) == "a: 'x' EOL\nRETURN\n#1 = '#'\nFORMAT(N#,1)\nb: RETURN");
  Prog both("a: IF A? 'x'\nb: RETURN");
  CHECK(both.only() == "1:1 missing-return, 1:4 open-if-at-return");
}

TEST_CASE("statements outside a routine") {
  Prog loose("'x' EOL\nSetFlag('q') RETURN\na: RETURN\nIF A? 'y' END\n#1 = '#'\n");
  CHECK(loose.only() == "1:1 statement-outside-routine, 4:1 statement-outside-routine");
  Prog blank("a : 'x' EOL RETURN\nb: RETURN");
  CHECK(blank.only() == "1:3 syntax-error");
}

TEST_CASE("the grammar decides everything by one token, so it cannot be ambiguous") {
  const std::string parser =
      readAll(std::filesystem::path(DOTEK_GENERATED) / "grammar/ComPost/ComPostParser.cpp");
  REQUIRE(parser.find("ComPostParser::routine()") != std::string::npos);
  CHECK(parser.find("adaptivePredict") == std::string::npos);
}

TEST_CASE("tokens are printed one a line") {
  SourceMap sources;
  Diagnostics diagnostics;
  const FileId file = sources.add(SourceFile("p", "a: {c\nd}\n 'x'D#('y')EOL", Encoding::Utf8));
  CHECK(dumpTokens(file, sources, {}, diagnostics) ==
        "1:1 LABEL a:\n1:4 COMMENT {c\\nd}\n3:2 LITERAL 'x'\n"
        "3:5 NUMERIC D#\n3:7 LPAREN (\n3:8 LITERAL 'y'\n3:11 RPAREN )\n"
        "3:12 KW_EOL EOL\n");
}

TEST_CASE("the corpus has one error: the IF of the last branch") {
  std::filesystem::path folder;
  if (!haveCorpus(folder)) return;
  Prog prog(readAll(folder / "compost" / "probe-routines.txt"));
  CHECK(prog.only() == "53:1 open-if-at-return");
  CHECK(!prog.program.hasErrorNodes);
  REQUIRE(prog.at(0).fix);
  CHECK(prog.at(0).fix->title == "insert END before line 75");
  CHECK(Prog(prog.fixed(prog.at(0))).diagnostics.empty());
}
