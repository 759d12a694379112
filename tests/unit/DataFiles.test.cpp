#include "stdlib/DataFiles.h"
#include "support/Files.h"

#include "DataFolder.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::stdlib;
using dotek::tests::DataFolder;

TEST_CASE("--data adds and replaces by name") {
  DataFiles files;
  REQUIRE(files.find("keywords", "compost") != nullptr);
  CHECK(files.find("keywords", "compost")->origin == "built in");
  const std::size_t before = files.list("keywords").size();
  const DataFolder folder;
  const std::string own = folder.write("keywords/compost.toml", "own");
  folder.write("keywords/aaa.toml", "new");
  folder.write("forms/zz.toml", "form");
  folder.write("forms/README.md", "text");
  Diagnostics diagnostics;
  CHECK(files.addFolder(folder.path(), Limits{}, diagnostics));
  CHECK(diagnostics.empty());
  CHECK(files.find("keywords", "compost")->text == "own");
  CHECK(files.find("keywords", "compost")->origin == own);
  const auto list = files.list("keywords");
  REQUIRE(list.size() == before + 1);
  CHECK(list[0]->name == "aaa");
  CHECK(list[1]->name == "compost");
  CHECK(files.find("forms", "zz")->text == "form");
  CHECK(files.find("forms", "zzz") == nullptr);
  CHECK(files.find("form", "zz") == nullptr);

  const DataFolder second; // a later folder wins
  second.write("forms/zz.toml", "later");
  CHECK(files.addFolder(second.path(), Limits{}, diagnostics));
  CHECK(files.find("forms", "zz")->text == "later");
}

TEST_CASE("--data says what it does not read") {
  const auto codes = [](const DataFolder& folder, bool expected, std::uint32_t maxBytes = 1000) {
    DataFiles files;
    Diagnostics diagnostics;
    Limits limits;
    limits.keptBytes = maxBytes * kKeptOfByte;
    CHECK(files.addFolder(folder.path(), limits, diagnostics) == expected);
    std::string out;
    for (const Diagnostic& d : diagnostics.all())
      out += std::string(d.code) + " ";
    return out;
  };
  const DataFolder empty;
  CHECK(codes(empty, true) == "data-folder-empty ");
  const DataFolder odd;
  odd.write("form/x.toml", "a");
  odd.write("y.toml", "a");
  CHECK(codes(odd, true) == "data-folder-unused data-folder-unused ");
  const DataFolder large;
  large.write("forms/x.toml", "0123456789");
  CHECK(codes(large, false, 5) == "file-too-large ");

  DataFiles files;
  Diagnostics diagnostics;
  CHECK_FALSE(files.addFolder(empty.path() + "/none", Limits{}, diagnostics));
  CHECK(diagnostics.all().back().code == "file-not-found");
  CHECK_FALSE(files.addFolder(large.path() + "/forms/x.toml", Limits{}, diagnostics));
  CHECK(diagnostics.all().back().code == "file-not-readable");
}
