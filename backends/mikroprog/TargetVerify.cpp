// Cases of verify --to mikroprog.
#include "backends/mikroprog/TargetProgram.h"
#include "frontend/gibbs/Ast.h"
#include "frontend/mikroprog/Check.h"
#include "frontend/mikroprog/Lower.h"
#include "frontend/mikroprog/Parse.h"
#include "support/messages/Verify.h"
#include "targets/ReadBack.h"
#include "verify/MikroprogCompare.h"

#include <fmt/format.h>

namespace dotek::targets {

namespace mikroprog = frontend::mikroprog;

namespace {

class MikroprogVerification final : public Verification {
public:
  explicit MikroprogVerification(const VerificationSource& source) : from_(source) {}

  bool datumsMovePath() const override { return true; }

  bool prepare() override {
    if (from_.inputs.job && from_.inputs.job->lengthToCentre) {
      from_.session.diagnostics().report<diag::LengthOfProbe>({});
      return false;
    }
    std::set<std::string> used;
    lowered_ = lowerCycle(from_.folder, from_.inputs, used, from_.session);
    if (!lowered_) return false;
    lowered_->cycle.name = from_.folder.name;
    const auto name = mikroprogControlFor(from_.options.control, from_.folder, *lowered_, from_.session);
    if (!name) return false;
    control_ = loadMikroprogControl(*name, from_.session);
    return control_.has_value();
  }

  TargetRun run(const TargetCase& now) override {
    TargetRun out;
    std::optional<std::string> text = from_.plan.translation->text;
    if (text->empty()) text = write(now.drawn);
    if (!text) {
      out.refused = true;
      out.why = "the conversion is refused: " + firstError(from_.session.diagnostics());
      return out;
    }
    if (now.source == nullptr) return out;
    if (verify::goesOnInItsDatum(*now.source, now.entry.system)) {
      out.undecided = true;
      out.why = "the source sets the system in which it goes on, this control has no other to set";
      return out;
    }
    SourceMap sources;
    Diagnostics found;
    const FileId id = sources.add(SourceFile("program", std::move(*text), Encoding::Cp852));
    const mikroprog::Program tree = mikroprog::parse(id, sources, found);
    mikroprog::refuse({tree, *control_, sources}, found);
    auto program = mikroprog::lower(tree, sources);
    if (!program || found.hasErrors()) {
      for (const Diagnostic& one : found.all())
        if (one.severity == Severity::Error && out.differences.empty())
          out.differs(verify::Aspect::Ending, "the program is faulty: " + one.message,
                      one.range.hasPlace() ? std::string(sources.file(id).line(sources.line(one.range)))
                                           : "");
      if (out.differences.empty()) out.differs(verify::Aspect::Ending, "the program cannot be read");
      return out;
    }
    const sim::BlockList blocks(std::move(program->programs.front()), sources);
    const verify::MikroprogStand stand(*control_, blocks);
    const sim::Point3 zero = now.entry.zeros[now.entry.system - 54];
    const sim::Point3 start = now.entry.start + zero;
    const verify::MikroprogRecord ran = stand.run(now.world, start, zero);
    const auto place = [&](std::uint32_t line) {
      const SourceFile& file = sources.file(id);
      const std::uint32_t begin = file.lineStart(line);
      return SourceRange{id, begin, begin + 1};
    };
    verify::MikroprogFacts facts(*control_);
    facts.zero = zero;
    facts.overtravel = now.drawn.hosts.at("overtravel");
    facts.byOperator = from_.options.datum == "operator";
    facts.tolerance = from_.options.tolerance;
    facts.place = place;
    const auto lineOf = [&](std::uint32_t line) {
      return line == 0 ? std::string() : std::string(sources.file(id).line(line));
    };
    verify::MikroprogComparison compared = verify::compare(*now.source, ran, now.world, facts);
    if (!compared.undecided.empty()) {
      out.undecided = true;
      out.why = std::move(compared.undecided);
      return out;
    }
    for (verify::Difference& difference : compared.differences) {
      std::string line = difference.target.hasPlace() ? lineOf(sources.line(difference.target)) : "";
      out.differences.push_back({std::move(difference), 0, std::move(line)});
    }
    if (out.differences.empty() && now.source->ending == verify::Ending::Finished)
      interfere(stand, now, start, zero, ran, out);
    return out;
  }

private:
  // The program of these values. nullopt: the session says why there is none.
  std::optional<std::string> write(const verify::Case& drawn) {
    from_.session.diagnostics() = Diagnostics();
    LoweredCycle lowered = *lowered_;
    for (ir::VariableId id = 0; id < lowered.cycle.variables.size(); ++id) {
      const ir::Variable& variable = lowered.cycle.variable(id);
      if (lowered.fixed.contains(id)) continue;
      if (variable.role == ir::Role::Host) {
        if (const auto host = drawn.hosts.find(variable.name); host != drawn.hosts.end())
          lowered.fixed.emplace(id, host->second);
      } else if (variable.role == ir::Role::Parameter) {
        for (const auto& [name, value] : drawn.values)
          if (frontend::gibbs::foldCase(name) == frontend::gibbs::foldCase(variable.name))
            lowered.fixed.emplace(id, value);
      }
    }
    const MikroprogWriting writing{
        *control_, from_.options.datum, from_.options.common.assume,
        false,     drawn.hosts,         [](const std::string&) { return std::string("--set"); }};
    auto program = writeMikroprog(from_.folder, std::move(lowered), writing, from_.session);
    if (!program) return std::nullopt;
    std::string out;
    for (const backends::mikroprog::EmittedLine& line : program->lines)
      out.append(line.text).append("\r\n");
    return out;
  }

  // Each search once without its surface, each protected move with an obstacle half way, each guard with
  // contact already there.
  static void interfere(const verify::MikroprogStand& stand, const TargetCase& now, const sim::Point3& start,
                        const sim::Point3& zero, const verify::MikroprogRecord& ran, TargetRun& out) {
    using Tail = verify::MikroprogRecord::Ending;
    const auto attempt = [&](const verify::Interference& interference, Tail tail, std::string_view what,
                             std::size_t number) {
      const verify::MikroprogRecord record = stand.run(now.world, start, zero, interference);
      const std::string why = verify::whyNotCaught(record, tail);
      if (!why.empty() && out.differences.empty())
        out.differs(verify::Aspect::Ending, fmt::format("{} {}: {}", what, number + 1, why));
    };
    for (std::size_t i = 0; i < ran.searches; ++i)
      attempt({i, {}, {}}, Tail::NotFound, "no surface at search", i);
    for (std::size_t i = 0; i < ran.protectedMoves; ++i)
      attempt({{}, i, {}}, Tail::Collision, "an obstacle in protected move", i);
    for (std::size_t i = 0; i < ran.guards; ++i)
      attempt({{}, {}, i}, Tail::Collision, "contact before chain", i);
    if (ran.guards == 0 && ran.searches + ran.protectedMoves > 0 && out.differences.empty())
      out.differs(verify::Aspect::Ending, "nothing asks for contact before the first probe move");
  }

  const VerificationSource from_;
  std::optional<LoweredCycle> lowered_;
  std::optional<stdlib::MikroprogControl> control_;
};

} // namespace

std::unique_ptr<Verification> mikroprogVerification(const VerificationSource& source) {
  return std::make_unique<MikroprogVerification>(source);
}

} // namespace dotek::targets
