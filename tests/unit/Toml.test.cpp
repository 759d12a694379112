#include "stdlib/Toml.h"

#include "stdlib/DataFiles.h"
#include "support/Files.h"

#include <array>
#include <doctest/doctest.h>
#include <functional>

using namespace dotek;
using namespace dotek::stdlib;

namespace {

using Reader = std::function<void(const TomlDocument&)>;

std::string dataError(
    const std::string& text, const Reader& read = [](const TomlDocument&) {}) {
  const DataFile file{"forms", "x", "forms/x.toml", text};
  try {
    const TomlDocument document = TomlDocument::parse(file);
    read(document);
    document.finish();
  } catch (const DataError& error) {
    return error.what();
  }
  return "";
}

// Line:column and text of what the reader reports of a user's file.
std::string reported(
    const std::string& text, const Reader& read = [](const TomlDocument&) {}) {
  SourceMap sources;
  Diagnostics diagnostics;
  const auto file = addText("job.toml", text, Encoding::Cp1250, std::nullopt, sources, diagnostics);
  REQUIRE(file);
  if (const auto document = TomlDocument::parse(*file, sources, diagnostics)) {
    read(*document);
    const bool finished = document->finish();
    CHECK(finished == diagnostics.empty());
  }
  std::string out;
  for (const Diagnostic& d : diagnostics.all()) {
    const LineColumn place = sources.file(d.range.file).place(d.range.begin);
    out += std::to_string(place.line) + ":" + std::to_string(place.column) + " [" +
           sources.textUtf8(d.range) + "] " + d.message + "\n";
  }
  return out;
}

} // namespace

TEST_CASE("toml: a reader takes what it knows") {
  const std::string text =
      "schema = 1\nname = 'a'\nn = 3\nx = 2.5\non = true\nlist = [1, 2.5]\nwords = ['p', 'q']\n"
      "[sub]\nz = 1\na = 2\n[[op]]\ncycle = 'u'\n[[op]]\ncycle = 'v'\n";
  CHECK(reported(text, [](const TomlDocument& document) {
          const TomlTable root = document.root();
          CHECK(root.value("name").text() == "a");
          CHECK(root.value("n").integer() == 3);
          CHECK(root.value("n").number() == 3.0);
          CHECK(root.value("x").number() == 2.5);
          CHECK(root.value("on").flag());
          CHECK(root.value("list").numbers() == std::vector<double>{1, 2.5});
          CHECK(root.value("words").texts() == std::vector<std::string>{"p", "q"});
          CHECK(root.value("absent").text("d") == "d");
          CHECK(root.value("absent").integer(7) == 7);
          CHECK(root.value("absent").table().value("deeper").number(4) == 4.0);
          CHECK(root.value("absent").tables().empty());
          CHECK_FALSE(root.has("absent"));
          const auto entries = root.value("sub").table().entries();
          REQUIRE(entries.size() == 2);
          CHECK(entries[0].key == "z"); // the order of the file
          CHECK(entries[1].value.integer() == 2);
          const auto operations = root.value("op").tables();
          REQUIRE(operations.size() == 2);
          CHECK(operations[0].value("cycle").text() == "u");
          CHECK(operations[1].require("cycle", "a name").text() == "v");
        }) == "");
}

TEST_CASE("toml: unknown keys") {
  CHECK(dataError("schema = 1\n  y = 2\n") == "forms/x.toml:2:3: unknown key `y`; known here: `schema`");
  const Reader read = [](const TomlDocument& document) {
    document.root().value("clearance");
    for (const TomlTable& table : document.root().value("op").tables())
      table.value("cycle");
  };
  CHECK(reported("schema = 1\nclearence = 2\n", read) ==
        "2:1 [clearence] unknown key `clearence`; the nearest known one is `clearance`\n");
  CHECK(reported("schema = 1\nop = [{ cycle = 'a' }, { cykle = 'b', zzzzz = 1 }]\n", read) ==
        "2:26 [cykle] unknown key `cykle`; the nearest known one is `cycle`\n"
        "2:39 [zzzzz] unknown key `zzzzz`; known here: `cycle`\n");
  // a table that nobody opened is one finding
  CHECK(reported("schema = 1\n[other]\na = 1\nb = 2\n", read) ==
        "2:2 [other] unknown key `other`; known here: `clearance`, `op`, `schema`\n");
}

TEST_CASE("toml: columns count characters") {
  const Reader read = [](const TomlDocument& document) { document.root().value("t").table(); };
  CHECK(reported("schema = 1\nt = { \"\xC4\x8D\xC5\x99\" = 1 }\n", read)
            .starts_with("2:7 [\"\xC4\x8D\xC5\x99\"]"));
  CHECK(reported("\xEF\xBB\xBFschema = 1\r\nt = { \"\xC4\x8D\xC5\x99\" = 1, b = 2 }\r\n", read)
            .find("2:17 [b]") != std::string::npos);
}

TEST_CASE("toml: places on a long line of characters of all lengths") {
  std::string text = "schema = 1\r\nt = { ";
  std::vector<std::string> names;
  for (int i = 0; i < 300; ++i) {
    static const std::array<const char*, 4> kLetters = {"a", "\xC4\x8D", "\xE2\x82\xAC", "\xF0\x9F\x94\xA7"};
    names.push_back('"' + std::string(kLetters[static_cast<std::size_t>(i) % 4]) + std::to_string(i) + '"');
    text += (i == 0 ? "" : ", ") + names.back() + " = 1";
  }
  const std::string all =
      reported(text + " }\r\nlast = 1", [](const TomlDocument& d) { d.root().value("t").table(); });
  for (const std::string& name : names)
    CHECK(all.find(" [" + name + "] unknown key") != std::string::npos);
  CHECK(all.find("3:1 [last]") != std::string::npos);
}

