// Private to Post*.cpp: the checks of CycleData.mac, run on the values that are posted.
#pragma once

#include "project/CycleFolder.h"
#include "project/Fields.h"
#include "project/Session.h"

namespace dotek::project {

// Reports values that the dialog would not let pass; takes over values that the macro computes.
void runCycleChecks(const CycleFolder& folder, FieldTable& fields, const std::map<std::string, double>& hosts,
                    Session& session);

} // namespace dotek::project
