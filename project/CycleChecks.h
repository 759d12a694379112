// The checks of CycleData.mac, run on the values that are posted.
#pragma once

#include "frontend/gibbs/Run.h"
#include "project/CycleFolder.h"
#include "project/Fields.h"
#include "project/Session.h"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dotek::project {

// Names and values as a message says them: `A` = 1 with `B` = 2; none: these values.
std::string rejectedValues(const std::vector<std::pair<std::string, double>>& values);

// A rejection of a dialog that says nothing to its user.
bool isWithoutMessage(std::string_view rejection);

// Whether a rejection names the fields whose values cause it, which costs many runs of the checks.
enum class Blame : std::uint8_t { Fields, Nothing };

// What the macro computes after the dialog, as the CAM stores it, into `values`. A field that the dialog
// shows keeps what the user typed, unless an assumption says otherwise.
void takeComputed(const frontend::gibbs::ChecksResult& result, const CycleFolder& folder,
                  const Session& session, std::map<std::string, double>& values);

// How macros of the folder run on these values, all of which outlive it; reports to the session.
frontend::gibbs::RunContext runContext(const CycleFolder& folder, const FieldTable& fields,
                                       std::map<std::string, double> hosts, Session& session);

// Reports values that the dialog would not let pass; takes over values that the macro computes.
void runCycleChecks(const CycleFolder& folder, FieldTable& fields, const std::map<std::string, double>& hosts,
                    Session& session, Blame blame = Blame::Fields);

} // namespace dotek::project