TEST_CASE("toml: wrong types and values") {
  const auto at = [](const std::string& line, const std::function<void(TomlValue)>& read) {
    return reported("schema = 1\n" + line + "\n", [&](const TomlDocument& d) { read(d.root().value("k")); });
  };
  CHECK(at("k = 'a'", [](TomlValue v) { CHECK(v.number(3) == 3); }) ==
        "2:5 ['a'] `k` holds a text; a number is expected\n");
  CHECK(at("k = 2.0", [](TomlValue v) { v.integer(); }) ==
        "2:5 [2.0] `k` holds a number; a whole number is expected\n");
  CHECK(at("k = 0", [](TomlValue v) { v.integer(1, 1, 9999); }) ==
        "2:5 [0] `k` is 0; 1 to 9999 is expected\n");
  CHECK(at("k = 0", [](TomlValue v) { v.integer(1, 1); }) == "2:5 [0] `k` is 0; 1 or more is expected\n");
  CHECK(at("k = inf", [](TomlValue v) { v.number(); }) == "2:5 [inf] `k` is no finite number\n");
  CHECK(at("k = 1", [](TomlValue v) { v.text(); }) ==
        "2:5 [1] `k` holds a whole number; a text in quotes is expected\n");
  CHECK(at("k = 1", [](TomlValue v) { v.flag(); }) ==
        "2:5 [1] `k` holds a whole number; true or false is expected\n");
  CHECK(at("k = [1, 'b']", [](TomlValue v) { v.numbers(); }) ==
        "2:9 ['b'] `k` holds a text; a number is expected\n");
  CHECK(at("k = 1", [](TomlValue v) { v.texts(); }) ==
        "2:5 [1] `k` holds a whole number; a list [...] is expected\n");
  CHECK(at("k = [1]", [](TomlValue v) { v.tables(); }) ==
        "2:6 [1] `k` holds a whole number; a list of tables is expected\n");
  CHECK(at("k = 'c'", [](TomlValue v) {
          CHECK(v.choice({"a", "b"}, "a") == "a");
        }) == "2:5 ['c'] `k` is \"c\"; one of \"a\", \"b\" is expected\n");
  CHECK(at("k = 1979-05-27", [](TomlValue v) { v.number(); }).find("holds a date or time") !=
        std::string::npos);
  // a table of the wrong type is one finding, not one for each key in it
  CHECK(at("k = { a = 1 }", [](TomlValue v) { v.text(); }) ==
        "2:5 [{ a = 1 }] `k` holds a table; a text in quotes is expected\n");
  CHECK(reported("schema = 1\n[[op]]\n", [](const TomlDocument& d) {
          for (const TomlTable& t : d.root().value("op").tables())
            t.require("cycle", "the name of a cycle");
        }).find("`cycle` is missing; the name of a cycle is expected") != std::string::npos);
}

TEST_CASE("toml: schema comes first") {
  CHECK(dataError("") == "forms/x.toml:1:1: `schema = 1` is missing; it is expected as the first key");
  CHECK(dataError("# note\na = 1\n").find("`schema = 1` is missing") != std::string::npos);
  CHECK(dataError("a = 1\nschema = 1\n") ==
        "forms/x.toml:1:1: `a` is before `schema = 1`, which is expected as the first key");
  CHECK(dataError("schema = 2\n") == "forms/x.toml:1:10: `schema` is 2; this version of dotek reads 1");
  CHECK(dataError("schema = '1'\n") ==
        "forms/x.toml:1:10: `schema` holds a text; a whole number is expected");
  CHECK(reported("schema = '1'\nq = 1\n") ==
        "1:10 ['1'] `schema` holds a text; a whole number is expected\n");
}

TEST_CASE("toml: what is no TOML") {
  CHECK(dataError("schema = 1\na = 1\na = 2\n").starts_with("forms/x.toml:3:"));
  CHECK(dataError("schema = 1\na = 1\na = 2\n").find("the file is no TOML: ") != std::string::npos);
  for (const char* bad : {"schema = 1\n[a\n", "schema = 1\nb\n", "schema = 1\nb = 1,5\n", "\xFF\xFE",
                          "schema = 1\n[a]\n[a]\n", "schema = 1\nb = '\xE8'\n"}) {
    CAPTURE(bad);
    CHECK(dataError(bad).find("the file is no TOML: ") != std::string::npos);
  }
  std::string dots = "schema = 1\na";
  for (int i = 0; i < 300000; ++i)
    dots += ".1";
  CHECK(dataError(dots + " = 1\n") ==
        "forms/x.toml:2:1: the file is no TOML: more than 1000 dots on one line");
  CHECK(dataError("schema = 1\na = " + std::string(100000, '[')).find("no TOML") != std::string::npos);
  std::string numbers = "schema = 1\na = [";
  for (int i = 0; i < 5000; ++i)
    numbers += "1.5,";
  CHECK(dataError(numbers + "]\n",
                  [](const TomlDocument& d) { CHECK(d.root().value("a").numbers().size() == 5000); }) == "");
}

TEST_CASE("toml: defects of meaning carry their place") {
  const Reader read = [](const TomlDocument& d) { d.fail(d.root().value("k").range(), "too bad"); };
  CHECK(dataError("schema = 1\n\nk = 5\n", read) == "forms/x.toml:3:5: too bad");
  CHECK(reported("schema = 1\n\nk = 5\n", read) == "3:5 [5] too bad\n");
}
