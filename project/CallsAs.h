// What calls in files of the cycle language become.
#pragma once

#include <cstdint>

namespace dotek::stdlib {
struct MacroSet;
}

namespace dotek::project {

struct CallsAs {
  std::uint32_t programLevels = 0;          // as of frontend::cycle::CallForms
  const stdlib::MacroSet* macros = nullptr; // whose programs carry out cycles of the library; nullptr: none
};

} // namespace dotek::project
