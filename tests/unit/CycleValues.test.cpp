// Values of parameters as a command line gives them.
#include "project/CycleValues.h"
#include "tests/Process.h"

#include <doctest/doctest.h>

using namespace dotek;
using frontend::cycle::Type;
using frontend::cycle::TypeName;

namespace {

Type typeOf(TypeName name) {
  Type out;
  out.name = name;
  return out;
}

std::optional<double> read(const Type& type, std::string_view text) {
  std::string wants;
  const std::optional<double> out = project::cycleValue(type, text, wants);
  CHECK_FALSE(wants.empty());
  return out;
}

} // namespace

TEST_CASE("cycle values: a number has the unit of its parameter, or says its own") {
  const Type length = typeOf(TypeName::Length);
  CHECK(read(length, "30") == 30);
  CHECK(read(length, "-0.5mm") == -0.5);
  CHECK(read(length, "1.5 mm") == 1.5);
  CHECK(read(length, "2in") == doctest::Approx(50.8));
  CHECK(read(typeOf(TypeName::Angle), "45deg") == 45);
  CHECK(read(typeOf(TypeName::Feed), "500mm/min") == 500);
  CHECK(read(typeOf(TypeName::Feed), "20in/min") == doctest::Approx(508));
  CHECK(read(typeOf(TypeName::Time), "0.5s") == 0.5);
}

TEST_CASE("cycle values: what is no value of the type is refused") {
  for (const char* text : {"", "mm", "30deg", "30mm/min", "30 m", "1.2.3", "1e3", "five"})
    CHECK_FALSE(read(typeOf(TypeName::Length), text));
  CHECK_FALSE(read(typeOf(TypeName::Angle), "45mm"));
  CHECK_FALSE(read(typeOf(TypeName::Feed), "500mm"));
  CHECK_FALSE(read(typeOf(TypeName::Ratio), "5mm"));
  CHECK_FALSE(read(typeOf(TypeName::Count), "2.5"));
  CHECK_FALSE(read(typeOf(TypeName::Text), "name"));
}

TEST_CASE("cycle values: flags, offsets and choices by their names") {
  CHECK(read(typeOf(TypeName::Flag), "yes") == 1);
  CHECK(read(typeOf(TypeName::Flag), "no") == 0);
  CHECK_FALSE(read(typeOf(TypeName::Flag), "2"));
  CHECK(read(typeOf(TypeName::WorkOffset), "G55") == 55);
  CHECK(read(typeOf(TypeName::WorkOffset), "59") == 59);
  CHECK_FALSE(read(typeOf(TypeName::WorkOffset), "G60"));
  CHECK_FALSE(read(typeOf(TypeName::WorkOffset), "G54.1"));
  CHECK(read(typeOf(TypeName::ToolOffset), "T12") == 12);
  CHECK_FALSE(read(typeOf(TypeName::ToolOffset), "0"));
  Type choice = typeOf(TypeName::Choice);
  choice.choices = {{{}, "inside"}, {{}, "outside"}};
  CHECK(read(choice, "outside") == 2);
  CHECK_FALSE(read(choice, "beside"));
}

TEST_CASE("cycle values: --default of convert takes what --set takes") {
  const tests::ProcessFolder folder;
  folder.write("edge.cycle", "cycle edge \"Edge\"\nparameter system : work_offset\nparameter depth : length\n"
                             "spindle off\nprobe on\nprotected move by z -depth\ntouch x by 10 mm -> left\n"
                             "protected move to start\nprobe off\nset system: left.at becomes x 0 mm\n");
  const std::string command = "dotek convert edge.cycle --to fanuc -o - --default ";
  const auto plain = folder.run(command + "system=55 --default depth=12.7");
  REQUIRE_MESSAGE(plain.status == 0, plain.err);
  const auto literal = folder.run(command + "system=G55 --default depth=0.5in");
  CHECK(literal.status == 0);
  CHECK(literal.out == plain.out);
  const auto wrong = folder.run(command + "system=G60");
  CHECK(wrong.status != 0);
  CHECK(wrong.err.find("`--default system=G60`: this parameter takes a work offset") != std::string::npos);
  CHECK(folder.run(command + "sytem=G55").err.find("no-such-field") != std::string::npos);
}
