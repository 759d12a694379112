// What several rules ask of one project, computed when first asked for.
#pragma once

#include "lint/AskedVariables.h"
#include "lint/Lathe.h"
#include "lint/MacroNames.h"
#include "lint/NcProgram.h"
#include "lint/Probing.h"
#include "lint/ProgBlocks.h"
#include "lint/Shared.h"
#include "lint/ToolLength.h"

#include <map>
#include <optional>
#include <set>
#include <vector>

namespace dotek::lint {

struct PostFile;

// Belongs to one project; one thread uses it.
class Analyses {
public:
  // A folder was named: programs that others call are looked for among those of the project, and nowhere
  // else.
  bool wholeFolder = false;

  const SharedInputs& shared(const Project& project);
  const NcPrograms& programs(const Project& project);
  const Lathes& lathes(const Project& project);
  const Probing& probing(const Project& project);
  const ToolLengths& toolLengths(const Project& project);
  const Askers& askers(const Project& project);
  const std::vector<Siblings>& siblings(const Project& project);
  // Of statements of a Prog, known by their address.
  const std::vector<ProgBlock>& blocks(const std::vector<compost::Statement>& statements,
                                       const compost::Program& prog, const Project& project);

  const PartRoutines& parts(const compost::Program& prog, const Project& project);
  const std::vector<NameUse>& names(const gibbs::Macro& macro, const Project& project);
  // Numbers of programs, by the file in which they are called.
  const std::set<std::uint32_t>& called(const macrob::File& file, const Project& project);

  // Posts of Fusion: what only their rules look at is no part of Project.h, which all others read.
  std::vector<const PostFile*> posts;

private:
  std::optional<SharedInputs> shared_;
  std::optional<NcPrograms> programs_;
  std::optional<Lathes> lathes_;
  std::optional<Probing> probing_;
  std::optional<ToolLengths> toolLengths_;
  std::optional<Askers> askers_;
  std::optional<std::vector<Siblings>> siblings_;
  std::map<const std::vector<compost::Statement>*, std::vector<ProgBlock>> blocks_;
  std::map<const compost::Program*, PartRoutines> parts_;
  std::map<const gibbs::Macro*, std::vector<NameUse>> names_;
  std::optional<std::map<const macrob::File*, std::set<std::uint32_t>>> called_;
};

} // namespace dotek::lint
