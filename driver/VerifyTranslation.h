// Private to Verify*.cpp: the translation as text, and what the cases are run with.
#pragma once

#include "driver/Command.h"
#include "targets/Subject.h"

#include <memory>
#include <string>

namespace dotek::driver {

// What convert wrote for the one input: given with the options, else by convert. nullptr: it does not come to
// one file; `refused` says why.
std::shared_ptr<const ConvertedInput> convertedFor(const VerifyOptions& options,
                                                   const ConvertOptions& convert, Outcome& refused);
Translation translationOf(const ConvertedInput& converted);
// The text of `path` instead; lines that stood before keep what they come from. false: reported.
bool takeEdited(const std::string& path, Translation& translation, Session& session);

// The files of --machine and --part into the plan. false: reported.
bool loadWorld(const VerifyOptions& options, VerifyPlan& plan, Session& session);

} // namespace dotek::driver
