// What is wrong with a command line, in its own words and not in those of CLI11.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
} // namespace CLI

namespace dotek::cli {

// `error` is what parsing `arguments` by `app` ended with: a misspelt flag, a value that is none of a list,
// an input too many.
std::string mistakeOf(const CLI::ParseError& error, const CLI::App& app,
                      const std::vector<std::string>& arguments);

} // namespace dotek::cli
