// What several rules ask of one project, computed when first asked for.
#pragma once

#include "lint/AskedVariables.h"
#include "lint/Lathe.h"
#include "lint/Lazy.h"
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

// Belongs to one project. Rules that look at one NC program run on several threads and may ask for what is
// Lazy; what is kept by address is for the rules that look at all inputs, which run on one.
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
  Lazy<SharedInputs> shared_;
  Lazy<NcPrograms> programs_;
  Lazy<Lathes> lathes_;
  Lazy<Probing> probing_;
  Lazy<ToolLengths> toolLengths_;
  Lazy<Askers> askers_;
  Lazy<std::vector<Siblings>> siblings_;
  Lazy<std::map<const macrob::File*, std::set<std::uint32_t>>> called_;
  std::map<const std::vector<compost::Statement>*, std::vector<ProgBlock>> blocks_;
  std::map<const compost::Program*, PartRoutines> parts_;
  std::map<const gibbs::Macro*, std::vector<NameUse>> names_;
};

} // namespace dotek::lint
