#include "stdlib/Form.h"

#include "DataFolder.h"
#include "stdlib/ComPostKeywords.h"
#include "stdlib/DataFiles.h"
#include "support/Picture.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::stdlib;

namespace {

// Loads forms/own.toml with this text: what is wrong with it, without the path. "" where it loads.
std::string formError(const std::string& text) {
  const tests::DataFolder folder;
  const std::string path = folder.write("forms/own.toml", text);
  DataFiles files;
  Diagnostics diagnostics;
  REQUIRE(files.addFolder(folder.path(), Limits{}, diagnostics));
  try {
    const std::optional<Form> form = Form::load(files, "own"); // outside of CHECK, which swallows exceptions
    CHECK(form->origin == path);
  } catch (const DataError& error) {
    const std::string what = error.what();
    REQUIRE(what.starts_with(path + ":"));
    return what.substr(path.size() + 1);
  }
  return "";
}

std::string command(const std::string& keys) {
  return "schema = 1\n[[command]]\ngrade = 'assumed'\nsource = 'x'\n" + keys;
}

} // namespace

TEST_CASE("the form thesis-a") {
  const std::optional<Form> form = Form::load(DataFiles(), "thesis-a");
  REQUIRE(form);
  CHECK(form->name == "thesis-a");
  CHECK(form->origin == "built in");
  CHECK(form->commands.at("SpinOff").text == " M5");
  CHECK(form->commands.at("SpinOff").observed);
  CHECK(form->commands.at("CoolOff").text == " M9");
  const FormEntry& plane = form->commands.at("ZCP1");
  CHECK(plane.text == " Z");
  CHECK(plane.value == "clearance");
  CHECK_FALSE(plane.observed);
  CHECK(std::get<Picture>(Picture::parse(plane.picture)).print(5).text == "5.");
  CHECK(form->sequences.at("SeqC").text == "N");
  CHECK(form->sequences.at("SeqLabC").text == "N");
  CHECK(form->numerics.at("ToolOffset").picture == "###");
  CHECK(form->numerics.at("ToolOffset").value == "tool_offset");
  CHECK_FALSE(form->numerics.contains("OpFieldData"));
  CHECK(form->booleans.at("Drilling").value);
  CHECK_FALSE(form->booleans.at("RigidTap").value);
  CHECK_FALSE(Form::load(DataFiles(), "thesis"));
}

TEST_CASE("every built-in form loads, and every entry has a source") {
  const DataFiles files;
  for (const DataFile* file : files.list("forms")) {
    const std::optional<Form> form = Form::load(files, file->name);
    REQUIRE(form);
    for (const auto* map : {&form->commands, &form->numerics, &form->sequences}) {
      for (const auto& [name, entry] : *map) {
        CAPTURE(name);
        CHECK_FALSE(entry.source.empty());
      }
    }
  }
}

TEST_CASE("a form of one's own") {
  CHECK(formError("schema = 1\n") == "");
  CHECK(formError(command("name = 'Quiet'\ntext = ''\n")) == "");
  CHECK(formError(command("name = 'Plane'\ntext = ' R'\nvalue = 'retract'\npicture = '##0.0'\n")) == "");
}

TEST_CASE("defects of a form, with line and column") {
  CHECK(formError("[[command]]\n") == "1:1: `schema = 1` is missing; it is expected as the first key");
  CHECK(formError(command("name = 'A'\n")) == "2:1: `text` is missing; the text that is printed is expected");
  CHECK(formError(command("text = ' M5'\n")) == "2:1: `name` is missing; a keyword is expected");
  CHECK(formError(command("name = 'A'\ntext = 5\n")) ==
        "6:8: `text` holds a whole number; a text in quotes is expected");
  CHECK(formError(command("name = 'A'\ntext = 'M'\ntexts = 'M'\n")) ==
        "7:1: unknown key `texts`; the nearest known one is `text`");
  CHECK(formError(command("name = 'A'\ntext = 'M'\ntext = 'M'\n")).starts_with("7:"));
  CHECK(formError(command("name = 'A'\ntext = \"M\\n\"\n")).starts_with("6:8: `text` holds a character"));
  CHECK(formError(command("name = 'A#'\ntext = 'M'\n")) == "5:8: `A#` is given with its suffix; write `A`");
  CHECK(formError(command("name = 'a b'\ntext = 'M'\n")).starts_with("5:8: `a b` is no keyword"));
  CHECK(formError(command("name = 'SeqC'\ntext = 'M'\n")) ==
        "5:8: `SeqC` is a sequence word and is under `[[command]]`");
  CHECK(formError(command("name = 'IF'\ntext = 'M'\n")).starts_with("5:8: `IF` is a word of the language"));
  CHECK(formError(command("name = 'A'\ntext = 'M'\nvalue = 'clearence'\npicture = '#'\n")) ==
        "7:9: `clearence` is no host input; the nearest is `clearance`");
  CHECK(formError(command("name = 'A'\ntext = 'M'\nvalue = 'clearance'\n")) ==
        "7:9: `clearance` has no `picture` to be printed in");
  CHECK(formError(command("name = 'A'\ntext = 'M'\npicture = '#'\n"))
            .starts_with("7:11: `picture` is without `value`"));
  CHECK(formError(command("name = 'A'\ntext = 'M'\nvalue = 'retract'\npicture = '##.;'\n"))
            .starts_with("8:15: picture `##.;`: nothing follows"));
  CHECK(formError(command("name = 'A'\ntext = 'M'\nvalue = 'retract'\npicture = '+##'\n"))
            .starts_with("8:11: picture `+##`: what the characters `+`"));
  CHECK(formError(command("name = 'A'\ntext = 'M'\n[[command]]\nname = 'A'\ntext = 'M'\ngrade = "
                          "'observed'\nsource = ''\n")) == "8:8: `A` is given twice");
  CHECK(formError("schema = 1\n[[boolean]]\nname = 'B'\ngrade = 'maybe'\nvalue = true\nsource = ''\n") ==
        "4:9: `grade` is \"maybe\"; one of \"observed\", \"assumed\" is expected");
  CHECK(formError("schema = 1\n[[numeric]]\nname = 'B'\ngrade = 'assumed'\nsource = ''\n")
            .starts_with("2:1: `picture` is missing"));
  CHECK(formError("schema = 1\n[command]\nname = 'A'\n") ==
        "2:1: `command` holds a table; a list of tables is expected");
}

TEST_CASE("compost keywords") {
  const ComPostKeywords keywords = ComPostKeywords::load(DataFiles());
  REQUIRE(keywords.find("OpFieldData") != nullptr);
  CHECK(keywords.find("OpFieldData")->kind == KeywordKind::Numeric);
  CHECK(keywords.find("OpFieldData")->argument);
  CHECK(keywords.find("Flag")->kind == KeywordKind::Boolean);
  CHECK(keywords.find("SetFlag")->prints == Prints::No);
  CHECK(keywords.find("#")->kind == KeywordKind::Directive);
  CHECK(keywords.find("SEQC") == nullptr);
  CHECK(keywords.caseVariant("SEQC") == "SeqC");
  CHECK(keywords.caseVariant("SeqC") == "");
  CHECK(keywords.nearest("SpinOf") == "SpinOff");
  CHECK(keywords.nearest("xxxxxx") == "");
  CHECK(keywords.isEntryPoint("progStart"));
  CHECK_FALSE(keywords.isEntryPoint("probe"));
}
