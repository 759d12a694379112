// The machine of Mikroprog tells its motions to a watcher, and writes a trace.
#include "MikroprogHelper.h"

using namespace dotek;
using namespace dotek::tests;
using sim::Ending;
using sim::MotionKind;

namespace {

struct Watched : MikroprogRun, sim::SkipSignal {
  std::string told, trace;
  std::optional<double> share;
  bool there = false;
  int stopAt = 0, moves = 0;

  explicit Watched(const std::string& text, std::string_view name = "mikroprog-mill")
      : MikroprogRun(text, loadMikroprog(name)) {
    machine.setSkipSignal(this);
  }
  void traced() {
    sim::Trace lines([&](std::string_view piece) { trace += piece; });
    machine.setTrace(&lines);
    start();
    machine.setTrace(nullptr);
    lines.flush();
  }
  void moved(const sim::MachineMotion& motion) override {
    static constexpr std::string_view kNames[] = {"rapid", "feed", "skip"};
    told += fmt::format("{}{} {:g} {:g} {:g} line {}", told.empty() ? "" : "; ",
                        kNames[static_cast<int>(motion.kind)], motion.to[0], motion.to[1], motion.to[2],
                        motion.line);
    CHECK(motion.known);
    if (++moves == stopAt) machine.inconclusive("enough");
  }
  std::optional<double> contact(const sim::SkipMove& move) override {
    meant.push_back(move.positions);
    return share;
  }
  bool isThere(const sim::SkipMove& here) override {
    CHECK(here.machineFrom == here.machineTo);
    return there;
  }
  std::vector<bool> meant;
};

constexpr const char* kProgram =
    "N10 G90 G94\r\nN20 G0 X5 Y3\r\nN30 G1 Z-2 F100\r\nN40 G31 X9 L90\r\nN50 M25 @A.SOU\r\n"
    "N60 G92 X1\r\nN70 G0 X2\r\nN80 M30\r\nN90 M0 ;NIC\r\nN95 M30\r\n";

} // namespace

TEST_CASE("mikroprog: a watcher sees rapids, feeds and probe moves in coordinates of the machine") {
  Watched w(kProgram);
  w.share = 0.5;
  w.machine.startAt({0, 0, 10});
  w.traced();
  CHECK(w.ending() == Ending::ProgramEnd);
  CHECK(w.told == "rapid 5 3 10 line 2; feed 5 3 -2 line 3; skip 7 3 -2 line 4; rapid 8 3 -2 line 7");
  CHECK(w.trace ==
        "rapid X5.000000 Y3.000000 Z10.000000\nfeed X5.000000 Y3.000000 Z-2.000000 F100.000000\n"
        "skip X9.000000 Y3.000000 Z-2.000000 contact X7.000000 Y3.000000 Z-2.000000\n"
        "record A.SOU X7.000000 Y3.000000 Z-2.000000\n"
        "set-position X1.000000 Y3.000000 Z-2.000000\nrapid X2.000000 Y3.000000 Z-2.000000\nend\n");
  CHECK(w.machine.blocks() == 8);
}

TEST_CASE("mikroprog: with a watcher the signal is for probe moves alone") {
  Watched w(kProgram); // no signal: the tail
  w.traced();
  CHECK(w.lastStop() == "NIC");
  CHECK(w.trace.find("no-contact X9.000000") != std::string::npos);
  CHECK(w.trace.ends_with("stop NIC\nend\n"));
}

TEST_CASE("mikroprog: O7 asks whether the probe is deflected, not for a touch") {
  for (const bool there : {false, true}) {
    Watched w("N10 G23 L40 O7\r\nN20 M0 ;FREI\r\nN30 M30\r\nN40 M0 ;DOTYK\r\nN50 M30\r\n");
    w.share = 0.0; // would be a contact
    w.there = there;
    w.traced();
    CHECK(w.lastStop() == (there ? "DOTYK" : "FREI"));
  }
}

TEST_CASE("mikroprog: who watches may end the run, calls are known while they are open") {
  Watched w("N10 G90\r\nN20 G26 L100\r\nN30 M30\r\nN100 G0 X1 Y1\r\nN110 G26 L200\r\nN120 M17\r\n"
            "N200 G0 X2\r\nN210 M17\r\n");
  w.stopAt = 2;
  w.traced();
  CHECK(w.ending() == Ending::Inconclusive);
  CHECK(w.why() == "enough");
  CHECK(w.line() == 7);
  std::vector<std::uint32_t> calls;
  for (const SourceRange& call : w.run->openCalls())
    calls.push_back(w.sources.line(call));
  CHECK(calls == std::vector<std::uint32_t>{2, 5});
  Watched probe("N10 G90 G94\r\nN20 G31 X9 Y1 L40\r\nN30 M30\r\nN40 M30\r\n");
  probe.stopAt = 1;
  probe.traced();
  CHECK(probe.why() == "enough");
}

TEST_CASE("mikroprog: a move whose contact leads to a stop is meant to meet nothing") {
  Watched w("N10 G31 Z5 L30\r\nN20 G27 L90\r\nN30 G31 X9 L90\r\nN40 M30\r\nN90 M0\r\nN95 M30\r\n");
  w.traced();
  CHECK(w.meant == std::vector<bool>{true, false});
}
