// The keyword tables that the build stored are those of the TOML files.
#include "stdlib/StoredTables.h"
#include "stdlib/DataFiles.h"

#include <doctest/doctest.h>
#include <optional>

using namespace dotek::stdlib;

TEST_CASE("stored keyword tables are what the TOML files say") {
  const DataFiles files;
  GibbsKeywords gibbs = TableStore::readGibbs(files); // every defect of the embedded files throws
  CHECK(TableStore::store(gibbs) == embeddedTables().gibbs);
  ComPostKeywords compost = TableStore::readComPost(files);
  CHECK(TableStore::store(compost) == embeddedTables().compost);
}

TEST_CASE("stored keyword tables survive the path back") {
  REQUIRE(embeddedTables().gibbs.size() > 10000);
  GibbsKeywords gibbs = TableStore::restoreGibbs(embeddedTables().gibbs);
  CHECK(TableStore::store(gibbs) == embeddedTables().gibbs);
  REQUIRE(gibbs.commands("message").size() == 1);
  CHECK(gibbs.commands("message").front()->grade != '\0');
  ComPostKeywords compost = TableStore::restoreComPost(embeddedTables().compost);
  CHECK(TableStore::store(compost) == embeddedTables().compost);
  CHECK(compost.isEntryPoint("progStart"));
}

TEST_CASE("damaged stored tables are refused") {
  const std::string_view whole = embeddedTables().gibbs;
  for (std::size_t length = 0; length < whole.size(); length += whole.size() / 97 + 1)
    CHECK_THROWS_AS(TableStore::restoreGibbs(whole.substr(0, length)), DataError);
  CHECK_THROWS_AS(TableStore::restoreGibbs(std::string(whole) + "1\n"), DataError);
  CHECK_THROWS_AS(TableStore::restoreComPost("x\n"), DataError);
}
