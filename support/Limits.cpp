#include "support/Limits.h"

namespace dotek {

std::span<const LimitInfo> limitTable() {
  static constexpr LimitInfo kTable[] = {
#define DOTEK_LIMIT_ROW(member, name, value, what) {name, &Limits::member, what},
      DOTEK_LIMITS(DOTEK_LIMIT_ROW)
#undef DOTEK_LIMIT_ROW
  };
  return kTable;
}

} // namespace dotek
