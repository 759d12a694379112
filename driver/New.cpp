#include "driver/Command.h"
#include "project/ControlDraft.h"
#include "project/FormDraft.h"
#include "project/Lowering.h"
#include "project/Prog.h"

#include <algorithm>

namespace dotek::driver {

namespace {

// A data file NAME.toml, which flags name.
bool isPlain(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
}

} // namespace

Outcome newForm(const NewFormOptions& options) {
  const std::vector<std::string> inputs =
      options.prog ? std::vector{*options.prog} : std::vector<std::string>();
  return guarded(options.common, inputs, [&](Session& session) {
    if (!isPlain(options.name)) session.diagnostics().report<diag::FormName>({}, options.name);
    if (!options.prog)
      session.diagnostics().report<diag::MissingOption>({}, "new form", "--prog PROG.txt",
                                                        "the Prog whose keywords the form explains");
    if (session.diagnostics().hasErrors()) return outcomeOf(session, "");
    const auto program = loadProg(*options.prog, session);
    leaveFindingsToLint(session);
    if (!program || session.diagnostics().hasErrors()) return outcomeOf(session, "");
    std::vector<stdlib::Form> known;
    for (const stdlib::DataFile* file : session.data().list("forms"))
      if (auto form = session.form(file->name)) known.push_back(std::move(*form));
    return outcomeOf(session,
                     draftForm(options.name, *program, session.sources(), session.compostKeywords(), known));
  });
}

Outcome newControl(const NewControlOptions& options) {
  return guarded(options.common, {}, [&](Session& session) {
    if (!isPlain(options.name)) session.diagnostics().report<diag::ControlName>({}, options.name);
    const auto base = loadControl(options.base, session);
    if (base) checkProbeCodes(*base, session);
    const bool sound = base && !session.diagnostics().hasErrors();
    return outcomeOf(session,
                     sound ? draftControl(options.name, *base, session.probeCodes()) : std::string());
  });
}

} // namespace dotek::driver
