// Numbers of blocks given anew: what follows them, and what is refused.
#include "frontend/macrob/Renumber.h"
#include "tests/unit/MacroBHelper.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <random>

using namespace dotek;
using namespace dotek::tests;
using frontend::macrob::RenumberOptions;

namespace {

// "": refused, with the message in `why`.
std::string renumbered(const std::string& text, const RenumberOptions& options = {},
                       std::string* why = nullptr) {
  MacroFile file(text);
  const auto out = frontend::macrob::renumber(file.file, options, file.sources, file.diagnostics);
  if (why != nullptr)
    for (const Diagnostic& one : file.diagnostics.all())
      *why += one.message;
  return out.value_or("");
}

bool refused(const std::string& text) {
  std::string why;
  return renumbered(text, {}, &why).empty() && !why.empty();
}

} // namespace

TEST_CASE("renumber follows each way to name a block") {
  CHECK(renumbered("O1\nN5 GOTO 5\n") == "O1\nN10 GOTO 10\n");
  CHECK(renumbered("O1\nN7 X1.\nIF[#1 EQ 2]GOTO 7\nIF[#1 EQ 2]THEN GOTO 7\n") ==
        "O1\nN10 X1.\nIF[#1 EQ 2]GOTO 10\nIF[#1 EQ 2]THEN GOTO 10\n");
  CHECK(renumbered("O1\nN7 X1.\n#3=7\nGOTO#3\n") == "O1\nN10 X1.\n#3=10\nGOTO#3\n");
  CHECK(renumbered("O1\nN7 X1.\n#3=#4114\nGOTO#3\n") == "O1\nN10 X1.\n#3=#4114\nGOTO#3\n");
  CHECK(renumbered("O1\nN7 X1.\nIF[#[4000+114]NE 7]GOTO 7\n") ==
        "O1\nN10 X1.\nIF[#[4000+114]NE 10]GOTO 10\n");
  CHECK(renumbered("O1\nM97 P7\nM30\nN7 X1.\nM99\n") == "O1\nM97 P10\nM30\nN10 X1.\nM99\n");
  CHECK(renumbered("O1\nM98 Q7 L2\nM30\nN7 X1.\nM99\nO2\nN7 M99\n") ==
        "O1\nM98 Q10 L2\nM30\nN10 X1.\nM99\nO2\nN10 M99\n");
  CHECK(renumbered("O1\nN7 X1.\nM99 P7\n") == "O1\nN10 X1.\nM99 P10\n");
  CHECK(renumbered("O1\nG71 P7 Q8 U1.\nN7 X1.\nN8 Z1.\n") == "O1\nG71 P10 Q20 U1.\nN10 X1.\nN20 Z1.\n");
  CHECK(renumbered("O1\nG73 X1. Z-2. R1. P7 Q8 F1.\nN7 X1.\nN8 Z1.\n") ==
        "O1\nG73 X1. Z-2. R1. P7 Q8 F1.\nN10 X1.\nN20 Z1.\n");
  // P of M99 is a block of the caller.
  CHECK(renumbered("O1\nM98 P2\nN3 X1.\nN4 M30\nO2\nN4 X2.\nM99 P4\n") ==
        "O1\nM98 P2\nN10 X1.\nN20 M30\nO2\nN10 X2.\nM99 P20\n");
}

TEST_CASE("renumber follows returns and calls from one file to another") {
  struct Several {
    explicit Several(const std::vector<std::string>& texts) {
      std::vector<frontend::macrob::File> files;
      for (const std::string& text : texts)
        files.push_back(frontend::macrob::parse(sources.add(SourceFile("O.nc", text, Encoding::Utf8)),
                                                sources, Limits(), diagnostics));
      std::vector<frontend::macrob::RenumberInput> inputs;
      for (const frontend::macrob::File& file : files)
        inputs.push_back({&file, {}});
      for (const auto& out : frontend::macrob::renumber(inputs, sources, diagnostics))
        result.push_back(out.value_or(""));
    }
    std::size_t count(std::string_view code) const {
      return static_cast<std::size_t>(std::count_if(diagnostics.all().begin(), diagnostics.all().end(),
                                                    [&](const Diagnostic& one) { return one.code == code; }));
    }
    SourceMap sources;
    Diagnostics diagnostics;
    std::vector<std::string> result;
  };
  using Texts = std::vector<std::string>;
  const std::string main = "O1\nN20 G65 P9600 A1.\nN25 X1.\nN30 M30\n";
  const std::string called = "O9600\nN7 X1.\nM99 P30\n";
  const Texts fresh{"O1\nN10 G65 P9600 A1.\nN20 X1.\nN30 M30\n", "O9600\nN10 X1.\nM99 P30\n"};
  CHECK(Several({main, called}).result == fresh);
  CHECK(Several({called, main}).result == Texts{fresh[1], fresh[0]});
  CHECK(Several({"O1\nN20 M98 P9600\nN40 M30\n", "O9600\nM99 P40\n"}).result ==
        Texts{"O1\nN10 M98 P9600\nN20 M30\n", "O9600\nM99 P20\n"});
  CHECK(Several({"O1\nM98 P9600 Q7\nM30\n", "O9600\nN7 M99\n"}).result ==
        Texts{"O1\nM98 P9600 Q10\nM30\n", "O9600\nN10 M99\n"});
  CHECK(Several({main, called}).diagnostics.all().empty());

  // A caller by itself: what is called may return to an old number.
  CHECK(Several({main}).result.front() == fresh[0]);
  CHECK(Several({main}).count("renumber-calls") == 1);
  CHECK(Several({"O1\nG65 P#1\nN7 M30\n"}).count("renumber-calls") == 1);
  CHECK(Several({"O1\nG65 P9600\nG65 P9601\nN10 M30\n"}).count("renumber-calls") == 0); // nothing changes
  CHECK(Several({main, "O2\nN1 M30\n"}).count("renumber-calls") == 1);
  // The caller is not there, is not certain, or there are two whose numbers differ.
  for (const Texts& texts :
       {Texts{called}, Texts{called, "O2\nN30 M30\n"}, Texts{main, called, called},
        Texts{main, called, "O2\nN1 X1.\nN30 G65 P9600\nM30\n"},
        Texts{main, called, "O2\nN1 X1.\nN30 G65 P#1\nM30\n"}, Texts{main, "O9600\nM99 P#1\n"}})
    CHECK(Several(texts).count("not-renumbered") > 0);
  CHECK(Several({main, called, "O2\nG65 P#1\nM30\n"}).count("not-renumbered") == 0);
  CHECK(Several({called}).diagnostics.all().front().message.find("in the same command") != std::string::npos);
}

