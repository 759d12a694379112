#include "tests/unit/GibbsHarness.h"

#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::tests;
using namespace dotek::frontend::gibbs;

namespace {
bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}
std::string dialogFindings(const std::string& text) {
  GibbsHarness h;
  h.dialog(text);
  return h.codes();
}
std::string fieldFindings(const std::string& text) {
  GibbsHarness h;
  h.defines(text);
  return h.codes();
}
const std::string kFrame = "dialog \"T\", 1, 1, 300, 200\nok 1, 1, 9, 9\ncancel 1, 1, 9, 9\n";
} // namespace

TEST_CASE("gibbs: labels and jumps") {
  CHECK(findings(":top\ngoto TOP\n") == "");
  CHECK(findings(":top\ntop2:\n") == "");
  CHECK(findings(":top\nif 1 = 1 then goto tip\n") == "undefined-label@2:20");
  CHECK(holds(firstMessage(":retry\ngoto rerty\n"), "did you mean `retry`"));
  CHECK(findings("on_error goto gone\n") == "undefined-label@1:15");
  CHECK(findings(":a\nA:\n") == "duplicate-label@2:1");
  CHECK(findings("goto x\n:x y z\n") == "label-not-alone@2:4");
  GibbsHarness h;
  const Macro other = h.macro(":far\n");
  const Macro main = h.macro("#include \"o.mac\"\ngoto far\ngoto nowhere\n");
  checkMacro(main, {&other}, h.context());
  CHECK(h.codes() == "undefined-label@3:6");
  GibbsHarness unknown; // the included file is not at hand: the label may be there
  checkMacro(unknown.macro("#include \"o.mac\"\ngoto far\n"), {}, unknown.context());
  CHECK(unknown.codes() == "");
}

TEST_CASE("gibbs: loops") {
  CHECK(findings("for i = 1 to 3\nfor j = 1 to 2\nnext J\nnext I\n") == "");
  CHECK(findings("for i = 1 to 3\na = i\n") == "for-without-next@1:1");
  CHECK(findings("next i\n") == "next-without-for@1:1");
  CHECK(findings("for i = 1 to 3\nnext k\n") == "next-of-other-for@2:6");
  CHECK(findings("for i = 1 to 3\nfor j = 1 to 2\nnext i\nnext j\n") == "next-of-other-for@3:6");
  CHECK(findings("for i = 1 to 3\nfor j = 1 to 2\nnext i\n") == "for-without-next@2:1");
  CHECK(findings("continue\n") == "continue-outside-for@1:1");
  CHECK(findings("for i = 1 to 3\nif i = 2 then continue\nnext i\n") == "");
  CHECK(findings("goto in\nfor i = 1 to 3\n:in\nnext i\n") == "unverified-construct@1:6");
  CHECK(findings("for i = 1 to 3\nif i = 2 then goto out\nnext i\n:out\n") == "");
  CHECK(findings("for i 1 to 3\nnext i\n") == "syntax-error@1:7");
}

