// Which form a Prog is read through.
#pragma once

#include "project/Options.h"
#include "project/Session.h"

#include <string>
#include <string_view>

namespace dotek::project {

struct FormChoice {
  std::string name;
  bool named = false; // by --form or by a dotek.toml; else it is kDefaultForm
};

// --form, else `form` of the dotek.toml beside the Prog or above it. A defect of that file is reported.
FormChoice chooseForm(const SourceOptions& source, Session& session);

// Says that nobody named the form through which this Prog is read, if so.
void noteForm(const FormChoice& choice, FileId prog, Session& session);

// Whether a message says which form a Prog is read through, or what that form only assumes.
bool isAboutForm(std::string_view code);

} // namespace dotek::project
