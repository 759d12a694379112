// What calls of the macro sets measure, for tests that run them by their meaning.
#pragma once

#include "sim/vendor/VendorMacros.h"

namespace dotek::tests {

// Of all sets, read once.
const sim::MeasuringCycles& measuringCycles();

} // namespace dotek::tests
