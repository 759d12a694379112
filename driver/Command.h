// Private to driver: how a command begins and ends.
#pragma once

#include "driver/Driver.h"
#include "project/Session.h"
#include "support/messages/Commands.h"

#include <string>
#include <string_view>
#include <utility>

namespace dotek::driver {

// A command is a view of a project and of its targets, and speaks of their parts by their names.
using namespace project; // NOLINT(google-build-using-namespace)
using namespace targets; // NOLINT(google-build-using-namespace)

// Hands over what the command found; the session is empty afterwards. The status is 1 with errors, 2 with
// errors of the command line or of reading and writing files; `output` is dropped with either unless
// `keepOutput`.
Outcome outcomeOf(Session& session, std::string output, bool keepOutput = false);

// The same of a conversion that is refused: why there is nothing comes before what is only worth knowing.
Outcome refusalOf(Session& session);

// Codes that mean wrong arguments, or a file that cannot be read or written: status 2.
bool isUsageCode(std::string_view code);

// Which form a Prog is read through, and what it only assumes.
bool isAboutForm(std::string_view code);

// Of findings that begin at one place, keeps those of the highest severity: the others report the same
// cause.
void keepStrongest(Diagnostics& diagnostics);

// Runs a command: a defect of the data files that `--data` names becomes a diagnostic.
template <class Command> Outcome guarded(const CommonOptions& options, const Command& command) {
  try {
    Session session(options);
    if (session.diagnostics().hasErrors()) return outcomeOf(session, "");
    return command(session);
  } catch (const stdlib::DataError& error) {
    Outcome outcome;
    outcome.diagnostics.report<diag::DataFileDefect>({}, error.what());
    outcome.status = 2;
    return outcome;
  }
}

} // namespace dotek::driver
