#include "lint/Analyses.h"

#include "lint/OffsetStates.h"

namespace dotek::lint {

const SharedInputs& Analyses::shared(const Project& project) {
  return shared_.get([&](auto& into) { into.emplace(project); });
}

const NcPrograms& Analyses::programs(const Project& project) {
  return programs_.get([&](auto& into) {
    into.emplace();
    eachProgram(project, [&](const ir::Program& program, const macrob::File& file) {
      into->push_back(std::make_unique<const NcProgram>(project, program, file));
    });
  });
}

const Lathes& Analyses::lathes(const Project& project) {
  return lathes_.get([&](auto& into) { into = findLathes(project); });
}

const Probing& Analyses::probing(const Project& project) {
  return probing_.get([&](auto& into) { into.emplace(project); });
}

const ToolLengths& Analyses::toolLengths(const Project& project) {
  return toolLengths_.get([&](auto& into) { into.emplace(project); });
}

const Askers& Analyses::askers(const Project& project) {
  return askers_.get([&](auto& into) { into.emplace(project); });
}

const std::vector<Siblings>& Analyses::siblings(const Project& project) {
  return siblings_.get([&](auto& into) { into = findSiblings(project); });
}

const std::vector<ProgBlock>& Analyses::blocks(const std::vector<compost::Statement>& statements,
                                               const compost::Program& prog, const Project& project) {
  const auto known = blocks_.find(&statements);
  if (known != blocks_.end()) return known->second;
  return blocks_.emplace(&statements, collectBlocks(statements, prog, project)).first->second;
}

const PartRoutines& Analyses::parts(const compost::Program& prog, const Project& project) {
  const auto known = parts_.find(&prog);
  if (known != parts_.end()) return known->second;
  return parts_.emplace(&prog, findParts(prog, project)).first->second;
}

const std::vector<NameUse>& Analyses::names(const gibbs::Macro& macro, const Project& project) {
  const auto known = names_.find(&macro);
  if (known != names_.end()) return known->second;
  return names_.emplace(&macro, collectNames(macro, project)).first->second;
}

const std::set<std::uint32_t>& Analyses::called(const macrob::File& file, const Project& project) {
  const auto& all = called_.get([&](auto& into) {
    into.emplace();
    eachProgram(project, [&](const ir::Program& program, const macrob::File& where) {
      for (const ir::ProgramStatement& statement : program.body)
        if (const auto number = calledProgram(statement)) (*into)[&where].insert(*number);
    });
  });
  static const std::set<std::uint32_t> kNone;
  const auto found = all.find(&file);
  return found == all.end() ? kNone : found->second;
}

const SharedInputs& sharedOf(const Project& project) {
  return project.analyses->shared(project);
}

const NcPrograms& programsOf(const Project& project) {
  return project.analyses->programs(project);
}

const Lathes& lathesOf(const Project& project) {
  return project.analyses->lathes(project);
}

const std::set<std::uint32_t>& calledIn(const macrob::File& file, const Project& project) {
  return project.analyses->called(file, project);
}

const std::vector<NameUse>& namesOf(const gibbs::Macro& macro, const Project& project) {
  return project.analyses->names(macro, project);
}

const Probing& probingOf(const Project& project) {
  return project.analyses->probing(project);
}

const ToolLengths& toolLengthsOf(const Project& project) {
  return project.analyses->toolLengths(project);
}

const Askers& askersOf(const Project& project) {
  return project.analyses->askers(project);
}

const std::vector<Siblings>& siblingsOf(const Project& project) {
  return project.analyses->siblings(project);
}

const std::vector<ProgBlock>& blocksOf(const std::vector<compost::Statement>& statements,
                                       const compost::Program& prog, const Project& project) {
  return project.analyses->blocks(statements, prog, project);
}

const PartRoutines& partsOf(const compost::Program& prog, const Project& project) {
  return project.analyses->parts(prog, project);
}

} // namespace dotek::lint
