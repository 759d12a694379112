// Jobs of Autodesk: any bytes are read in bounded memory, and what was read becomes a job or a fault in the
// file.
#include "posts/Cnc.h"
#include "posts/CncJob.h"

#include <cstdint>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dotek::posts;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  cnc::isCnc(bytes);
  const auto read = cnc::read(bytes);
  if (const auto* fault = std::get_if<cnc::Fault>(&read)) {
    if (fault->offset > size || fault->text.empty()) std::abort();
    return 0;
  }
  const auto job = cncJob(std::get<cnc::File>(read), {}, {"drilling", "tapping"});
  if (const auto* fault = std::get_if<cnc::Fault>(&job))
    if (fault->offset > size || fault->text.empty()) std::abort();
  return 0;
}
