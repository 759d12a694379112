// What an input is: recognised by its content; its name only helps where that says little.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace dotek::project {

enum class InputKind : unsigned char { Prog, Macro, Dialog, DefineData, Nc, Suf, Cycle };

// "prog", "mac", "dlg", "define", "nc", "suf", "cycle": what --from takes, beside "listing", which is NC as a
// book prints it.
std::string_view kindName(InputKind kind);
// For messages: "a GibbsCAM macro".
std::string_view kindText(InputKind kind);
std::optional<InputKind> kindByName(std::string_view name);
bool isListing(const std::optional<std::string>& from); // --from listing

inline constexpr std::string_view kEmptyInput = "empty";

struct Recognition {
  std::optional<InputKind> kind; // nothing: no input of Dotek
  // Of a kind: what tells, "12 of 13 lines are blocks of NC". Else what it is instead, as far as that shows:
  // "no language that Dotek reads", "Sinumerik (`GOTOF`)", "an image", kEmptyInput.
  std::string reason;
};

// How many bytes recognise() looks at; it may be given the beginning of a file.
inline constexpr std::size_t kRecognisedBytes = 128 * 1024;

// Any bytes in any encoding; of UTF-16 the kind of its text is given, though nothing reads it. `fileName` may
// be "". `expected`: what the command takes; it counts as the name does where that says nothing.
Recognition recognise(std::string_view fileName, std::string_view bytes,
                      std::optional<InputKind> expected = std::nullopt);

// By its name alone, as `touch.mac`; nothing: the name does not say.
std::optional<InputKind> kindByFileName(std::string_view name);
// A text that shows no language, and nothing else either.
bool showsNothing(const Recognition& recognition);

// For a message about an input that is of no kind: " (an image)"; "" where nothing more is known.
std::string otherwise(const Recognition& recognition);

} // namespace dotek::project
