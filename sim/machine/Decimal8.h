// Numbers of controls that compute with eight decimal digits.
#pragma once

namespace dotek::sim {

// The nearest number of eight significant decimal digits, half away from zero.
double toDecimal8(double value);
// 0, or from 1e-29 to 1e47 in magnitude.
bool fitsDecimal8(double value);

} // namespace dotek::sim
