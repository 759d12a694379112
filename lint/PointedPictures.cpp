#include "lint/PointedPictures.h"

#include <cstdint>
#include <variant>

namespace dotek::lint {
namespace {

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

} // namespace

void eachPointedBlock(const Project& project,
                      const std::function<void(const std::vector<ProgWord>& words,
                                               const std::set<std::string>& pointed)>& visit) {
  const compost::Program* last = nullptr;
  std::set<std::string> pointed;
  eachRoutine(project, [&](const compost::Program& prog, const compost::Routine& routine) {
    if (last != &prog) pointed = printedWithPoint(prog);
    last = &prog;
    for (const ProgBlock* block : ownBlocks(routine, prog, project))
      visit(wordsOf(*block, nullptr), pointed);
  });
}

} // namespace dotek::lint
