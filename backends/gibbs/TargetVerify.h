// Private to Target*.cpp.
#pragma once

#include "backends/gibbs/Emit.h"
#include "support/OutputFile.h"
#include "targets/Verification.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dotek::targets {

// What convert writes of one cycle.
struct WrittenFolder {
  std::string name;              // of the cycle in the CAM
  std::vector<OutputFile> files; // NAME/DefineData.txt, .., the branch of the Prog last
  // That the dialog asks for, by the source's name.
  std::map<std::string, backends::gibbs::Field> fields;
};
// nullopt: reported.
std::optional<WrittenFolder> writtenFolder(const VerificationSource& source);

// The written folder, checked by its dialog and posted through its branch, beside its source.
std::unique_ptr<Verification> folderVerification(const VerificationSource& source);

} // namespace dotek::targets
