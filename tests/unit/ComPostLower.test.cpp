// The branch of a Prog, lowered: which blocks, which fields, what is refused. The post is the other witness.
#include "frontend/compost/Lower.h"
#include "frontend/compost/Post.h"
#include "frontend/compost/Summary.h"
#include "ir/InferKinds.h"
#include "ir/Verify.h"
#include "support/messages/ComPost.h"
#include "support/messages/Commands.h"
#include "tests/Draws.h"
#include "tests/GoldenRunner.h"
#include "tests/unit/ComPostHelper.h"
#include "tests/unit/NcHelper.h"

#include <doctest/doctest.h>
#include <random>

namespace fs = std::filesystem;
using namespace dotek;
using namespace dotek::tests;
using namespace dotek::frontend;

namespace {

const std::string kPictures = "#1='###.##;0' FORMAT(OpFieldData#,1) ";

struct Lowering {
  Prog prog;
  stdlib::DataFiles files;
  stdlib::Form form = *stdlib::Form::load(files, "thesis-a");
  stdlib::Control control = *stdlib::Control::load(files, "fanuc-0i-md");
  stdlib::MacroSet easyprobe = *stdlib::MacroSet::load(files, "easyprobe");
  stdlib::MacroSet inspection = *stdlib::MacroSet::load(files, "inspection-plus");
  std::vector<const stdlib::MacroSet*> sets = {&easyprobe, &inspection};
  Limits limits;
  std::set<std::string> assumptions;
  std::map<std::string, double> fixed;
  std::set<std::string> noFields; // unknown to the cycle
  ir::Cycle cycle;
  std::optional<compost::Lowered> result;

  explicit Lowering(const std::string& text) : prog(text) {}

  std::optional<ir::VariableId> variable(const std::string& name, ir::Role role) {
    if (noFields.contains(name)) {
      prog.diagnostics.report<diag::UnknownHost>({}, name, "");
      return std::nullopt;
    }
    for (ir::VariableId id = 0; id < cycle.variables.size(); ++id)
      if (cycle.variables[id].name == name) return id;
    ir::Variable made;
    made.name = name;
    made.role = role;
    return cycle.add(made);
  }

  bool lower(const std::string& cycleId = "c", const std::string& routine = "r") {
    const compost::LowerSettings settings{
        prog.sources,
        form,
        limits,
        control,
        sets,
        assumptions,
        [this](const std::string& name, SourceRange) { return variable(name, ir::Role::Parameter); },
        [this](const std::string& name, SourceRange) { return variable(name, ir::Role::Host); },
        [this](ir::VariableId id) {
          const auto found = fixed.find(cycle.variable(id).name);
          return found == fixed.end() ? std::nullopt : std::optional<double>(found->second);
        }};
    result = compost::lowerRoutine(prog.program, *compost::findRoutine(prog.program, routine), cycleId, cycle,
                                   settings, prog.diagnostics);
    return result.has_value();
  }

  std::string shown() const {
    std::string out;
    for (const ir::CycleStatement& statement : result->body)
      out += show(statement, cycle) + "\n";
    return out;
  }

