// The translation that `verify` looks at, and the files that its cases are run with.
#pragma once

#include "project/Compilation.h"
#include "targets/Subject.h"
#include "targets/VerifyDocument.h"

#include <optional>
#include <string>
#include <vector>

namespace dotek::targets {

struct Translated {
  Translation translation;
  std::string macros;                        // the set that it calls; "": none
  std::vector<VerifyDocument::Finding> said; // by convert, for the document
};

// What convert is asked for in place of verify.
ConvertOptions convertOptionsOf(const VerifyOptions& options);

// The one input as convert writes it: given with the options, else written here, with what the compilation
// has read. `inputs` are those of its folder; nullptr: the input is a file of programs. nullopt: reported.
std::optional<Translated> translated(const VerifyOptions& options, Compilation& compilation,
                                     LoweringInputs* inputs);
// The text of `path` instead; lines that stood before keep what they come from. false: reported.
bool takeEdited(const std::string& path, Translation& translation, Session& session);

// The files of --machine and --part into the plan. false: reported.
bool loadWorld(const VerifyOptions& options, VerifyPlan& plan, Session& session);

} // namespace dotek::targets
