// Which fields are to blame where CycleData.mac rejects values.
#pragma once

#include "frontend/gibbs/Run.h"

namespace dotek::frontend::gibbs {

// `context.fields` are values that the checks reject. Folded names, sorted, of the fields of which one with
// another value lets the checks pass; where no single one does, two of which both together do; empty where
// none is found. Only names of `candidates` (folded) are tried, all where it is empty. Reports nothing.
std::vector<std::string> fieldsToBlame(const Macro& cycleData, const std::vector<const Macro*>& others,
                                       const RunContext& context,
                                       const std::set<std::string>& candidates = {});

} // namespace dotek::frontend::gibbs
