#include "tests/MeasuringCycles.h"

#include "project/MacroCycles.h"

namespace dotek::tests {

const sim::MeasuringCycles& measuringCycles() {
  static const sim::MeasuringCycles all = [] {
    project::Session session{project::CommonOptions()};
    sim::MeasuringCycles out;
    for (const stdlib::MacroSet& set : session.macroSets())
      out.merge(project::measuringCycles({&set}, session));
    return out;
  }();
  return all;
}

} // namespace dotek::tests
