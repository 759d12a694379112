// What a text is, whatever its name: texts as they come from controls, CAMs and editors, and texts that look
// like them.
#include "project/InputKind.h"
#include "project/Foreign.h"
#include "project/PostShape.h"

#include <doctest/doctest.h>
#include <string>
#include <vector>

using dotek::project::InputKind;
using dotek::project::isPost;
using dotek::project::kindName;
using dotek::project::recognise;
using dotek::project::Recognition;

namespace {

std::string kindOf(const std::string& text, const std::string& name = "") {
  const Recognition found = recognise(name, text);
  return found.kind ? std::string(kindName(*found.kind)) : "none: " + found.reason;
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
  return text;
}

std::string lower(std::string text) {
  for (char& c : text)
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

std::string wide(const std::string& text, bool bigEndian) {
  std::string out;
  for (const char c : text)
    out += bigEndian ? std::string{'\0', c} : std::string{c, '\0'};
  return out;
}

const std::string kMacro = "%\nO7310(WEB WIDTH)\nIF[#7EQ#0]GOTO91\n#31=#4001\nG65P9810Z-5.F1000\n"
                           "G91G31X[#7/2+5.]F200\n#141=#5061-#5041\nWHILE[#30LT3]DO1\n#30=#30+1\nEND1\n"
                           "G90\nG0Z50.\nM99\nN91#3000=91(NO WIDTH)\n%\n";

const std::string kNone = "none: no language that Dotek reads";

} // namespace

TEST_CASE("input kind: a program of macro B is one under any name, with any line ends and letters") {
  for (const char* name :
       {"", "O7310", "WEB.EIA", "web.PRG", "web.cnc", "web.tap", "web.xyz", "web.mac", "a b.h"})
    CHECK_MESSAGE(kindOf(kMacro, name) == "nc", name);
  CHECK(kindOf(replaced(kMacro, "\n", "\r\n")) == "nc");
  CHECK(kindOf(replaced(kMacro, "\n", "\r")) == "nc");
  CHECK(kindOf(replaced(kMacro, "\n", ";\n")) == "nc");
  CHECK(kindOf(lower(kMacro)) == "nc");
  CHECK(kindOf("\n\n  \n" + kMacro) == "nc");
  CHECK(kindOf("\xEF\xBB\xBF" + kMacro) == "nc");
  CHECK(kindOf(replaced(kMacro, "O7310", ":7310")) == "nc");
  CHECK(kindOf(replaced(kMacro, "O7310", "<WEB_WIDTH>")) == "nc");
  CHECK(kindOf(replaced(replaced(kMacro, "%\n", ""), "O7310(WEB WIDTH)\n", "")) == "nc");
  CHECK(kindOf(replaced(kMacro, "WEB", "\xE8\xEC\x9A\xFE")) == "nc"); // CP1250
  CHECK(kindOf(replaced(kMacro, "WEB", "\x9F\xD8\xE7\xA7")) == "nc"); // CP852
  CHECK(kindOf(kMacro + "\x1A") == "nc");                             // the end of a file of CP/M and DOS
  CHECK(kindOf("TAPE 12, MACHINE 3\nPUNCHED BY HAND\n" + kMacro + "END OF TAPE\n") == "nc");
  CHECK(kindOf(std::string(300, '\0') + kMacro + std::string(300, '\0')) == "nc"); // feed holes
}

TEST_CASE("input kind: programs without macro statements, of one block, of one line") {
  CHECK(kindOf("N10 G54 G90\nN20 T5 M6\nN30 G0 X10.5 Y-3.25\nX20.\nY5.\nN40 M30\n") == "nc");
  CHECK(kindOf("M30\n") == "nc");
  CHECK(kindOf("O0100;N10 G0 X0 Y0;N20 G1 Z-1. F100;M30;") == "nc");
  CHECK(kindOf("POPEN\nDPRNT[X#101[33] Measured value]\nPCLOS\nM99\n") == "nc");
  CHECK(kindOf("/2 N5 G1 X-#24 ,R2. F[#9*2]\nM98 P1000 L2\n") == "nc");
  CHECK(kindOf("%\nO10 (A (NESTED) COMMENT)\nG103 P1\nN10 M30\n%\n") == "nc");
  // A name that says NC keeps what is written wrongly, so that it is reported.
  CHECK(kindOf("G0 X1,5\n", "A.NC") == "nc");
  CHECK(kindOf("(NOTHING YET)\n", "O7310") == "nc");
  CHECK(kindOf("(NOTHING YET)\n") == kNone);
  CHECK(kindOf("X1. Y2.\nX3. Y4.\n") == kNone); // a table of points
}

TEST_CASE("input kind: other controls' languages are none, whatever their file is called") {
  const std::vector<std::pair<std::string, std::string>> dialects = {
      {"%_N_WEB_MPF\n;$PATH=/_N_MPF_DIR\nN10 G54 G90\nN20 G1 X10 F100\nM30\n", "Sinumerik"},
      {"DEF REAL _A\nPROC WEB(REAL X)\nG0 X=_A\nG1 X10\nRET\n", "Sinumerik"},
      {"G17 G40\nT=\"CUTTER\"\nM6\nS3000 M3\nG0 X0 Y0\nCYCLE81(50,0,2,-10,)\nM30\n", "Sinumerik"},
      {"R1=5 R2=10\nG1 X=R1 Y=R2 F500\nIF R1>5 GOTOF L1\nL1:\nM17\n", "Sinumerik"},
      {"0 BEGIN PGM WEB MM\n1 TOOL CALL 1 Z S2000\n2 L X+10 R0 FMAX M3\n3 END PGM WEB MM\n", "Heidenhain"},
      {"LBL 1\nL Z+50 R0 FMAX\nL X+10 Y+20 FMAX\nLBL 0\n", "Heidenhain"},
      {"%WEB G71 *\nN10 G30 G17 X+0 Y+0 Z-20*\nN20 T1 G17 S2000*\nN30 G00 Z+100*\n", "Heidenhain"},
      {"$WEB.MIN%\nO100\nVC1=10\nIF [VC1 EQ 0] NEND\nCALL O2000 PX=VC1\nNEND M02\n", "Okuma"},
      {"G15 H1\nVC10=VZOFX[1]\nG0 X=VC10\nIF [VC10 GT 5] N100\nN100 RTS\n", "Okuma"},
      {"o<web> sub\n#<_d> = 10\nG38.2 X[#<_d>] F100\no<web> endsub\nM2\n", "LinuxCNC"},
      {"O100 SUB\nG0 X1\nO101 IF [#1 GT 0]\nG0 X0\nO101 ENDIF\nO100 ENDSUB\n", "LinuxCNC"},
      {"%00341\nN10 T2.2 (FINISH)\nN20 M6\nN30 G0 G90 G43 Z80 S900 M3\nN40 G81 G99 X5 Y4 Z2 I-9\nN50 M30\n",
       "Fagor"},
      {"_FACE_CUT(1,0,12,\"<none>\",,)\nDEPTH=3\nG500\nM17\n", "Sinumerik (Siemens)"},
      {"M4012 P3 R8 S\"Ball D=6\"\nG1 X4\nM4003 V\"v1.2\"\n", "RepRapFirmware (Duet)"},
      {"//CONDITIONS\nE001=12 15 11 07;FIRST\nE011=9 12;SECOND\n#10=3.5 ;SLOT\nG1X#10F8\nM30\n",
       "a wire EDM (AccuteX and the like)"},
      {"%\nN0000P00001010\nN0012P4\nN1010A1P3\nN1020A1P88A2P90\nN1023A1P1A2P2\nN1420A1P10000A2P12.5\n%\n",
       "the parameter memory of a control, not for running"},
      {"%WEB,MX,\n(P1=10)\n(IF P1 EQ 0 GOTO N10)\nG1 X P1 F100\nN10 M30\n", "Fagor"},
      {";LAYER_COUNT:3\nM104 S200\nG28 ;home\nG1 X10 Y10 E0.5\nG1 X20 Y10 E1.0\n", "3D printer"},
      {"G21\nG90\nM82\nG28 X0 Y0\nG92 E0\nG1 F200 E3\nG92 E0\n", "3D printer"},
      {"M851 Z-1.2\nM500\nM420 S1\n", "3D printer"},
      {"M92 X80 Y80 Z400 E93\nM205 X8 Y8\nM500\n", "3D printer"},
      {"G90\nM83\nM584 X0 Y1 Z2 E3\nM350 X16 Y16\nM906 X800 Y800\n", "RepRapFirmware"},
      {"G91 ; relative\nG21 ; mm\nG38.2 X-50 F100 ; probe\nG90\nM30 ; end\n", "LinuxCNC"},
      {"$H\n$X\nG21 G90\nG0 X5\nG1 X10 F100\nM30\n", "Grbl"},
      {"if { move.axes[0].homed }\n  G0 X10\nvar w = 5\nG1 X{var.w} F100\n", "RepRapFirmware"},
      {"(test)\n#1 = 5\n#2 = 6\n  o100 if [#1 GT 2]\n#3 = 7\n  o100 else\n#3 = 8\n  o100 endif\nM2\n",
       "LinuxCNC"}};
  for (const auto& [text, name] : dialects)
    for (const char* file : {"", "O7310", "WEB.NC", "WEB.MPF"}) {
      const std::string found = kindOf(text, file);
      CHECK_MESSAGE((found.starts_with("none: ") && found.find(name) != std::string::npos), text << found);
    }
  // Codes of a builder beside those of a control.
  CHECK(kindOf("O1\nM82\nM84\nM107\nM106\nG0 X10.\nM82\nM84\nM107\nM30\n") == "nc");
  // Comments are no language.
  CHECK(kindOf("G21 ; millimetres\nG90 G54 ; absolute\nG0 X10. ; start\nG1 X20. F100 ; cut\nM30 ; end\n") ==
        "nc");
  CHECK(kindOf("// face\nG21 G90\nG0 X10.\nG1 X20. F100\nM30\n") == "nc");
  CHECK(kindOf(kMacro + "(IF J = 0 GOTO N98)\n(P1=FIRST TOOL)\n(CALL 9810)\n") == "nc");
  // What shows it is named with its lines.
  const auto lathe =
      dotek::project::foreignLanguage("O1\nVC1=5\nG0 X=VC1\nIF [VC1 EQ 5] NEND\nCALL O20\nNEND M2\n");
  REQUIRE(lathe);
  CHECK(lathe->name == "Okuma OSP");
  CHECK(lathe->lines == "line 2 `VC1=5`, line 4 `IF [VC1 EQ 5] NEND`, line 5 `CALL O20`");
  // A slip in a program of Macro B does not make it one of them.
  CHECK(kindOf(replaced(kMacro, "G0Z50.", "G0 Z=50.")) == "nc");
  CHECK(kindOf(replaced(kMacro, "G90\n", "G90 ;absolute\n")) == "nc");
  CHECK(kindOf(replaced(kMacro, "(WEB WIDTH)", "(NOT FOR CYCLE81( OR TOOL CALL)")) == "nc");
}

TEST_CASE("input kind: macros, dialogs, definitions and Progs without their names") {
  CHECK(kindOf(
            "x = 1\nif x > 3 then message \"too big\"\nget_op_data iop, tool_num, t\n:again\ngoto again\n") ==
        "mac");
  CHECK(kindOf("! times\nGLOBAL a, b$\nFOR i = 1 TO n\n  GET_OP_DATA i, TIME, t\n  IF t > 3, THEN n = n - 1\n"
               "NEXT i\n") == "mac");
  CHECK(kindOf("r1 = 5\nif r1 > 4 then goto L1\n:L1\n", "a.mac") == "mac");
  CHECK(kindOf("a = b + 1\nc = a * 2\n", "constants.mac") == "mac");
  CHECK(kindOf("x=1\ny=2\nz=x+y\n", "constants.mac") == "mac");
  CHECK(kindOf("r1 = 5\nr2 = 6\n", "constants.mac") == "mac");
  CHECK(kindOf("proc = callback_proc\nget_proc_data proc, TOOL_NUM, cycle\ntrans = 3\n") == "mac");
  CHECK(kindOf("dialog \"Web\", 30, 50, 400, 520\nlabel 20, 25, 350, 24, \"D\"\ninput 80, 20, 70, 24, D, D\n"
               "ok 1, 2, 70, 24\n") == "dlg");
  CHECK(kindOf("LABEL 20, 25, 350, 24, \"D\"\nRADIO 80, 20, 70, 24, D, D\nSET_STATE D = 1, x, SHOW\n") ==
        "dlg");
  CHECK(kindOf("D = 10 ! width\nZ=-5.5\n") == "define");
  CHECK(
      kindOf("#1 = '###.##;0'\nFORMAT(OpFieldData#,1)\nprogStart:\n '%' EOL\n SeqC SpinOff EOL\nRETURN\n") ==
      "prog");
  CHECK(kindOf("probe:\nIF CycleType?('X') AND NotFirst?\n ' G65 P9023 X'OpFieldData#('X') EOL\nELSE\n"
               " SeqC RapidMove EOL\nEND\nRETURN\n{ a comment\n over lines }\n") == "prog");
  CHECK(kindOf("{ never closed\nprobe:\n SeqC ' M5' EOL\nRETURN\n") == "prog");
  CHECK(kindOf("N10 G18 G90\nN20 P1=100 ;feed\nN30 G1 X10 FP1\nN40 M25 @web.sou;record\nN50 M30\n") == "suf");
  CHECK(kindOf("N10 G18 G90 ;start\nN20 G0 X10 Z5 ;rapid\nN30 M30 ;end\n", "WEB.SUF") == "suf");
  const std::string post =
      "/**\n  A post.\n*/\nvar xFormat = createFormat({decimals:3});\n\nfunction onSection() {\n"
      "  if (isFirstSection()) {\n    writeBlock(\"G54\");\n  }\n}\n";
  CHECK(isPost(recognise("mill.cps", post)));
  CHECK(isPost(recognise("mill.txt", post)));
  const std::string part =
      "// a part of a post\nfunction probeX(cycle, x) {\n  writeBlock(\"G65\", \"P9811\");\n  return x;\n}\n";
  CHECK(isPost(recognise("part.js", part)));
  const std::string arrows =
      "const probeX = (x, y) => {\n  writeBlock(\"G65\", \"P9811\", `X${xyzFormat.format(x)}`);\n};\n";
  CHECK(isPost(recognise("part.js", arrows)));
  CHECK_FALSE(
      isPost(recognise("other.js", "const sum = (a, b) => {\n  return a + b;\n};\nexport default sum;\n")));
  // What is called a post by mistake.
  CHECK(kindOf("%\nO1001\nG65 P9810 Z5. F1000.\nG0 X10.\nM30\n%\n", "mill.cps") == "nc");
}

TEST_CASE("input kind: what Dotek and others write beside programs is none") {
  for (const char* text :
       {"O7310.nc:3:1: warning: something is doubtful [code]\n  3 | G65 P9810\n    | ^^^^^\n",
        "# Macros\n\nLoad them.\n\n```\n%\nO7310\nG0 X1.\nG0 X2.\nG1 X4.\nM30\n%\n```\n",
        "How to use these macros\n\nLoad O7310 to the control.\n\n    %\n    O7310\n    M99\n    %\n\nThen "
        "call it.\n",
        "O7310 web\nO7311 boss\nO7312 bore\n", "a,b,c\n1,2,3\n", "[a]\nx = 1\ny = 2\n",
        "all: x\n\tgcc -o x x.c\n", "a: 1\nb:\n  - x\n", "%\n\\begin{document}\n%\nHello\n%\n",
        "local x = 1\nif x > 2 then\n  print(x)\nend\n", "a = foo(1)\nb = bar(2)\nexport default a\n",
        "z -55\ny -9\nx 9\n"})
    CHECK_MESSAGE(kindOf(text) == kNone, text);
  const std::string code = "none: source code of another language";
  CHECK(kindOf("var a = 1;\nfunction f(x) {\n  if (x == 3) { return x; }\n}\n") == code);
  CHECK(kindOf("var a = 1;\nfunction f(x) { return 3; }\n", "web.SUF") == code);
  CHECK(kindOf("Dim x As Integer\nFor i = 1 To 10\nIf x = 3 Then y = 4\nNext i\nEnd Sub\n") == code);
  CHECK(kindOf("{\n  \"schema\": 1,\n  \"lines\": [1, 2]\n}\n") == "none: JSON");
  CHECK(kindOf("[\n  {\"a\": 1}\n]\n") == "none: JSON");
  CHECK(kindOf("[]\n") == "none: JSON");
  CHECK(kindOf("<svg xmlns=\"x\">\n<path d=\"M0 0\"/></svg>\n") == "none: an SVG picture");
  CHECK(kindOf("<!doctype html><html></html>\n") == "none: HTML or XML");
  CHECK(kindOf("schema = 1\n[lint]\ncontrol = \"x\"\n") == "none: settings in TOML");
  const std::string toml = "schema = 1\n[lint.severity]\ngoto-target-missing = \"note\"\n";
  CHECK(kindOf(toml) == "none: settings in TOML");
  CHECK(kindOf(toml, "./web.toml") == "none: settings in TOML");
  CHECK(kindOf("if x then\n  y = 2\nend if\n", "a/dotek.toml") == "none: settings in TOML");
  CHECK(kindOf("schema = 1\n\n# what is read\n[lint]\nselect = [\n  \"if-x\", # why\n  \"message-x\",\n]\n"
               "[[lint.path]]\npath = \"a/**\"\nend-of = 1\nmessage-too-long = \"off\"\n") ==
        "none: settings in TOML");
  CHECK(kindOf("[goto]\ngoto-a = 1\nif-b = 2\nmessage-c = \"x\"\n", "shop.ini") == kNone);
  CHECK(kindOf("This is a letter to the shop.\nPlease check the program and call me.\n", "WEB.NC") == kNone);
}

TEST_CASE("input kind: text of people is no program of another control") {
  CHECK(kindOf("# Shop\n\n    $ dotek lint x\n    $ ls\n", "README.md") == kNone);
  CHECK(kindOf("Notes:\n\nlint:\n  run dotek\nconvert:\n  run it\nend:\n", "n") == kNone);
  CHECK(kindOf("code-one        warning  LET the probe go down before it moves to the side\n"
               "code-two        note     RTS is a word of another control, and so is this\n"
               "LET it be known that nobody reads this list of rules\n"
               "RTS ends it for all of them, as the last line of it\n",
               "rules") == kNone);
  CHECK(kindOf("--- web.nc\n+++ web.nc\n@@ -1,3 +1,3 @@\n %\n-O7310\n+O07310\n G65P9810Z-5.F1000\n", "p") ==
        kNone);
  // Programs of other controls with remarks.
  CHECK(kindOf("; this line says what the program does\nR1=5\nLOOP:\nG1 X=R1\nR1=R1+1\nGOTOB LOOP\nM30\n")
            .find("Sinumerik") != std::string::npos);
  CHECK(kindOf("$H\n$X\nG0 X5\n$$\n").find("Grbl") != std::string::npos);
}

TEST_CASE("input kind: sentences about variables are no program") {
  for (const char* text :
       {"#7 = diameter\n#24 = X target\n#26 = Z depth\n", "#7=5 works\n#7=0 does not\n",
        "if #7 is empty then the macro stops.\nUse #7=5.\n",
        "IF #7 EQ #0 GOTO 10 is wrong, brackets are missing.\n",
        "#101 = measured width, #102 = its middle\nboth in mm\n", "In #7 is the diameter.\n"}) {
    CHECK_MESSAGE(kindOf(text) == kNone, text);
    CHECK_MESSAGE(recognise("notes.txt", text, InputKind::Nc).kind == std::nullopt, text);
  }
  // A slip makes no sentence of a program, and neither does one that is all of a program with its name.
  CHECK(kindOf("#7 = #24 + offset\nG0 X#7\nM99\n") == "nc");
  CHECK(kindOf("#7 = #24 + offset\nM99\n") == "nc");
  CHECK(kindOf("O7310\nIF [#7 IS #0] GOTO 5\n") == "nc");
  CHECK(kindOf("#7 = diameter\n", "O7310") == "nc");
  CHECK(kindOf("if [#1 eq #0] goto 10\nwhile [#2 lt round [#3]] do 1\n#2 = #2 mod 3 (counts)\nend 1\n") ==
        "nc");
}

TEST_CASE("input kind: what dump prints is an output") {
  const std::string output = "none: what `dotek dump --stage ir` prints, an output of Dotek";
  CHECK(kindOf("program 9100                   ; a.nc:2\n  comment \"A\"\n  body\n    if #25 is not #0 goto "
               "next1\n",
               "a.nc") == output);
  CHECK(kindOf("program\r\n  body\r\n    G0 X[1.]\r\n") == output);
  CHECK(kindOf("units mm\n\ncycle \"surface-x\" \"Surface along X\"\n  parameter X length in mm = 12\n") ==
        output);
}

TEST_CASE("input kind: bytes that are no text, and no bytes at all") {
  CHECK(kindOf("") == "none: empty");
  CHECK(kindOf(" \r\n\n") == "none: empty");
  CHECK(kindOf("", "O7310") == "nc"); // its reader says that it is empty
  CHECK(kindOf("", "a.mac") == "mac");
  CHECK(kindOf(std::string("\x89PNG\r\n\x1A\n\0\0", 10)) == "none: an image");
  CHECK(kindOf(std::string("BM\x36\0\0\0\0\0\0\0\x36\0", 12)) == "none: an image");
  std::string all;
  for (int i = 0; i < 2560; ++i)
    all += static_cast<char>(i % 256);
  CHECK(kindOf(all) == "none: binary data");
  // The reader refuses UTF-16; that the text is meant for Dotek is known.
  CHECK(kindOf("\xFF\xFE" + wide(kMacro, false)) == "nc");
  CHECK(kindOf(wide(kMacro, true)) == "nc");
  CHECK(kindOf("\xFF\xFE" + wide("Dear shop, this is a letter.\n", false)) ==
        "none: UTF-16 text; save it as ANSI or UTF-8");
}

TEST_CASE("input kind: the reason says what was counted") {
  CHECK(recognise("", "N10 G0 X1.\nG0 X1,5\nM30\n").reason == "2 of 3 lines are blocks of NC");
  CHECK(recognise("", "GOTOF END\nG1 X=R1\n").reason == "Sinumerik (Siemens)");
}

TEST_CASE("input kind: what explain prints of a macro is no macro") {
  const std::string text =
      "include-loop: error\n\n"
      "#INCLUDE copies the lines of the file. A file that includes itself, directly or through\n"
      "others, has no end.\n\nExample:\n\n    #INCLUDE \"self.mac\"\n\n"
      "Repair: take the #INCLUDE out.\n";
  CHECK(kindOf(text).starts_with("none: "));
  CHECK(kindOf("#INCLUDE \"my file.mac\"\n#include limits.mac\n") == "mac");
}

TEST_CASE(
    "input kind: of a long program of macro B the first lines decide, of any other text all are asked") {
  std::string programs, blocks, foreign;
  for (int i = 0; i < 40; ++i)
    programs += kMacro;
  for (int i = 0; i < 600; ++i)
    blocks += "G1 X" + std::to_string(i) + ". Y2. F300\n";
  for (int i = 0; i < 600; ++i)
    foreign += "IF R1>5 GOTOF END1\nCYCLE81(50,0,2,-10)\n";
  CHECK(recognise("a.nc", programs).reason == "250 of 250 lines are blocks of NC");
  CHECK(recognise("a.xyz", programs).reason == "600 of 600 lines are blocks of NC");
  CHECK(kindOf(programs + foreign, "a.nc") == "nc");
  CHECK(kindOf(programs.substr(0, 900) + foreign, "a.nc") == "none: Sinumerik (Siemens)");
  CHECK(kindOf("%\nO1\n" + blocks + foreign, "a.nc") == "none: Sinumerik (Siemens)");
}
