// Reading inputs and writing results: what is refused, and how it is reported.
#include "support/Files.h"
#include "support/FileIdentity.h"
#include "support/Output.h"

#include "tests/GoldenRunner.h"
#include "tests/TestFolder.h"

#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace fs = std::filesystem;
using namespace dotek;

namespace {

// A folder of its own, gone at the end.
// The code of the only finding for these bytes; "" where they are a text.
std::string codeFor(const std::string& bytes, std::optional<Encoding> forced = std::nullopt) {
  SourceMap sources;
  Diagnostics diagnostics;
  const auto file = addText("f", bytes, Encoding::Cp1250, forced, sources, diagnostics);
  CHECK(file.has_value() == diagnostics.empty());
  REQUIRE(diagnostics.all().size() <= 1);
  return diagnostics.empty() ? "" : std::string(diagnostics.all().front().code);
}

} // namespace

TEST_CASE("a file that cannot be read is one finding") {
  const tests::TestFolder scratch("dotek-files");
  std::ofstream(scratch / "large") << std::string(101, 'x');
  Limits limits;
  limits.keptBytes = 100 * kKeptOfByte;
  const auto codeOf = [&](const std::string& path) {
    Diagnostics diagnostics;
    CHECK_FALSE(readBytes(path, limits, diagnostics).has_value());
    REQUIRE(diagnostics.all().size() == 1);
    return std::string(diagnostics.all().front().code);
  };
  CHECK(codeOf((scratch / "none").string()) == "file-not-found");
  CHECK(codeOf((scratch / "large").string()) == "file-too-large");
  CHECK(codeOf(scratch.path().string()) == "file-not-readable");
}

TEST_CASE("a file of exactly the limit is read") {
  const tests::TestFolder scratch("dotek-files");
  std::ofstream(scratch / "f") << std::string(100, 'x');
  Limits limits;
  limits.keptBytes = 100 * kKeptOfByte;
  Diagnostics diagnostics;
  CHECK(readBytes((scratch / "f").string(), limits, diagnostics).value_or("").size() == 100);
  CHECK(diagnostics.empty());
}

TEST_CASE("texts that no control reads are refused") {
  using namespace std::string_literals;
  CHECK(codeFor("\xFF\xFE"s + "G\0"s) == "utf16-input");
  CHECK(codeFor("\xFE\xFF"s + "\0G"s) == "utf16-input");
  CHECK(codeFor("G\0 \0=\0"s) == "utf16-input"); // without its mark
  CHECK(codeFor("G = 5\0 4\n"s) == "nul-byte");
  CHECK(codeFor("\xE9", Encoding::Utf8) == "not-utf8");
  CHECK(codeFor("\xE9").empty());
  CHECK(codeFor("").empty());
}

TEST_CASE("a result is written whole or not at all") {
  const tests::TestFolder scratch("dotek-files");
  Diagnostics diagnostics;
  const auto write = [&](const std::string& path, const std::string& text) {
    return writeAll({{path, &text}}, "", {}, diagnostics);
  };
  CHECK(write((scratch / "out").string(), "N10\n"));
  CHECK(write((scratch / "out").string(), "N20\n"));
  CHECK(tests::readAll(scratch / "out") == "N20\n");
  CHECK(diagnostics.empty());
  CHECK_FALSE(write((scratch / "none/out").string(), "N10\n"));
  REQUIRE(diagnostics.all().size() == 1);
  CHECK(diagnostics.all().front().code == "file-not-writable");
  // Nothing is left beside it.
  CHECK(std::distance(fs::directory_iterator(scratch.path()), fs::directory_iterator()) == 1);
}

TEST_CASE("of several results none is placed where one cannot be written") {
  const tests::TestFolder scratch("dotek-files");
  Diagnostics diagnostics;
  const std::string text = "N10\n";
  const std::vector<NamedText> texts = {{(scratch / "d/a").string(), &text},
                                        {(scratch / "none/b").string(), &text}};
  CHECK_FALSE(writeAll(texts, (scratch / "d").string(), {}, diagnostics));
  CHECK_FALSE(fs::exists(scratch / "d"));
  CHECK(writeAll({texts.front()}, (scratch / "d").string(), {}, diagnostics));
  CHECK(tests::readAll(scratch / "d/a") == text);
}

TEST_CASE("which file a path means, whatever links and spellings lead there") {
  const tests::TestFolder scratch("dotek-files");
  std::ofstream(scratch / "a") << "x";
  fs::create_symlink("a", (scratch / "link").string());
  fs::create_hard_link((scratch / "a").string(), (scratch / "hard").string());
  fs::create_symlink("new", (scratch / "dangling").string());
  const auto same = [&](const std::string& x, const std::string& y) {
    const auto one = identify((scratch / x).string()), other = identify((scratch / y).string());
    REQUIRE(one.has_value());
    REQUIRE(other.has_value());
    return *one == *other;
  };
  CHECK(same("a", "./a"));
  CHECK(same("a", "link"));
  CHECK(same("a", "hard"));
  CHECK(same("new", "dangling"));
  CHECK(same("new", "../" + scratch.path().filename().string() + "/new"));
  CHECK_FALSE(same("a", "new"));
  CHECK_FALSE(same("new", "other"));
  CHECK_FALSE(identify("/dev/null").has_value());
  CHECK_FALSE(identify((scratch / "none/a").string()).has_value());
  const std::vector<std::string> repeated = {(scratch / "a").string(), (scratch / "b").string(),
                                             (scratch / "link").string()};
  CHECK(withoutRepeats(repeated) ==
        std::vector<std::string>{(scratch / "a").string(), (scratch / "b").string()});
}

TEST_CASE("what an input may name is below its folder, whatever links and dots say") {
  const tests::TestFolder scratch("dotek-files");
  const std::string at = scratch.path().string();
  fs::create_directories(at + "/shop/job");
  fs::create_directories(at + "/shop/other");
  std::ofstream(at + "/shop/job/a.mac") << "";
  std::ofstream(at + "/shop/other/b.mac") << "";
  fs::create_directory_symlink(at + "/shop/other", at + "/shop/job/link");
  fs::create_symlink(at + "/shop/job/a.mac", at + "/shop/other/back.mac");
  const ReadBounds job{{at + "/shop/job/"}};
  CHECK(job.allow(at + "/shop/job"));
  CHECK(job.allow(at + "/shop/job/a.mac"));
  CHECK(job.allow(at + "/shop/other/../job/a.mac"));
  CHECK(job.allow(at + "/shop/other/back.mac")); // a link to what is in the folder
  CHECK(job.allow(at + "/shop/job/not-there/x.mac"));
  CHECK(!job.allow(at + "/shop/other/b.mac"));
  CHECK(!job.allow(at + "/shop/job/../other/b.mac"));
  CHECK(!job.allow(at + "/shop/job/link/b.mac"));
  CHECK(!job.allow(at + "/shop/jobs/a.mac"));
  CHECK(!job.allow(at + "/shop"));
  CHECK(!job.allow("/etc/passwd"));
  CHECK(!ReadBounds{}.allow(at + "/shop/job/a.mac"));
  CHECK(ReadBounds{{"/"}}.allow("/etc/passwd"));
  const ReadBounds both{{at + "/shop/job", at + "/shop/other"}};
  CHECK(both.allow(at + "/shop/job/link/b.mac"));
  CHECK(both.text() == "`" + at + "/shop/job` or `" + at + "/shop/other`");
}