TEST_CASE("gibbs: commands and their arguments") {
  CHECK(findings("get_tool_data 3, mtool_radius, r\nGET_PART_DATA PART_NAME, n$\n") == "");
  CHECK(findings("get_tool_dta 3, mtool_radius, r\n") == "unknown-command@1:1");
  CHECK(holds(firstMessage("get_tool_dta 3, mtool_radius, r\n"), "did you mean `GET_TOOL_DATA`"));
  CHECK(holds(firstMessage("q = 1\nq 5\n"), "is `=` missing"));
  CHECK(holds(firstMessage("endif\n"), "no ENDIF"));
  CHECK(holds(firstMessage("label 1, 2, 3, 4, \"x\"\n"), "dialog file"));
  CHECK(findings("get_tool_data 3, mtool_radus, r\n") == "unknown-parameter@1:18");
  CHECK(findings("get_tool_data 3, mtool_radius\n") == "argument-count@1:1");
  CHECK(findings("get_tool_data 3, mtool_radius, r, s\n") == "argument-count@1:35");
  CHECK(findings("get_tool_data 3, mtool_radius, 5\n") == "argument-kind@1:32");
  CHECK(findings("get_tool_data 3, comment, c\n") == "argument-kind@1:27");
  CHECK(findings("message 5\n") == "argument-kind@1:9");
  CHECK(findings("message \"a\"\nmessage t$\n") == "");
  CHECK(findings("file_open 1, \"o.txt\", write\nfile_write_vars, 1, a, b\nfile_close 1\n") == "");
  CHECK(findings("file_open \"o.txt\", 1\n") == "argument-kind@1:11");
  CHECK(findings("file_open 11, \"o.txt\"\n") == "file-unit@1:11");
  CHECK(findings("add_custom_drill_cycle_path feed_x, 1\n") == "");
  CHECK(findings("add_custom_drill_cycle_path feed_x, 1, 2\n") == "argument-count@1:40");
  CHECK(findings("add_custom_drill_cycle_path feed, 1, 2\n") == "argument-count@1:1");
  CHECK(findings("add_custom_drill_cycle_path rapid, 1, 2, 3\n") == "unverified-name@1:29");
  CHECK(findings("trace onn\n") == "unknown-parameter@1:7");
  CHECK(findings("GET_NUM_SELECTED_SHAPES open + closed, n\n") == "");
  CHECK(findings("GET_CLEAR_PROG_NOTES\n") == "renamed-command@1:1");
  CHECK(findings("line 1, 2\n") == "misplaced-word@1:1");
  CHECK(findings("points\n[\nline 1, 2\npoint 1, 2\n]\n") == "misplaced-word@3:1");
  std::string many = "args a1";
  for (int i = 2; i <= 51; ++i)
    many += ", a" + std::to_string(i);
  CHECK(findings(many) == "too-many-names@1:1");
  CHECK(findings("call \"x.mac\", 1,2,3,4,5,6,7,8,9,10,11\n") == "too-many-names@1:1");
}

TEST_CASE("gibbs: expressions") {
  CHECK(findings("a = abs(1, 2)\n") == "argument-count@1:5");
  CHECK(findings("a = len(5)\n") == "argument-kind@1:9");
  CHECK(findings("a = abss(5)\n") == "unknown-function@1:5 unverified-construct@1:5");
  CHECK(findings("a = foo(1, 2)\n") == "unknown-function@1:5");
  CHECK(findings("a = \"x\"\n") == "text-and-number@1:5");
  CHECK(findings("a$ = 5\n") == "text-and-number@1:6");
  CHECK(findings("a = 5 - \"x\"\n") == "text-and-number@1:5");
  CHECK(findings("a$ = \"" + std::string(1001, 'x') + "\"\n") == "text-too-long@1:6");
  CHECK(findings("if 1 = 1, then a = 1\n") == "comma-before-then@1:9");
}

TEST_CASE("gibbs: one note a file and unverified construct") {
  const auto only = [](const std::string& text, const char* id) {
    GibbsHarness h;
    h.checked(text);
    CHECK_MESSAGE(h.diagnostics.all().size() == 1, text << "\n" << h.messages());
    CHECK_MESSAGE(holds(h.messages(), std::string("--assume ") + id), text << "\n" << h.messages());
    CHECK(h.diagnostics.all()[0].severity == Severity::Note);
  };
  only("if 1 = 1 and 2 = 2 then a = 1\nif 1 = 1 or 2 = 2 then a = 1\n", "and-or");
  only("if not 1 = 1 then a = 1\n", "not");
  only("if (1 = 1) then a = 1\n", "condition-brackets");
  only("if 1 = 1 then\n[\na = 1\n]\n", "block-if");
  only("if 1 = 1 then a = 1 else a = 2\n", "else");
  only("local a(5)\na(1) = 2\nb = a(1)\n", "array-round");
  only("a[1] = 2\nb = a[1]\n", "array-square");
  only("a$ = \"x\" + b$ + \"y\"\n", "text-join");
  only("if a$ = \"x\" then b = 1\n", "text-comparison");
  only("message 'x'\n", "single-quotes");
  only("message \"a\"\"b\"\n", "doubled-quote");
  only("a = .5\nb = 5.\n", "bare-fraction");
  only("a = 1e3\n", "exponent");
  only("for i = 1 to 2\nnext\n", "next-without-name");
  only("for i = 2 to 1 step -1\nnext i\n", "negative-step");
  only("call part\n", "bare-file");
  only(std::string(33, 'a') + " = 1\n", "long-name");
  CHECK(findings(std::string(32, 'a') + " = 1\n") == "");
}

