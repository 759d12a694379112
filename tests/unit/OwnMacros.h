// Programs that call our own macros on G31 (stdlib/macrob/dotek.nc), for tests.
#pragma once

#include "tests/unit/ContactWorld.h"
#include "tests/unit/RunHarness.h"

#include <string>

namespace dotek::tests {

// A world of bodies for machine positions that hold the length of a tool.
class LongTool final : public sim::SkipSignal {
public:
  LongTool(ContactWorld& world, double length) : world_(world), length_(length) {}
  std::optional<double> contact(const sim::SkipMove& move) override {
    sim::SkipMove tip = move;
    tip.machineFrom[2] -= length_;
    tip.machineTo[2] -= length_;
    return world_.contact(tip);
  }

private:
  ContactWorld& world_;
  double length_;
};

// The programs, without the lines `%`.
inline std::string ownMacros() {
  const stdlib::DataFiles files;
  const stdlib::DataFile* const file = files.find("macrob", "dotek");
  REQUIRE(file != nullptr);
  std::string out(file->text);
  for (std::size_t at = 0; (at = out.find('%')) != std::string::npos;)
    out.erase(at, 2);
  return out.substr(out.find("O88"));
}

} // namespace dotek::tests
