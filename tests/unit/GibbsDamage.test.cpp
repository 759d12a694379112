#include "tests/Draws.h"
#include "tests/unit/GibbsHarness.h"

#include <doctest/doctest.h>

#include <cstdint>

using namespace dotek;
using namespace dotek::tests;
using namespace dotek::frontend::gibbs;

namespace {

// A fixed sequence, so that a failure comes again.
class Sequence {
public:
  std::uint32_t next(std::uint32_t bound) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<std::uint32_t>(state_ >> 33U) % bound;
  }

private:
  std::uint64_t state_ = 42;
};

void readAs(const std::string& text, Encoding encoding) {
  GibbsHarness h;
  const FileId file = h.add(text, "x", encoding);
  Cycle cycle;
  cycle.cycleData = parseMacro(file, h.context());
  cycle.dialog = parseDialog(file, h.context());
  cycle.defineData = parseDefineData(file, h.context());
  checkMacro(*cycle.cycleData, {&*cycle.cycleData}, h.context());
  checkDialog(*cycle.dialog, h.context());
  checkDefineData(*cycle.defineData, h.context());
  checkCycle(cycle, h.context());
  declaredFields(cycle);
  dumpTokens(file, h.context());
  dumpAst(*cycle.cycleData, h.sources);
  dumpAst(*cycle.dialog, h.sources);
  for (const Diagnostic& d : h.diagnostics.all()) {
    CHECK(d.range.begin <= d.range.end);
    CHECK(d.range.end <= text.size());
    CHECK(!d.message.empty());
  }
}

const char* const kSample =
    "!start\nlocal a(5), k$\nfor i = 1 to 5 step -2\nif abs(i) <= (3+x)*2, then a(i) = -i/.5\nnext i\n"
    ":again\ngoto again\ncontour\n[\nstart 0, 0\n]\nif not i = 1 and k$ = \"q\"\"r\" then\n[\ncall b\\c.mac, "
    "1\n] else [\n"
    "message 'x' + k$\n]\nadd_ path feed_ x, 1\n#include \"d.mac\"\ndialog \"T\", 1, 2, 3, 4\nset_state a = "
    "1, ok, hide\n"
    "frame 1, 2, 3, 4, loose words\ninput 1, 2, 3, 4, q, -5\ndepth = -5\n";

} // namespace

TEST_CASE("gibbs: mutated text never crashes") {
  Sequence random;
  const std::string sample = kSample;
  const std::string pieces[] = {"(",   ")", "[",    "]",  "\n",   "\r",   "\"",           "'",   ",", "=",
                                "!",   ":", "THEN", "IF", "else", "\x84", "\xE2\x80\x9C", "a_ ", "#", "next",
                                "1e9", "."};
  for (int round = 0; round < draws(1500); ++round) {
    std::string text = sample;
    for (std::uint32_t edit = 0; edit <= random.next(6); ++edit) {
      if (text.empty()) break;
      const std::size_t at = random.next(static_cast<std::uint32_t>(text.size()));
      switch (random.next(4)) {
      case 0: text.erase(at, 1 + random.next(8)); break;
      case 1: text.insert(at, pieces[random.next(std::size(pieces))]); break;
      case 2: text[at] = static_cast<char>(random.next(256)); break;
      default: text.resize(at + 1); break;
      }
    }
    readAs(text, round % 2 == 0 ? Encoding::Utf8 : Encoding::Cp1250);
  }
}

TEST_CASE("gibbs: random bytes never crash") {
  Sequence random;
  for (int round = 0; round < draws(500); ++round) {
    std::string text;
    for (std::uint32_t i = random.next(200); i > 0; --i)
      text += static_cast<char>(1 + random.next(255));
    readAs(text, Encoding::Cp1250);
  }
}

TEST_CASE("gibbs: every prefix of a macro is read with an error at its end or none") {
  const std::string sample = "a = abs(b-1)\nif a < 3 then goto on\n:on\nmessage \"x\"\n";
  for (std::size_t size = 1; size < sample.size(); ++size) {
    GibbsHarness h;
    h.macro(sample.substr(0, size));
    CHECK(h.errors() <= 1);
    for (const Diagnostic& d : h.diagnostics.all())
      CHECK(h.sources.line(d.range) == h.sources.file(0).lineOf(static_cast<std::uint32_t>(size)));
  }
}
