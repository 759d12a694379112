// The layout of programs of Mikroprog: docs/mikroprog.md, "Layout".
#include "DataFolder.h"
#include "frontend/mikroprog/Format.h"
#include "frontend/mikroprog/Parse.h"
#include "tests/GoldenRunner.h"

#include <doctest/doctest.h>

using namespace dotek;
using tests::DataFolder;
using tests::runDotek;
namespace mikroprog = frontend::mikroprog;

namespace {

struct Laid {
  SourceMap sources;
  Diagnostics diagnostics;
  mikroprog::Program program;
  std::optional<std::string> text;

  explicit Laid(const std::string& from) {
    const FileId file = sources.add(SourceFile("a.suf", from, Encoding::Cp852));
    program = mikroprog::parse(file, sources, diagnostics);
    text = mikroprog::format(program, sources);
  }
};

std::string laid(const std::string& text) {
  const Laid once(text);
  REQUIRE(once.text);
  const Laid twice(*once.text);
  CHECK(twice.text == once.text);
  CHECK(mikroprog::sameProgram(once.program, twice.program));
  return *once.text;
}

} // namespace

TEST_CASE("mikroprog: renumber gives new numbers, and each L follows its block") {
  const DataFolder folder;
  const auto renumbered = [&](const std::string& text, std::vector<std::string> flags = {}) {
    folder.write("P.SUF", text);
    flags.insert(flags.begin(), {"renumber", "P.SUF", "-o", "-"});
    return runDotek(flags, folder.path());
  };
  CHECK(renumbered(";A\nN1 G23 L7 O1\nG0 X1\nN5 P1=2 ;L7\nN7 G28 @B.SUF L7\nN9 M30\n").out ==
        ";A\nN10 G23 L30 O1\nG0 X1\nN20 P1=2 ;L7\nN30 G28 @B.SUF L7\nN40 M30\n");
  CHECK(renumbered("N1 G27 L3\nG0 X1\nP1=2\nN3 M30\n", {"--all", "--start", "100", "--step", "5"}).out ==
        "N100 G27 L115\nN105 G0 X1\nN110 P1=2\nN115 M30\n");
  for (const char* wrong : {"N1 G27 L8\nN2 M30\n", "N1 G27 L2\nN2 G0 X1\nN2 M30\n", "N1 G27 LP2\nN2 M30\n"}) {
    CAPTURE(wrong);
    const auto result = renumbered(wrong);
    CHECK(result.status == 1);
    CHECK(result.err.find("[suf-renumber]") != std::string::npos);
    CHECK(result.err.find("P.SUF:1:8") != std::string::npos);
  }
  CHECK(renumbered("N1 M30\n", {"--range", "1:2"}).status != 0);
}

TEST_CASE("mikroprog layout: one blank between words, numbers without zeros that say nothing") {
  CHECK(laid("N0010  G01X+1.500\tZ-.250  F100.0\n") == "N10 G1 X1.5 Z-0.25 F100\n");
  CHECK(laid("N10 X-0.000 Z00.10 L0090\n") == "N10 X0 Z0.1 L90\n");
  CHECK(laid("N30 P090 = P90 + 1.50\n") == "N30 P90=P90+1.5\n");
  CHECK(laid("  XP2 F-P06\n") == "XP2 F-P6\n");
  CHECK(laid("N10 X1.23456\n") == "N10 X1.23456\n"); // more decimals than the control takes are for lint
  CHECK(laid("N10 M30") == "N10 M30\n");
  CHECK(laid("") == "");
}

TEST_CASE("mikroprog layout: comments, files and lines stay") {
  CHECK(laid(";  HEADER  a;b\nN10 M0;WAIT  FOR\n\nN20 M30 ;END   \n") ==
        ";  HEADER  a;b\nN10 M0 ;WAIT  FOR\n\nN20 M30 ;END\n");
  CHECK(laid("N10 M29 @scr.sou ;text\n") == "N10 M29 @scr.sou;text\n");
  CHECK(laid("N10 M0 ;P\xfd\xa1li\xe7\n") == "N10 M0 ;P\xfd\xa1li\xe7\n"); // bytes of another code page
  CHECK(laid("N10 M30\n\x1a") == "N10 M30\n\x1a");                         // the end of a file of DOS
}

TEST_CASE("mikroprog layout: what could not be read has none") {
  CHECK_FALSE(Laid("N10 G0 X1\nN20 (c)\n").text);
}

TEST_CASE("mikroprog layout: another number or word is another program") {
  const auto same = [](const std::string& a, const std::string& b) {
    return mikroprog::sameProgram(Laid(a).program, Laid(b).program);
  };
  CHECK(same("N10 X1.0\n", "N010 X1\n"));
  for (const char* other :
       {"N10 X1.01\n", "N20 X1\n", "N10 Z1\n", "N10 X1 ;a\n", "N10 X1 Z1\n", "N10 XP1\n", "P1=1\n"})
    CHECK_FALSE_MESSAGE(same("N10 X1\n", other), other);
  CHECK_FALSE(same("P1=1+2\n", "P1=1-2\n"));
  CHECK_FALSE(same("M25 @A.SOU\n", "M25 @B.SOU\n"));
}
