// Places of the protocol: lines from 0, columns in the units that client and server agreed on. And names of
// files as the protocol writes them.
#pragma once

#include "support/Source.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace dotek::lsp {

using Json = nlohmann::json;

// What a column counts.
enum class Units : std::uint8_t { Utf8, Utf16 };

// Columns that a text takes.
std::uint32_t columnsOf(std::string_view utf8, Units units);

Json positionOf(const SourceFile& file, std::uint32_t offset, Units units);
Json rangeOf(const SourceFile& file, SourceRange range, Units units);

// The byte that a position of the protocol names. A column after the end of its line is the end of the line,
// a line after the last the end of the text. nullopt: `position` is none.
std::optional<std::uint32_t> offsetOf(const SourceFile& file, const Json& position, Units units);

// The same for the text that an editor holds.
std::optional<std::uint32_t> offsetOf(std::string_view text, const Json& position, Units units);

// "/mill/a b.nc" of "file:///mill/a%20b.nc"; nullopt: another scheme, or broken.
std::optional<std::string> pathOf(std::string_view uri);
std::string uriOf(std::string_view path);

} // namespace dotek::lsp
