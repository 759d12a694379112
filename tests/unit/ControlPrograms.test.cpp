// What controls say of macro programs.
#include "ControlText.h"
#include "stdlib/CalledProgram.h"

using namespace dotek;
using namespace dotek::stdlib;
using tests::changed;
using tests::controlError;
using tests::own;

TEST_CASE("controls: how macro programs run on them") {
  const Control late = *Control::load(DataFiles(), "fanuc-31i-b");
  CHECK(late.arithmetic == Arithmetic::Double);
  REQUIRE(late.callCodes.size() == 2); // and M98 Q; G5101A[#6]X1 runs O9101
  CHECK(late.callCodes[0].letter == 'G');
  CHECK(late.callCodes[0].first == 5101);
  CHECK(late.callCodes[0].program == 9101);
  CHECK(late.callCodes[0].macro);
  REQUIRE(late.window);
  CHECK(late.window->address == 3962);
  CHECK(late.window->doubleWord == 3965);
  CHECK(late.callDepth == 15u);
  CHECK(late.variables.extendedNumber == 4130);
  const Control middle = *Control::load(DataFiles(), "fanuc-0i-md");
  CHECK(middle.arithmetic == Arithmetic::Decimal8);
  CHECK(middle.repeatInProgram);
  CHECK(localCallAddress(late, 'M', 98) == 'Q');
  CHECK(localCallAddress(middle, 'M', 98) == 'Q');
  CHECK(middle.callCodes.size() == 1);
  CHECK_FALSE(middle.window);
  const Control early = *Control::load(DataFiles(), "fanuc-6m");
  CHECK(early.arithmetic == Arithmetic::Decimal8);
  CHECK_FALSE(early.callDepth);
  CHECK_FALSE(early.printPadding);
  for (const Control& one : {late, middle, early}) {
    CHECK_FALSE(one.readAheadStops.empty());
    for (const auto& [letter, tenths] : one.readAheadStops)
      CHECK(one.find(letter, tenths) != nullptr);
    for (const StateRange& range : one.state) {
      CHECK_FALSE(range.title.empty());
      CHECK_FALSE(range.grade.empty());
      CHECK_FALSE(range.source.empty());
    }
  }
}

TEST_CASE("defects of a control, with line and column: macro programs") {
  const std::string origin = "grade='assumed',source='x'";
  const auto with = [&](const std::string& text) {
    return controlError(own("codes = [", text + "," + origin + "}]\ncodes = ["));
  };
  const auto table = [&](const std::string& text) {
    return controlError(own("codes = [", text + "," + origin + "}\ncodes = ["));
  };
  CHECK(with("calls = [{code='G5101',count=2,program=9101,as='macro'") == "");
  CHECK(with("calls = [{code='T',program=9000,as='subprogram',holds=149") == "");
  CHECK(with("calls = [{code='T',program=9000,as='subprogram',holds=200")
            .ends_with("#200 is no common variable"));
  CHECK(
      with("calls = [{code='T',count=2,program=9000,as='macro'").ends_with("each T calls the same program"));
  CHECK(with("calls = [{code='X5',program=9000,as='macro'")
            .ends_with("`X5` is no code; `G31` or `M30` is the form"));
  CHECK(with("calls = [{code='G5.1',program=9000,as='macro'")
            .ends_with("a code that calls a program is a whole number"));
  CHECK(with("calls = [{code='M31',program=9000,as='macro'").ends_with("`M31` is among the codes, too"));
  CHECK(with("calls = [{code='M50',count=3,program=9000,as='macro'," + origin +
             "},{code='M52',program=9010,as='macro'")
            .ends_with("`M52` is given twice"));
  CHECK(table("nesting = {calls=0").ends_with("`calls` is 0; 1 to 99 is expected"));
  CHECK(table("read_ahead = {stops=['G31','M0']") == "");
  CHECK(table("read_ahead = {stops=['G']").ends_with("`G` is no code; `G31` or `M30` is the form"));
  CHECK(table("output = {padding='zeros'").find("one of \"blanks\", \"none\" is expected") !=
        std::string::npos);
  CHECK(with("state = [{title='a',first=1100,last=1115,word=1132,access='store',initial=0") == "");
  CHECK(with("state = [{title='a',first=1100,access='read-only',initial='null'") == "");
  CHECK(with("state = [{title='a',first=1100,last=1090,access='store'")
            .ends_with("#1100 to #1090 is no range of at most 1000"));
  CHECK(with("state = [{title='a',first=1100,last=1140,word=1150,access='store'")
            .ends_with("a word holds 32 bits at most"));
  CHECK(with("state = [{title='a',first=5001,access='store'")
            .ends_with("#5001 is a variable of `block_end` and of `state`"));
  CHECK(with("state = [{title='a',first=1100,access='store'," + origin +
             "},{title='b',first=1100,access='store'")
            .ends_with("#1100 is a variable of `state` twice"));
  CHECK(table("window = {area='R',bytes=100,address=3962,byte=3963") == "");
  CHECK(table("window = {area='R',bytes=100,byte=3963").find("`address` is missing") != std::string::npos);
  CHECK(table("window = {area='R',bytes=100,address=3962,byte=3962")
            .ends_with("#3962 is a variable of `window` twice"));
  CHECK(changed("last=9999,last_sequence", "last=99999999,repeat_in_program=true,last_sequence")
            .find("`last` goes beyond them") != std::string::npos);
  CHECK(changed("macro_levels=4", "macro_levels=4,arithmetic='single'").find("`arithmetic` is") !=
        std::string::npos);
}