TEST_CASE("renumber refuses what it cannot follow") {
  CHECK(refused("O1\nN7 X1.\nGOTO[#1+6]\n"));
  CHECK(refused("O1\nN7 X1.\nGOTO#100\n"));
  CHECK(refused("O1\nN7 X1.\nGOTO 8\n"));
  CHECK(refused("O1\nN7 X1.\n#3=7\nX#3\nGOTO#3\n"));
  CHECK(refused("O1\nN7 X1.\nGOTO#3\n")); // an argument
  CHECK(refused("O1\nN7 X1.\n#500=#4114\n"));
  CHECK(refused("O1\nN7 X1.\nM98 P3 Q7\n"));
  const std::string huge(55, '3');
  CHECK(refused("O1\nG71 P" + huge + " Q7 U1.\nN7 X1.\n"));
  CHECK(refused("O1\nN7 X1.\nM99 P" + huge + "\n"));
  CHECK(refused("O1\nN7 X1.\nM98 P" + huge + " Q7\n"));
  CHECK(refused("O1\nN7 X1.\n#" + huge + "=#4114\n"));
  CHECK(refused("O1\nN7 X1.\nN7 X2.\nGOTO 7\n"));
  CHECK(refused("O1\nM30\nO2\nN4 X2.\nM99 P4\n")); // of a caller in another file
  CHECK(renumbered("O1\nN7 X[\n").empty());
}

TEST_CASE("renumber puts numbers where there are none, and leaves a part alone") {
  RenumberOptions all;
  all.all = true;
  all.start = all.step = 5;
  CHECK(renumbered("%\nO1(A)\n(B)\n/G0 X1.\n/2 X2.\n#1=2\nN3 M30\n%\n", all) ==
        "%\nO1(A)\n(B)\n/N5 G0 X1.\n/2 N10 X2.\nN15 #1=2\nN20 M30\n%\n");
  RenumberOptions part;
  part.range = std::pair(20, 30);
  part.start = 500;
  CHECK(renumbered("O1\nN10 GOTO 30\nN20 X1.\nN30 X2.\nN40 M30\n", part) ==
        "O1\nN10 GOTO 510\nN500 X1.\nN510 X2.\nN40 M30\n");
  part.start = 30; // N40 outside would be there twice
  CHECK(renumbered("O1\nN20 X1.\nN30 X2.\nN40 M30\n", part).empty());
  RenumberOptions steep;
  steep.last = 15;
  CHECK(renumbered("O1\nN1 X1.\nN2 X1.\n", steep).empty());
}

TEST_CASE("a renumbered program jumps as before: random programs") {
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    const int blocks = 2 + static_cast<int>(random() % 12);
    std::vector<int> numbers;
    for (int i = 0; i < blocks; ++i)
      numbers.push_back(i * 7 + 1 + static_cast<int>(random() % 7));
    std::shuffle(numbers.begin(), numbers.end(), random);
    std::vector<int> targets;
    std::string text = "O1\n";
    for (int i = 0; i < blocks; ++i) {
      targets.push_back(static_cast<int>(random() % static_cast<unsigned>(blocks)));
      text += "N" + std::to_string(numbers[static_cast<std::size_t>(i)]) + " X1.\nIF[#1 GT 2]GOTO " +
              std::to_string(numbers[static_cast<std::size_t>(targets.back())]) + "\n";
    }
    std::string expected = "O1\n";
    for (int i = 0; i < blocks; ++i)
      expected += "N" + std::to_string(10 + 10 * i) + " X1.\nIF[#1 GT 2]GOTO " +
                  std::to_string(10 + 10 * targets[static_cast<std::size_t>(i)]) + "\n";
    CHECK(renumbered(text) == expected);
  }
}
