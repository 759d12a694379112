// What a control takes beyond Macro B as the others read it: `[language]` of its file.
#include "frontend/macrob/Format.h"
#include "frontend/macrob/Parse.h"

#include <doctest/doctest.h>

using namespace dotek;
namespace macrob = dotek::frontend::macrob;

namespace {

struct Read {
  macrob::File file;
  std::string codes; // of what is reported, with blanks between
  std::string text;  // of the second block, laid out
};

Read read(const std::string& block, macrob::Forms forms = {}) {
  SourceMap sources;
  const FileId id = sources.add(SourceFile("o.nc", "O1\n" + block + "\nM99\n", Encoding::Utf8));
  Diagnostics found;
  Read out;
  out.file = macrob::parse(id, sources, Limits{}, found, macrob::Text::Program, macrob::Reader::Fast, forms);
  for (const Diagnostic& one : found.all())
    out.codes += std::string(out.codes.empty() ? "" : " ") + std::string(one.code);
  if (!out.file.programs.empty() && !out.file.programs.front().blocks.empty())
    out.text = macrob::print(out.file.programs.front().blocks.front());
  return out;
}

macrob::Forms all() {
  return {true, true, true, true, true};
}

} // namespace

TEST_CASE("forms: two letters for a word") {
  const Read loop = read("WH[#1 LT 3]DO1", all());
  CHECK(loop.codes == "");
  CHECK(loop.text == "WHILE[#1 LT 3]DO1");
  CHECK_FALSE(loop.file.hasErrors);
  CHECK(read("N5 EN1", all()).text == "N5 END1");
  CHECK(read("#1=SQ[#2]+FI[#3]", all()).text == "#1=SQRT[#2]+FIX[#3]");
  // Words of an NC block stay what they are.
  CHECK(read("G2 X1. R[#1]", all()).text == "G2 X1. R[#1]");

  const Read other = read("WH[#1 LT 3]DO1");
  CHECK(other.codes == "short-word");
  CHECK(other.file.hasErrors);
  CHECK(other.text == "WHILE[#1 LT 3]DO1"); // checks go on with what is meant
  CHECK(read("#1=SQ[#2]").codes == "short-word");
}

TEST_CASE("a jump after an assignment is a second statement") {
  CHECK(read("N2 #1=#2 GOTO8").codes == "syntax-error");
}

TEST_CASE("forms: IF without THEN") {
  CHECK(read("IF[#1 EQ 2]#3=4", all()).codes == "");
  CHECK(read("IF[#1 EQ 2]#3=4").codes == "then-missing");
  CHECK(read("IF[#1 NE 1]G65 P9725", all()).codes == "block-after-condition");
  CHECK(read("IF[#1 NE 1]THEN G0 X1.", all()).codes == "block-after-condition");
  CHECK(read("IF[#1 NE 1]THEN G0 X1.").codes == "then-takes-macro-statement");
}

TEST_CASE("forms: bits of parameters") {
  const Read bit = read("IF[#30057.21]GOTO5", all());
  CHECK(bit.codes == "");
  CHECK(bit.text == "IF[#30057.21 NE 0]GOTO 5");
  CHECK(read("#1=#30003.078/25.4", all()).codes == "");
  CHECK(read("IF[#30057.21]GOTO5").codes == "variable-number-form");
  CHECK(read("IF[#1]GOTO5").codes == "condition-without-comparison");
  CHECK(read("G0 Z#504.", all()).codes == "variable-number-form"); // no parameter
}

TEST_CASE("forms: comments in comments, small letters") {
  CHECK(read("(#5 = #6 (STATUS))", all()).codes == "");
  CHECK(read("G0 X5.(A (B))", all()).text == "G0 X5.(A (B)");
  CHECK(read("(#5 = #6 (STATUS))").codes == "syntax-error");
  CHECK(read("g0 x5.", all()).codes == "");
  CHECK(read("g0 x5.").codes.find("small-letter") == 0);
}