  // The posted lines with every field and host input `value`.
  std::vector<std::string> posted(const std::string& cycleId, const std::string& routine, double value) {
    Diagnostics diagnostics;
    const compost::PostSettings settings{prog.sources, form, limits, assumptions};
    compost::PostRun run(prog.program, settings, diagnostics);
    compost::Operation operation{cycleId, [value](const std::string&, SourceRange) { return value; }, {}};
    for (const auto& host : {"clearance", "tool_offset"})
      operation.hosts[host] = value;
    run.run(*compost::findRoutine(prog.program, routine), operation);
    std::vector<std::string> out;
    for (const compost::PostedLine& line : run.finish())
      out.push_back(line.text);
    CHECK_FALSE(diagnostics.hasErrors());
    return out;
  }
};

// Statements, or codes of the findings.
std::string lowered(const std::string& body, std::set<std::string> assumptions = {}) {
  Lowering one(kPictures + body);
  one.assumptions = std::move(assumptions);
  const bool ok = one.lower();
  std::string codes;
  for (const Diagnostic& d : one.prog.diagnostics.all())
    codes += (codes.empty() ? "[" : ", [") + std::string(d.code) + "]";
  if (!ok) return "refused: " + codes;
  return one.shown() + codes;
}

// What a pass may rely on holds of the lowered body.
void sound(const Lowering& one) {
  ir::Cycle cycle = one.cycle;
  cycle.body = one.result->body;
  ir::inferKinds(cycle);
  for (const ir::Violation& violation : ir::verify(cycle))
    FAIL_CHECK(violation.message);
}

// Every word of the posted blocks is in the addresses of the block's statements, or is a feed that the
// moves carry. Both walk the same text, so that a block more or fewer shows.
void sameWords(Lowering& one, const std::string& cycleId, const std::string& routine) {
  Nc nc;
  std::vector<std::string> wanted;
  for (const std::string& line : one.posted(cycleId, routine, 54)) {
    const auto block = nc.parse(line);
    REQUIRE(block);
    std::string letters;
    for (const nc::Word& word : block->words)
      letters += word.address;
    for (const nc::Assignment& assignment : block->assignments)
      letters += nc.sources.textUtf8(assignment.range);
    for (const nc::Comment& comment : block->comments)
      letters += "(" + comment.text;
    if (!letters.empty()) wanted.push_back(letters);
  }
  std::vector<std::string> found;
  std::uint32_t last = 0;
  for (const ir::CycleStatement& statement : one.result->body) {
    if (statement.origin.block == last && !found.empty()) continue;
    last = statement.origin.block;
    std::string letters = statement.origin.addresses;
    if (std::holds_alternative<ir::Store>(statement.node)) letters += "#550=#138";
    if (const auto* comment = std::get_if<ir::Comment>(&statement.node)) letters += "(" + comment->text;
    found.push_back(letters);
  }
  CHECK(found == wanted);
  CHECK(wanted.size() > 3);
  sound(one);
}

} // namespace

TEST_CASE("literals, fields and words of the form are joined up to EOL") {
  CHECK(
      lowered("r: ' (TEXT)' EOL SeqC ' G65 P9770 Z'OpFieldData#('Zb')'' EOL SeqC SpinOff EOL SeqLabC CoolOff "
              "EOL SeqC ' G65 P9770' ZCP1 ' F1000' EOL RETURN") ==
      "(TEXT)\nprotected Z=work:Zb\nspindle 0\ncoolant 0\nprotected Z=work:clearance F=1000\n"
      "[form-assumed], [picture-decimals]");
  CHECK(lowered("r: ' G43' ' H' ToolOffset# EOL RETURN") ==
        "opaque G43 Htool_offset\n[form-assumed], [opaque-block]");
  CHECK(lowered("r: p ' Y1.' EOL RETURN p: ' G0' q RETURN q: ' X1.' RETURN") == "rapid X=work:1 Y=work:1\n");
  CHECK(lowered("r: SeqC EOL ' ' EOL '' EOL RETURN") == "[empty-block]");
  CHECK(lowered("r: ' G0 X1.' RETURN") == "rapid X=work:1\n[unfinished-line]");
  CHECK(lowered("r: 'N10( TOOLS)' EOL RETURN") == "( TOOLS)\n");
}

TEST_CASE("conditions: the cycle, flags, the form, assumptions") {
  CHECK(lowered("r: IF CycleType?('c') 'M5' ELSE 'M9' END EOL RETURN") == "spindle 0\n");
  CHECK(lowered("r: IF NOT CycleType?('c') 'M5' ELSE 'M9' END EOL RETURN") == "coolant 0\n");
  CHECK(
      lowered("r: SetFlag('f') IF Flag?('f') 'M5' EOL END SetFlagF('f') IF Flag?('f') 'M9' EOL END RETURN") ==
      "spindle 0\n");
  CHECK(lowered("r: IF Flag?('f') 'M5' ELSE 'M9' END EOL RETURN q: SetFlag('f') RETURN") ==
        "coolant 0\n[flag-set-elsewhere]");
  CHECK(lowered("r: IF RigidTap? AND Odd? 'M5' ELSE 'M9' END EOL RETURN") == "coolant 0\n[form-assumed]");
  CHECK(lowered("r: IF Odd? 'M5' ELSE 'M9' END EOL RETURN", {"Odd?=yes"}) == "spindle 0\n");
  CHECK(lowered("r: IF Odd? 'M5' ELSE 'M9' END EOL RETURN") == "refused: [boolean-unknown]");
  CHECK(lowered("r: SetFlag 'M5' EOL RETURN") == "refused: [flag-needs-name]");
}

