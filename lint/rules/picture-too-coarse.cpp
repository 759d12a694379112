#include "lint/Project.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

// Places after the printed point; nothing: none is printed.
std::optional<std::size_t> decimals(const std::string& picture) {
  const std::string body = picture.substr(0, picture.find(';'));
  const std::size_t point = body.find('.');
  if (point == std::string::npos) return std::nullopt;
  return static_cast<std::size_t>(std::count_if(body.begin() + static_cast<std::ptrdiff_t>(point), body.end(),
                                                [](char c) { return c == '#' || c == '0'; }));
}

void check(const Project& project, Report& report) {
  for (const compost::Program* prog : project.progs) {
    for (const compost::Item& item : prog->items) {
      const auto* format = std::get_if<compost::FormatDirective>(&item);
      if (format == nullptr || format->name != "OpFieldData") continue;
      for (const compost::Item& other : prog->items) {
        const auto* picture = std::get_if<compost::PictureDefinition>(&other);
        if (picture == nullptr || picture->number != format->number) continue;
        const auto places = decimals(picture->picture.text);
        if (!places || *places > 1) continue;
        report
            .at(picture->picture.range,
                "fields of cycles print with {} after the point; a coordinate is rounded to a tenth of a "
                "millimetre or worse, which a probe measures much finer; give the picture two decimals or "
                "more",
                *places == 0 ? "no digit" : "one digit")
            .note(format->range, "fields use it here");
      }
    }
  }
}

} // namespace

DOTEK_LINT_RULE(picture_too_coarse){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
