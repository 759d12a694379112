#include "project/FormChoice.h"

#include "support/messages/ComPost.h"
#include "support/messages/Commands.h"

namespace dotek::project {

FormChoice chooseForm(const SourceOptions& source, Session& session) {
  if (source.form) return {*source.form, true};
  const std::string form = source.prog ? settingsOf(*source.prog, session).form : "";
  if (!form.empty()) return {form, true};
  return {std::string(kDefaultForm), false};
}

void noteForm(const FormChoice& choice, FileId prog, Session& session) {
  if (!choice.named)
    session.diagnostics().report<diag::FormTaken>({prog, 0, 0}, choice.name,
                                                  session.sources().file(prog).name());
}

bool isAboutForm(std::string_view code) {
  return code == diag::FormTaken::code || code == diag::FormAssumed::code;
}

} // namespace dotek::project
