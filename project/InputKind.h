// What an input is: recognised by its content, then by its name.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace dotek::project {

enum class InputKind : unsigned char { Prog, Macro, Dialog, DefineData, Nc, Suf };

// "prog", "mac", "dlg", "define", "nc", "suf": what --from takes, beside "listing", which is NC as a book
// prints it.
std::string_view kindName(InputKind kind);
std::optional<InputKind> kindByName(std::string_view name);
bool isListing(const std::optional<std::string>& from); // --from listing
// nullopt: neither content nor name tells.
std::optional<InputKind> recognise(std::string_view fileName, std::string_view bytes);

} // namespace dotek::project