TEST_CASE("an undecided condition whose sides leave other modal codes says which") {
  const auto finding = [](const std::string& body) {
    Lowering one(kPictures + body);
    CHECK_FALSE(one.lower());
    REQUIRE(one.prog.diagnostics.all().size() == 1);
    return one.prog.diagnostics.all().front();
  };
  const Diagnostic distance = finding("r: IF Odd? 'G91 G0 Z1.' EOL ELSE 'G90' EOL END 'G0 X1.' EOL RETURN");
  CHECK(distance.code == "modal-state-differs");
  CHECK(distance.message.find("`G0` or what was before; `G91` or `G90`") != std::string::npos);
  REQUIRE(distance.notes.size() == 1);
  CHECK(distance.notes[0].message.find("--assume Odd?=yes") != std::string::npos);
  // A line that goes on after the condition, and a side in another routine.
  CHECK(finding("r: IF Odd? 'G91' ELSE 'G90' END ' G0 X1.' EOL RETURN").code == "modal-state-differs");
  CHECK(finding("r: IF Odd? p END RETURN p: 'G0' EOL IF CycleType?('c') 'G55' EOL END RETURN")
            .message.find("`G55` or what was before") != std::string::npos);
  CHECK(finding("r: IF Odd? 'G0 X1.' EOL ELSE 'G0 Y1.' EOL END RETURN").code == "boolean-unknown");
  // The comparison prints nothing and sets no flag.
  Lowering flags(kPictures + "r: IF Odd? SetFlag('f') 'M5' EOL END IF Flag?('f') 'M99' EOL END RETURN");
  CHECK_FALSE(flags.lower());
  CHECK(flags.prog.only() == "1:44 boolean-unknown");
}

TEST_CASE("what the form or the Prog does not say is refused as post does") {
  CHECK(lowered("r: SpinOn EOL SpinOn EOL RETURN") == "refused: [command-not-in-form]");
  CHECK(lowered("r: 'X' Odd# EOL RETURN") == "refused: [numeric-not-in-form], [bare-word]");
  CHECK(lowered("r: Odd? EOL RETURN") == "refused: [boolean-as-statement]");
  CHECK(lowered("r: 'X' OpFieldData# EOL RETURN").starts_with("refused: [field-needs-name]"));
  CHECK(lowered("#2='##' FORMAT(ZCP1,2) r: 'G65 P9770' ZCP1 EOL RETURN").find("[format-of-command]") !=
        std::string::npos);
  Lowering none("r: 'G0 X' OpFieldData#('a') EOL RETURN");
  CHECK_FALSE(none.lower());
  CHECK(none.prog.only() == "1:11 no-picture");
  Lowering prefix("#1='-###.##' FORMAT(OpFieldData#,1) r: 'G0 X' OpFieldData#('a') EOL RETURN");
  CHECK_FALSE(prefix.lower());
  CHECK(prefix.prog.only().find("picture-prefix-unverified") != std::string::npos);
  Lowering unknown(kPictures + "r: 'G0 X' OpFieldData#('a') EOL RETURN");
  unknown.noFields = {"a"};
  CHECK_FALSE(unknown.lower()); // the callee has reported it
}

TEST_CASE("the macro set is the one that knows all programs of the branch") {
  Lowering easy(kPictures + "r: 'G65 P9770 Z1.' EOL RETURN");
  REQUIRE(easy.lower());
  CHECK(easy.result->macros == &easy.easyprobe);
  Lowering inspection(kPictures + "r: 'G65 P9832' EOL 'G65 P9810 Z1.' EOL RETURN");
  REQUIRE(inspection.lower());
  CHECK(inspection.result->macros == &inspection.inspection);
  Lowering none(kPictures + "r: 'M5' EOL RETURN");
  REQUIRE(none.lower());
  CHECK(none.result->macros == nullptr);
  CHECK(lowered("r: 'G65 P9770 Z1.' EOL 'G65 P1234 Z1.' EOL RETURN") == "refused: [unknown-macro]");
  CHECK(lowered("r: 'G65 P9770 Z1.' EOL 'G65 P9810 Z1.' EOL RETURN") == "refused: [mixed-macro-sets]");
  Lowering unknown(kPictures + "r: 'G65 P1234 Z1.' EOL RETURN");
  CHECK_FALSE(unknown.lower());
  const Diagnostic& one = unknown.prog.at(0);
  CHECK(unknown.prog.sources.text(one.range) == "P1234");
  CHECK(one.message.find("`easyprobe`, `inspection-plus`") != std::string::npos);
  Lowering twice(kPictures + "r: 'G65 P9770 Z1.' EOL RETURN");
  stdlib::MacroSet copy = twice.easyprobe;
  copy.name = "copy";
  twice.sets = {&twice.easyprobe, &copy};
  CHECK_FALSE(twice.lower());
  CHECK(twice.prog.only().find("several-macro-sets") != std::string::npos);
}