TEST_CASE("gibbs: dialogs") {
  CHECK(dialogFindings(kFrame) == "");
  CHECK(dialogFindings("") == "empty-file@1:1");
  CHECK(dialogFindings("dialog \"T\", 1, 1, 300, 200\ncancel 1, 1, 9, 9\n") == "dialog-without-ok@1:1");
  CHECK(dialogFindings("dialog \"T\", 1, 1, 300, 200\nOK 1, 1, 9, 9\n") == "dialog-without-cancel@1:1");
  CHECK(dialogFindings("ok 1, 1, 9, 9\ncancel 1, 1, 9, 9\n") == "dialog-not-first@1:1");
  CHECK(dialogFindings("ok 1, 1, 9, 9\ndialog \"T\", 1, 1, 300, 200\ncancel 1, 1, 9, 9\n") ==
        "dialog-not-first@2:1");
  CHECK(dialogFindings(kFrame + "ok 1, 2, 3, 4\n") == "control-twice@4:1");
  CHECK(dialogFindings(kFrame + "inptu 1, 2, 3, 4, a\n") == "unknown-control@4:1");
  CHECK(dialogFindings(kFrame + "input 1, 2, 3, 4, a, a\ninput 1, 2, 3, 4, A\n") == "variable-twice@5:19");
  CHECK(dialogFindings(kFrame + "input 1, 2, 3, 4\n") == "argument-count@4:1");
  CHECK(dialogFindings(kFrame + "input 1, 2, 3, 4, 5\n") == "argument-kind@4:19");
  CHECK(dialogFindings(kFrame + "label 1, 2, 3, 4, x\n") == "argument-kind@4:19");
  CHECK(dialogFindings(kFrame + "image 1, 2, 3, 4, \"p.jpg\"\n") == "image-name@4:19");
  CHECK(dialogFindings(kFrame + "image 1, 2, 3, 4, \"p q.BMP\"\n") == "image-name@4:19");
  CHECK(dialogFindings(kFrame + "frame 1, 2, 3, 4, two words\n") == "loose-caption@4:19");
  CHECK(dialogFindings(kFrame + "frame 1, 2, 3, 4, word\n") == "loose-caption@4:19");
  CHECK(dialogFindings(kFrame + "label 1, 2, 3, 4, two words\n") == "syntax-error@4:19");
  CHECK(dialogFindings(kFrame + "set_state a = 1, 3, hide\nradio 1,2,3,4, r, 1, 2\nfont \"Arial\", 9\n") ==
        "");
  CHECK(dialogFindings(kFrame + "input 1, 2, 3, a = 1\n") == "syntax-error@4:16");
}

TEST_CASE("gibbs: definitions") {
  GibbsHarness h;
  const DefineData data = h.defines("Depth = -5.25 ! mm\n\nfeed = 300\r\n");
  CHECK(h.codes() == "");
  REQUIRE(data.definitions.size() == 2);
  CHECK(*data.definitions[0].number == -5.25);
  CHECK(fieldFindings("") == "empty-file@1:1");
  CHECK(fieldFindings("a = 1\nA = 2\n") == "duplicate-definition@2:1");
  CHECK(fieldFindings("a$ = \"x\"\n") == "field-value@1:6");
  CHECK(fieldFindings("a = 1 + 2\n") == "field-value@1:5");
  CHECK(fieldFindings("a 1\nb = 2\n") == "syntax-error@1:3");
  CHECK(fieldFindings("a = 1,5\n") == "syntax-error@1:6");
  CHECK(fieldFindings("Zb =\n") == "syntax-error@1:5");
  CHECK(fieldFindings("message \"x\"\n") == "syntax-error@1:9");
}

