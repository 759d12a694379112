// Which form a Prog is read through.
#pragma once

#include "project/Options.h"
#include "project/Session.h"
#include "stdlib/Toml.h"

#include <string>

namespace dotek::project {

struct FormChoice {
  std::string name;
  bool named = false; // by --form or by a dotek.toml; else it is kDefaultForm
};

// What a dotek.toml says, for all commands: `form`, also as a key of `[lint]`. "" where it says nothing.
std::string formOf(const stdlib::TomlDocument& document);

// --form, else `form` of the dotek.toml beside the Prog or above it. A defect of that file is reported.
FormChoice chooseForm(const SourceOptions& source, Session& session);

// Says that nobody named the form through which this Prog is read, if so.
void noteForm(const FormChoice& choice, FileId prog, Session& session);

} // namespace dotek::project
