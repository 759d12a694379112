#include "lint/PointedPictures.h"

#include <cstdint>
#include <variant>

namespace dotek::lint {

std::set<std::string> printedWithPoint(const compost::Program& prog) {
  std::set<std::uint32_t> pictures;
  std::set<std::string> out;
  for (const compost::Item& item : prog.items)
    if (const auto* picture = std::get_if<compost::PictureDefinition>(&item))
      if (picture->picture.text.substr(0, picture->picture.text.find(';')).find('.') != std::string::npos)
        pictures.insert(picture->number);
  for (const compost::Item& item : prog.items)
    if (const auto* format = std::get_if<compost::FormatDirective>(&item))
      if (pictures.contains(format->number)) out.insert(format->name);
  return out;
}

} // namespace dotek::lint
