// What a command demands of its inputs.
#pragma once

#include "project/Session.h"

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace dotek::project {

// The kind of an input that has to be one of `kinds`, the first being expected. nullopt with an error that
// says what it is, or that it is nothing that Dotek reads. `expected`: what the command takes, "an NC
// program".
std::optional<InputKind> kindAmong(const std::string& path, std::initializer_list<InputKind> kinds,
                                   std::string_view expected, Session& session);

// true, reported: a file that no command line names, but an input, is a pipe or a device. Whoever reads it
// may wait for ever.
bool refusesStream(const std::string& path, SourceRange where, Session& session);

// Of an input that is none: the one message that says what it is instead.
void reportNoInput(const std::string& path, const Recognition& found, Session& session);

} // namespace dotek::project
