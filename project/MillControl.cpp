#include "project/MillControl.h"

#include "support/messages/Output.h"

namespace dotek::project {

bool refuseLathe(const stdlib::Control& control, Session& session) {
  if (!control.turning) return false;
  session.diagnostics().report<diag::ControlOfLathe>({}, control.name);
  return true;
}

} // namespace dotek::project
