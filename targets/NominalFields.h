// Private to CycleCases*.cpp: values with which start and travel lead to the coordinate that a surface gets.
#pragma once

#include "verify/Draw.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dotek::targets {

// Looks for the fields that say which coordinate a surface gets, by trying: a change of one moves one zero
// and no other.
class NominalFields {
public:
  explicit NominalFields(const std::vector<verify::DrawField>& fields) : fields_(fields) {}

  // Start points with no more places than the fields have.
  void roundStart(verify::Case& drawn) const;
  // The case with these fields changed so that no zero is missed; where no field does it, one of the host
  // inputs `starts` is. `misses`: by how much each is, in the order of the program; nothing: the values are
  // none. nullopt: nothing does that.
  std::optional<verify::Case>
  settle(verify::Case drawn, const std::vector<const char*>& starts,
         const std::function<std::optional<std::vector<double>>(const verify::Case&)>& misses);

private:
  const std::vector<verify::DrawField>& fields_;
  std::map<std::size_t, std::string> known_; // field by number of the zero
};

} // namespace dotek::targets
