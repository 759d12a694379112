#include "lint/NcProgram.h"

namespace dotek::lint {

const ir::ProgramFlow& NcProgram::flow() const {
  if (!flow_) flow_ = ir::flowOf(program.body);
  return *flow_;
}

const std::vector<std::optional<DistanceMode>>& NcProgram::modes() const {
  if (!modes_) modes_ = distanceModes(program.body, flow());
  return *modes_;
}

const std::vector<std::optional<Machining>>& NcProgram::machining() const {
  if (machining_) return *machining_;
  const Probing& probing = probingOf(project);
  machining_ = machiningBefore(program, flow(), [&](const ir::ProgramStatement& statement) {
    using Kind = ProbeStep::Kind;
    if (skipOf(statement) != nullptr) return true;
    const ProbeStep step = probing.step(statement);
    return step.kind == Kind::On || step.kind == Kind::Protected || step.kind == Kind::Measure ||
           (step.program != 0 && probing.skips(step.program));
  });
  return *machining_;
}

std::span<const VariableRead> NcProgram::reads(std::size_t statement) const {
  if (!reads_) {
    Reads& reads = reads_.emplace();
    reads.ends.reserve(program.body.size());
    for (const ir::ProgramStatement& one : program.body) {
      eachRead(one, [&](std::uint32_t number, SourceRange range) { reads.all.push_back({number, range}); });
      reads.ends.push_back(reads.all.size());
    }
  }
  const std::size_t begin = statement == 0 ? 0 : reads_->ends[statement - 1];
  return std::span(reads_->all).subspan(begin, reads_->ends[statement] - begin);
}

} // namespace dotek::lint
