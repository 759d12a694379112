// Private to driver: how a command begins and ends.
#pragma once

#include "driver/Driver.h"
#include "project/Session.h"
#include "support/messages/Commands.h"

#include <exception>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

// Of findings that begin at one place, keeps those of the highest severity: the others report the same
// cause.
void keepStrongest(Diagnostics& diagnostics);

// --field of several cycles: pairs that none of them knows. `used` has the others as "FIELD=VARIABLE";
// `cycles` are their names, for the message.
void reportUnknownPairs(const CommonOptions& options, const std::set<std::string>& used,
                        const std::string& cycles, Diagnostics& diagnostics);

// Reports what is wrong with the dotek.toml of these inputs, or of the folder where the command runs where
// there are none.
void checkSettings(const std::vector<std::string>& inputs, Session& session);

// What a command gives that threw: a defect of the data files, what the system refused, a lack of memory, or
// a defect of Dotek (status 3).
Outcome outcomeOf(const std::exception_ptr& thrown);

// Calls what gives an outcome; nothing is thrown.
template <class Call> Outcome caught(const Call& call) {
  try {
    return call();
  } catch (...) {
    return outcomeOf(std::current_exception());
  }
}

// Runs a command in a session of its own; nothing is thrown.
template <class Command> Outcome guarded(const CommonOptions& options, const Command& command) {
  return caught([&] {
    Session session(options);
    return session.diagnostics().hasErrors() ? outcomeOf(session, "") : command(session);
  });
}

// The same; where the dotek.toml of an input is wrong, the command does not begin: it would go on without
// what the file says.
template <class Command>
Outcome guarded(const CommonOptions& options, const std::vector<std::string>& inputs,
                const Command& command) {
  return guarded(options, [&](Session& session) {
    checkSettings(inputs, session);
    return session.diagnostics().hasErrors() ? outcomeOf(session, "") : command(session);
  });
}

} // namespace dotek::driver
