// STL files: read in bounded memory, and a mesh that is read has an inside.
#include "sim/geometry/Contact.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dotek::sim;
  PartBuilder builder;
  std::string fault = builder.mesh({reinterpret_cast<const char*>(data), size}, 1);
  const std::unique_ptr<Part> part = fault.empty() ? builder.finish(fault) : nullptr;
  if (part == nullptr) {
    if (fault.empty()) std::abort();
    return 0;
  }
  if (!std::isfinite(part->distance({1, 2, 3}))) std::abort();
  firstContact(*part, 2, {50, 40, 30}, {-10, -20, 3});
  firstCollision(*part, {{50, 40, 30}, {50, 40, 60}, 2}, {-90, -70, -30});
  return 0;
}
