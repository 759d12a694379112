#include "support/Glob.h"

#include <doctest/doctest.h>
#include <string>

using namespace dotek;

TEST_CASE("glob: one star is part of a name, two are any folders") {
  CHECK(matchesGlob("lathe/*.nc", "lathe/O1.nc"));
  CHECK(!matchesGlob("lathe/*.nc", "lathe/old/O1.nc"));
  CHECK(!matchesGlob("lathe/*.nc", "mill/lathe/O1.nc"));
  CHECK(matchesGlob("lathe/**/*.nc", "lathe/O1.nc"));
  CHECK(matchesGlob("lathe/**/*.nc", "lathe/a/b/O1.nc"));
  CHECK(!matchesGlob("lathe/**/*.nc", "lathes/a/O1.nc"));
  CHECK(matchesGlob("**/old/**", "a/b/old/c/d"));
  CHECK(matchesGlob("**/old/**", "old"));
  CHECK(!matchesGlob("**/old/**", "a/older/c"));
  CHECK(matchesGlob("a/**/b/**/c", "a/x/b/b/y/c"));
  CHECK(!matchesGlob("a/**/b/**/c", "a/x/c/b"));
  CHECK(matchesGlob("O91??.nc", "O9103.nc"));
  CHECK(!matchesGlob("O91??.nc", "O913.nc"));
  CHECK(!matchesGlob("a?b", "a/b"));
  CHECK(matchesGlob("*a*b*", "xxaxbxaxb"));
  CHECK(!matchesGlob("*a*b*c", "xxaxbxaxb"));
  CHECK(!matchesGlob("O1.NC", "O1.nc"));
}

TEST_CASE("glob: a pattern without a slash takes names anywhere, and a folder takes what is in it") {
  CHECK(matchesGlob("*.bak", "x.bak"));
  CHECK(matchesGlob("*.bak", "deep/er/x.bak"));
  CHECK(matchesGlob("backup", "backup/a/b.nc"));
  CHECK(matchesGlob("backup", "mill/backup/b.nc"));
  CHECK(!matchesGlob("./backup", "mill/backup/b.nc"));
  CHECK(matchesGlob("./backup/", "backup/b.nc"));
  CHECK(matchesGlob("/backup", "backup/b.nc"));
  CHECK(!matchesGlob("/backup", "mill/backup/b.nc"));
  CHECK(matchesGlob("mill/backup", "mill/backup/c/b.nc"));
  CHECK(!matchesGlob("mill/backup/x", "mill/backup"));
  CHECK(matchesGlob("**", "anything/at/all"));
  CHECK(!matchesGlob("", "a"));
  CHECK(!matchesGlob(".", "a"));
}

TEST_CASE("glob: stars that nest cost no more than their number") {
  std::string path = "a";
  std::string pattern = "**";
  for (int i = 0; i < 40; ++i) {
    path += "/aaaaaaaaaaaaaaaa";
    pattern += "/**/*a*a*a*";
  }
  CHECK(matchesGlob(pattern, path));
  CHECK(!matchesGlob(pattern + "/b", path));
}
