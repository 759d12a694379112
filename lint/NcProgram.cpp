#include "lint/NcProgram.h"

#include "lint/OffsetStates.h"

namespace dotek::lint {

const ir::ProgramFlow& NcProgram::flow() const {
  return flow_.get([&](auto& into) { into = ir::flowOf(program.body); });
}

const std::vector<std::optional<DistanceMode>>& NcProgram::modes() const {
  return modes_.get([&](auto& into) { into = distanceModes(program.body, flow()); });
}

const std::vector<std::optional<Machining>>& NcProgram::machining() const {
  return machining_.get([&](auto& into) {
    const Probing& probing = probingOf(project);
    into = machiningBefore(program, flow(), [&](const ir::ProgramStatement& statement) {
      using Kind = ProbeStep::Kind;
      if (skipOf(statement) != nullptr) return true;
      const ProbeStep step = probing.step(statement);
      return step.kind == Kind::On || step.kind == Kind::Protected || step.kind == Kind::Measure ||
             (step.program != 0 && probing.skips(step.program));
    });
  });
}

const std::vector<std::optional<ProbeState>>& NcProgram::probeStates() const {
  return probeStates_.get([&](auto& into) { into = probingOf(project).states(program.body, flow()); });
}

std::span<const VariableRead> NcProgram::reads(std::size_t statement) const {
  const Reads& reads = allReads();
  const std::size_t begin = statement == 0 ? 0 : reads.ends[statement - 1];
  return std::span(reads.all).subspan(begin, reads.ends[statement] - begin);
}

const NcProgram::Reads& NcProgram::allReads() const {
  return reads_.get([&](auto& into) {
    Reads& reads = into.emplace();
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
  });
}

const std::vector<std::size_t>& NcProgram::skips() const {
  return skips_.get([&](auto& into) {
    into.emplace();
    for (std::size_t i = 0; i < program.body.size(); ++i)
      if (skipOf(program.body[i]) != nullptr) into->push_back(i);
  });
}

const IndirectWrites& NcProgram::writes() const {
  return writes_.get([&](auto& into) { into.emplace(program); });
}

const std::set<std::uint32_t>& NcProgram::otherCodes() const {
  return otherCodes_.get([&](auto& into) { into = codesOfOtherGroups(program); });
}

} // namespace dotek::lint