TEST_CASE("gibbs: names beside inputs") {
  const auto of = [](const std::string& body) {
    GibbsHarness h;
    const Dialog dialog = h.dialog(kFrame + body);
    std::string all;
    for (const InputLabel& label : inputLabels(dialog))
      all += label.variable.text + "=" + label.name + "|" + label.unit + "|" + label.meaning + ";";
    return all;
  };
  // two columns: the label of the right input is no meaning of the left one
  CHECK(of("label 10,10,50,20,\"K A [mm]\"\ninput 60,10,40,20,p\nlabel 110,10,50,20,\"B\"\ninput "
           "160,10,40,20,q\n"
           "label 210,10,90,20,\" depth of it \"\n") == "p=KA|mm|depth of it;q=B||depth of it;");
  // a tall box overlaps both rows; the nearer beginning decides, on a tie the greater overlap
  CHECK(of("label 10,0,50,60,\"tall\"\nlabel 10,22,50,20,\"row\"\ninput 60,20,40,20,p\n") == "p=tall||;");
  CHECK(of("label 10,0,50,22,\"upper\"\nlabel 10,24,50,20,\"row\"\ninput 60,20,40,20,p\n") == "p=row||;");
  CHECK(of("label 10,20,50,20,\"far\"\nlabel 12,38,50,20,\"near\"\ninput 60,20,40,20,p\n") == "p=near||;");
  // one that begins inside the box or at its left edge is neither; one that touches the right edge counts
  CHECK(of("label 60,20,50,20,\"inside\"\ninput 60,20,40,20,p\nlabel 100,20,9,20,\"right\"\n") ==
        "p=||right;");
  CHECK(of("label 10,40,50,20,\"below\"\ninput 60,20,40,20,p\n") == "p=||;");
  // a list is as high as its opened list; what is beside the next rows belongs to these
  const std::string list =
      "label 10,20,50,20,\"Times\"\ndropdown_new 60,20,40,130,n\nlabel 10,50,50,20,\"Z\"\n";
  const std::string row = "input 60,50,40,20,z\nlabel 110,50,90,20,\"of the ball\"\n";
  CHECK(of(list + row) == "n=Times||;z=Z||of the ball;");
  CHECK(of(list + "label 110,50,90,20,\"of the ball\"\n") == "n=Times||;");
}

TEST_CASE("gibbs: the folder as one unit") {
  GibbsHarness h;
  Cycle cycle;
  cycle.files = {"CYCLEDATA.DLG", "CYCLEDATA.MAC", "TOOLPATH.MAC", "DEFINEDATA.TXT"};
  cycle.defineData = parseDefineData(h.add("Width = 10\nspare = 1\n"), h.context());
  cycle.dialog = parseDialog(
      h.add(kFrame +
            "label 10,10,40,20,\"W [mm]\"\ninput 60,10,40,20,width,width\ninput 60,40,40,20,lost,2.5\n"),
      h.context());
  cycle.cycleData = parseMacro(h.add("p = callback_proc\nget_proc_data p, tool_num, t\ndialog "
                                     "\"CycleDat.dlg\"\nif widht > t then message \"x\"\n"),
                               h.context());
  cycle.toolPath =
      parseMacro(h.add("add_custom_drill_cycle_path feed, 0, 0, width - retract\n"), h.context());
  CHECK_MESSAGE(h.diagnostics.empty(), h.messages());
  checkCycle(cycle, h.context());
  h.diagnostics.sort();
  CHECK(h.codes() == "field-without-input@2:1 input-not-declared@6:19 dialog-file-missing@3:8 "
                     "undefined-variable@4:4 undefined-variable@1:49");
  CHECK(holds(h.messages(), "did you mean `Width`"));
  const std::vector<Field> fields = declaredFields(cycle);
  REQUIRE(fields.size() == 3);
  CHECK(fields[0].name.text == "Width");
  CHECK(fields[0].label->name == "W");
  CHECK(fields[2].name.text == "lost");
  CHECK(*fields[2].value == 2.5);
  CHECK(fields[2].fromDialog);
}
