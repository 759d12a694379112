#include "lint/NcProgram.h"

#include "lint/OffsetStates.h"

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
  const Reads& reads = allReads();
  const std::size_t begin = statement == 0 ? 0 : reads.ends[statement - 1];
  return std::span(reads.all).subspan(begin, reads.ends[statement] - begin);
}

const NcProgram::Reads& NcProgram::allReads() const {
  if (reads_) return *reads_;
  Reads& reads = reads_.emplace();
  reads.ends.reserve(program.body.size());
  reads.all.reserve(program.body.size() * 2);
  for (std::size_t i = 0; i < program.body.size(); ++i) {
    bool computed = false;
    eachRead(
        program.body[i],
        [&](std::uint32_t number, SourceRange range) {
          reads.all.push_back({number, range});
        },
        [&](const ir::MachineVariable&) { computed = true; });
    reads.ends.push_back(reads.all.size());
    if (computed) reads.computed.push_back(i);
  }
  return reads;
}

const std::vector<std::size_t>& NcProgram::skips() const {
  if (skips_) return *skips_;
  std::vector<std::size_t>& out = skips_.emplace();
  for (std::size_t i = 0; i < program.body.size(); ++i)
    if (skipOf(program.body[i]) != nullptr) out.push_back(i);
  return out;
}

const IndirectWrites& NcProgram::writes() const {
  if (!writes_) writes_.emplace(program);
  return *writes_;
}

const std::set<std::uint32_t>& NcProgram::otherCodes() const {
  if (!otherCodes_) otherCodes_ = codesOfOtherGroups(program);
  return *otherCodes_;
}

} // namespace dotek::lint
