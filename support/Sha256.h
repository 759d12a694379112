// The SHA-256 of bytes (FIPS 180-4): names exactly which file a report speaks of.
#pragma once

#include <string>
#include <string_view>

namespace dotek {

// 64 hexadecimal digits in lower case, as `sha256sum` prints them.
std::string sha256(std::string_view bytes);

} // namespace dotek