TEST_CASE("defects of a block are found in the branch") {
  CHECK(lowered("r: 'G0 #1=5' EOL RETURN") == "refused: [mixed-block]");
  CHECK(lowered("r: 'O100' EOL RETURN") == "refused: [program-in-branch]");
  CHECK(lowered("r: 'SETVN500[A]' EOL RETURN") == "refused: [macro-statement]");
  CHECK(lowered("r: 'G0 X1' OpFieldData#('a') EOL RETURN") == "refused: [digits-beside-value]");
  Lowering fits(kPictures + "r: 'G0 X' OpFieldData#('a') EOL RETURN");
  fits.fixed["a"] = 5000;
  CHECK_FALSE(fits.lower());
  CHECK(fits.prog.only() == "1:48 value-does-not-fit");
}

TEST_CASE("limits bound the walk") {
  Lowering deep("r: r RETURN");
  CHECK_FALSE(deep.lower());
  CHECK(deep.prog.only() == "1:4 calls-too-deep");
  Lowering wide("r: a a a a RETURN a: b b b b RETURN b: 'M5' EOL RETURN");
  wide.limits.steps = 20;
  CHECK_FALSE(wide.lower());
  CHECK(wide.prog.only().find("post-runs-forever") != std::string::npos);
  Lowering large("r: '(AAAAAAAAAAAAAAAAAAAAAA)' EOL '(AAAAAAAAAAAAAAAAAAAAAA)' EOL RETURN");
  large.limits.outputBytes = 30;
  CHECK_FALSE(large.lower());
  CHECK(large.prog.only().find("output-too-large") != std::string::npos);
  // Undecided conditions inside undecided ones are not compared again and again.
  std::string many = "r: ";
  for (int i = 0; i < 40; ++i)
    many += "IF Odd" + std::to_string(i) + "? ";
  many += "'M5' EOL ";
  for (int i = 0; i < 40; ++i)
    many += "END ";
  Lowering nested(many + "RETURN");
  CHECK_FALSE(nested.lower());
  CHECK(nested.prog.only() == "1:7 boolean-unknown");
}

TEST_CASE("the shipped examples lower without a finding of weight, word for word as posted") {
  const std::map<std::string, std::vector<std::string>> posts = {
      {"post.txt", {"surface-x"}},
      {"mill-post.txt", {"surface-x", "surface-y", "surface-z", "corner-xyz", "bore"}}};
  for (const auto& [file, cycles] : posts) {
    for (const std::string& id : cycles) {
      INFO(file << " " << id);
      Lowering one(readAll(root() / "examples" / file));
      REQUIRE(one.lower(id, "probe"));
      for (const Diagnostic& finding : one.prog.diagnostics.all())
        CHECK((finding.severity == Severity::Note || finding.code == diag::FormAssumed::code));
      CHECK(one.result->macros == &one.easyprobe);
      sameWords(one, id, "probe");
    }
  }
}

