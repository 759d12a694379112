#include "support/Source.h"

#include <doctest/doctest.h>

using namespace dotek;

TEST_CASE("lines end with LF, CR LF or CR") {
  const SourceFile file("f", "a\nbb\r\nccc\rd", Encoding::Utf8);
  CHECK(file.lineCount() == 4);
  CHECK(file.line(2) == "bb");
  CHECK(file.line(3) == "ccc");
  CHECK(file.line(4) == "d");
  CHECK(file.place(2).line == 2);
  CHECK(file.place(10).line == 4);
}

TEST_CASE("columns count characters") {
  const SourceFile utf8("f", "\xC3\xA9x", Encoding::Utf8);
  CHECK(utf8.place(2).column == 2);
  const SourceFile cp1250("f", "\xE9x", Encoding::Cp1250);
  CHECK(cp1250.place(1).column == 2);
  CHECK(cp1250.lineUtf8(1) == "\xC3\xA9x");
}

TEST_CASE("a byte order mark is no text") {
  const SourceFile file("f",
                        "\xEF\xBB\xBF"
                        "a",
                        Encoding::Utf8);
  CHECK(file.bytes() == "a");
}

TEST_CASE("UTF-8 is recognised strictly") {
  CHECK(isUtf8("abc \xC4\x8D \xE2\x82\xAC \xF0\x9F\x98\x80"));
  CHECK(!isUtf8("\xC0\x80"));
  CHECK(!isUtf8("\xED\xA0\x80"));
  CHECK(!isUtf8("\xE2\x82"));
  CHECK(!isUtf8("\xF5\x80\x80\x80"));
  CHECK(!isUtf8("\x80"));
}
