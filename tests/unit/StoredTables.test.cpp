// The tables that the build stored are those of the TOML files.
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

TEST_CASE("stored macro sets and controls are what the TOML files say, and survive the path back") {
  const DataFiles files;
  REQUIRE(embeddedTables().macros.size() == files.list("macros").size());
  for (const StoredTable& table : embeddedTables().macros) {
    CAPTURE(table.name);
    MacroSet set = TableStore::readMacroSet(*files.find("macros", table.name));
    CHECK(TableStore::store(set) == table.text);
    MacroSet back = TableStore::restoreMacroSet(table.text);
    CHECK(TableStore::store(back) == table.text);
    CHECK(back.name == table.name);
    CHECK(back.signatures.size() == set.signatures.size());
  }
  REQUIRE(embeddedTables().controls.size() == files.list("controls").size());
  for (const StoredTable& table : embeddedTables().controls) {
    CAPTURE(table.name);
    Control control = TableStore::readControl(files, *files.find("controls", table.name));
    CHECK(TableStore::store(control) == table.text);
    Control back = TableStore::restoreControl(table.text);
    CHECK(TableStore::store(back) == table.text);
    CHECK(back.increment == control.increment);
    CHECK(back.codes.size() == control.codes.size());
  }
  CHECK_THROWS_AS(TableStore::restoreControl("x\n"), DataError);
}

TEST_CASE("numbers, absent values and letters of a macro set survive the path back") {
  MacroSet set;
  set.name = "made";
  set.probing.overtravel = 0.1 + 0.2; // no short decimal
  set.probing.overtravelZ = -1e-300;
  set.probing.lengthToTip = false;
  set.callerValues = {{4, 1.0 / 3.0}};
  set.scratch = {{100, 149}};
  set.signatures.resize(1);
  set.signatures.front().arguments.resize(1);
  set.signatures.front().arguments.front().letter = 'Z';
  const MacroSet back = TableStore::restoreMacroSet(TableStore::store(set));
  CHECK(back.probing.overtravel == set.probing.overtravel);
  CHECK(back.probing.overtravelZ == set.probing.overtravelZ);
  CHECK_FALSE(back.probing.clearance.has_value());
  CHECK_FALSE(back.probing.lengthToTip);
  CHECK(back.callerValues == set.callerValues);
  CHECK(back.scratch == set.scratch);
  CHECK(back.signatures.front().arguments.front().letter == 'Z');
}
