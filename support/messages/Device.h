// Messages of Device.def as types of the namespace diag.
#pragma once

#include "support/Diagnostics.h"

namespace dotek::diag {
#define DOTEK_DIAGNOSTIC DOTEK_MESSAGE_TYPE
#include "support/messages/Device.def"
#undef DOTEK_DIAGNOSTIC
} // namespace dotek::diag
