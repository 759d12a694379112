#include "cli/Mistakes.h"

#include "support/NearestName.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <optional>
#include <string_view>

namespace dotek::cli {
namespace {

// `a`, `b` or `c`, of `a,b,c`.
std::string choiceOf(std::string_view list) {
  std::string out;
  while (!list.empty()) {
    const std::size_t comma = list.find(',');
    const bool last = comma == std::string_view::npos;
    if (!out.empty()) out += last ? " or " : ", ";
    out += fmt::format("`{}`", list.substr(0, comma));
    list = last ? std::string_view() : list.substr(comma + 1);
  }
  return out;
}

std::vector<std::string> namesOf(std::string_view list) {
  std::vector<std::string> out;
  while (!list.empty()) {
    const std::size_t comma = list.find(',');
    out.emplace_back(list.substr(0, comma));
    list = comma == std::string_view::npos ? std::string_view() : list.substr(comma + 1);
  }
  return out;
}

// What is between the braces of `xml not in {text,json}`; "" without them.
std::string_view listIn(std::string_view text) {
  const std::size_t open = text.find('{');
  const std::size_t close = text.rfind('}');
  if (open == std::string_view::npos || close == std::string_view::npos || close < open) return {};
  return text.substr(open + 1, close - open - 1);
}

std::string didYouMean(std::string_view word, const std::vector<std::string>& known) {
  const std::string near = nearestName(word, known);
  return near.empty() ? "" : "; did you mean `" + near + "`?";
}

// The parts of `NAME<middle>REST`; nullopt where `middle` is not in the text.
struct Split {
  std::string_view name;
  std::string_view rest;
};
std::optional<Split> splitAt(std::string_view text, std::string_view middle) {
  const std::size_t at = text.find(middle);
  if (at == std::string_view::npos) return std::nullopt;
  return Split{text.substr(0, at), text.substr(at + middle.size())};
}

// A text of CLI11 in plain words; "" for one of another form.
std::string inWords(std::string_view text, const std::string& command, bool positional) {
  if (const auto wrong = splitAt(text, " not in {")) {
    const auto value = splitAt(wrong->name, ": ");
    if (!value) return {};
    const std::string_view list = listIn(text);
    return fmt::format("{} takes {}, not `{}`{}", value->name, choiceOf(list), value->rest,
                       didYouMean(value->rest, namesOf(list)));
  }
  if (const auto most = splitAt(text, ": At Most ")) {
    const auto counts = splitAt(most->rest, " required but received ");
    if (!counts) return {};
    int taken = 0;
    std::from_chars(counts->name.data(), counts->name.data() + counts->name.size(), taken);
    const std::string number = taken == 1 ? "one" : std::string(counts->name);
    if (positional)
      return taken == 1 ? fmt::format("`dotek {}` takes one {}, and more are given", command, most->name)
                        : fmt::format("`dotek {}` takes at most {} inputs, and {} are given", command, number,
                                      counts->rest);
    return fmt::format("{} is given {} times, and it takes {} value{}", most->name, counts->rest, number,
                       taken == 1 ? "" : "s");
  }
  if (const auto missing = splitAt(text, ": 1 required ")) {
    const std::string_view list = listIn(missing->rest);
    const std::string_view type = missing->rest.substr(0, missing->rest.find(" missing"));
    if (!list.empty()) return fmt::format("{} needs a value: {}", missing->name, choiceOf(list));
    return fmt::format("{} needs a value{}", missing->name,
                       type == "TEXT" || type.empty() ? "" : fmt::format(": {0} {1}", missing->name, type));
  }
  if (const auto needs = splitAt(text, " requires "))
    return fmt::format("{} goes with {}; give both", needs->name, needs->rest);
  if (const auto excludes = splitAt(text, " excludes "))
    return fmt::format("{} and {} do not go together; give one of them", excludes->name, excludes->rest);
  if (const auto extra = splitAt(text, " expected: ")) {
    const std::string_view first = extra->rest.substr(0, extra->rest.find(' '));
    return first.starts_with('-') ? fmt::format("`dotek {}` has no flag `{}`", command, first)
                                  : fmt::format("`dotek {}` has no use for `{}`", command, first);
  }
  if (const auto needed = splitAt(text, " is required"); needed && needed->name != "A subcommand")
    return fmt::format("`dotek {}` needs {}", command, needed->name);
  return {};
}

std::string partsOf(const CLI::App& command) {
  std::string list;
  for (const CLI::App* part : command.get_subcommands(nullptr))
    list += (list.empty() ? "" : ",") + part->get_name();
  return choiceOf(list);
}

} // namespace

std::string mistakeOf(const CLI::ParseError& error, const CLI::App& app,
                      const std::vector<std::string>& arguments) {
  const auto commands = app.get_subcommands();
  if (commands.empty()) return "a command is missing; `dotek --help` prints the commands";
  const CLI::App* command = commands.front();
  std::string name = command->get_name();
  if (!command->get_subcommands().empty()) {
    command = command->get_subcommands().front();
    name += " " + command->get_name();
  }
  const std::string help = "; `dotek " + name + " --help` prints the flags";
  std::vector<std::string> flags;
  std::string positional;
  for (const CLI::Option* option : command->get_options()) {
    if (option->get_positional()) positional = option->get_name();
    for (const std::string& one : option->get_lnames())
      flags.push_back("--" + one);
  }
  const bool hasFormats = std::find(flags.begin(), flags.end(), "--format") != flags.end();
  for (const std::string& argument : arguments) {
    const std::string flag = argument.substr(0, argument.find('='));
    if (argument == "--") break;
    const bool isPage = flag == "-o" || flag == "--html" || flag == "--output" || flag == "--out";
    if (hasFormats && isPage)
      return fmt::format(
          "`dotek {0}` has no flag `{1}`; it prints what it finds: `dotek {0} .. --format html > "
          "page.html` makes a page",
          name, flag);
    if (!flag.starts_with("--") || std::find(flags.begin(), flags.end(), flag) != flags.end()) continue;
    const std::string near = nearestName(flag, flags);
    return fmt::format("`dotek {}` has no flag `{}`{}{}", name, flag,
                       near.empty() ? "" : "; did you mean `" + near + "`?", near.empty() ? help : "");
  }
  const std::string text = error.what();
  if (command->get_subcommands().empty() && command->get_require_subcommand_min() > 0)
    return fmt::format("`dotek {}` needs what to begin: {}{}", name, partsOf(*command), help);
  const std::string words = inWords(text, name, !positional.empty() && text.starts_with(positional + ": "));
  return words.ends_with("?") ? words : (words.empty() ? text : words) + help;
}

} // namespace dotek::cli