TEST_CASE("random branches: the same blocks as the post, refused where the post refuses") {
  std::mt19937 random(31);
  const auto upTo = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const auto operand = [&] {
    static const char* const kOperands[] = {"CycleType?('c')", "CycleType?('d')", "Flag?('f')", "Flag?('g')",
                                            "Drilling?",       "RigidTap?",       "Odd?"};
    return std::string(upTo(3) == 0 ? "NOT " : "") + kOperands[upTo(16) == 0 ? 6 : upTo(6)];
  };
  const auto condition = [&] {
    std::string out = operand();
    for (int i = upTo(3); i > 0; --i)
      out += (upTo(2) == 0 ? " AND " : " OR ") + operand();
    return out;
  };
  const std::function<std::string(int)> body = [&](int depth) {
    std::string out;
    for (int i = 1 + upTo(3); i > 0; --i) {
      switch (upTo(depth > 0 ? 6 : 4)) {
      case 0:
        out += std::string(upTo(2) == 0 ? "SetFlag" : "SetFlagF") + (upTo(2) == 0 ? "('f') " : "('g') ");
        break;
      case 1: out += "SeqC ' M5' EOL "; break;
      case 2: out += "' G65 P9770 Z' OpFieldData#('a') EOL "; break;
      case 3: out += "p "; break;
      default:
        out += "IF " + condition() + " " + body(depth - 1) + (upTo(2) == 0 ? "ELSE " + body(depth - 1) : "") +
               "END ";
      }
    }
    return out;
  };
  int refused = 0;
  int several = 0;
  const int rounds = draws(500, 200); // fewer do not fill the shares below
  for (int round = 0; round < rounds; ++round) {
    const std::string text =
        kPictures + "r: " + body(3) + "RETURN p: IF Flag?('f') 'M9' ELSE 'M31' END EOL RETURN";
    INFO(text);
    Lowering one(text);
    Diagnostics posting;
    const compost::PostSettings settings{one.prog.sources, one.form, one.limits, {}};
    compost::PostRun run(one.prog.program, settings, posting);
    const compost::Operation operation{"c", [](const std::string&, SourceRange) { return 5; }, {}};
    run.run(*compost::findRoutine(one.prog.program, "r"), operation);
    const bool ok = one.lower();
    CHECK(ok == !posting.hasErrors());
    if (!ok) {
      ++refused;
      continue;
    }
    Nc nc;
    std::string wanted;
    for (const compost::PostedLine& line : run.finish()) {
      const auto block = nc.parse(line.text);
      REQUIRE(block);
      for (const nc::Word& word : block->words)
        wanted += word.address;
    }
    sound(one);
    std::string found;
    for (const ir::CycleStatement& statement : one.result->body)
      found += statement.origin.addresses;
    CHECK(found == wanted);
    several += wanted.size() > 4 ? 1 : 0;
  }
  CHECK(refused > rounds / 25);
  CHECK(several > rounds / 5);
}

TEST_CASE("the smallest example in full") {
  Lowering one(readAll(root() / "examples" / "post.txt"));
  REQUIRE(one.lower("surface-x", "probe"));
  CHECK(one.shown() == "spindle 0\ncoolant 0\nprobe on\nprotected Z=work:clearance F=3000\n"
                       "protected Z=work:Z F=500\nsurface X=here:X sets G X=I\nprotected Z=work:R F=3000\n"
                       "probe off\n");
}

TEST_CASE("the corpus branches lower, word for word as posted") {
  fs::path corpus;
  if (!haveCorpus(corpus)) return;
  const std::string text = readAll(corpus / "compost" / "probe-routines.txt");
  for (const std::string id :
       {"MERENI.OSA.X", "MERENI.OSA.Y", "MERENI.OSA.Z", "MERENI.OSA.XYZ", "MERENI.STRED.OTVOR"}) {
    INFO(id);
    Lowering one(text);
    // The tree holds the repaired reading of the IF that is left open: --recover.
    std::erase_if(one.prog.diagnostics.all(),
                  [](const Diagnostic& d) { return d.code == "open-if-at-return"; });
    REQUIRE(one.lower(id, "defProbeCycle"));
    CHECK_FALSE(one.prog.diagnostics.hasErrors());
    CHECK(one.result->macros == &one.easyprobe);
    sameWords(one, id, "defProbeCycle");
  }
  Lowering x(text);
  REQUIRE(x.lower("MERENI.OSA.X", "defProbeCycle"));
  CHECK(x.shown() == "(MERENI OSA X)\nprotected Z=work:Zb\nspindle 0\ncoolant 0\nprobe on\n"
                     "protected Z=work:clearance F=1000\nprotected Z=work:Z F=200\n"
                     "surface X=here:X sets G X=I\nstore 550=result0\nrapid Z=work:Zb F=5000\n");
  Lowering bore(text);
  REQUIRE(bore.lower("MERENI.STRED.OTVOR", "defProbeCycle"));
  CHECK(bore.shown().find("bore D=D sets G X=X Y=Y\n") != std::string::npos);
  CHECK(bore.shown().ends_with("rapid Z=work:50 F=5000\n"));
  CHECK(bore.prog.only().find("decimal-point") != std::string::npos); // Z50
}
