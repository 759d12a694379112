// Arcs that say neither a centre nor a radius, by their own code or by one that is still in force; the
// letters of a block under G90 and G91.
#include "frontend/macrob/BlockWords.h"
#include "frontend/macrob/Calls.h"
#include "frontend/macrob/Check.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace dotek::frontend::macrob {
namespace {

// Codes that take no letter of an arc, and no axis word.
bool goesWithArc(double code) {
  constexpr std::array kCodes = {0.0,  1.0,  17.0, 18.0, 19.0, 20.0, 21.0, 40.0, 41.0, 42.0, 43.0, 44.0,
                                 49.0, 53.0, 54.0, 55.0, 56.0, 57.0, 58.0, 59.0, 90.0, 91.0, 94.0};
  return std::find(kCodes.begin(), kCodes.end(), code) != kCodes.end();
}

// The arc's own block has its code.
void ofOwnCode(const CheckedProgram& input, Report& report) {
  for (const Block& block : input.program.blocks) {
    const auto* words = std::get_if<Words>(&block.body);
    if (words == nullptr || block.repaired) continue; // half of it may be on the next line
    const nc::Word* arc = nullptr;
    bool other = false;
    for (const nc::Word& word : words->words) {
      const auto code = word.address == 'G' ? literal(word) : std::nullopt;
      const bool isArc = code && (*code == 2 || *code == 3);
      if (isArc) arc = &word;
      other = other || (word.address == 'G' && !isArc && !(code && goesWithArc(*code)));
    }
    if (arc == nullptr || other || !hasAny(*words, "XYZUVW")) continue;
    const nc::Word* radius = findWord(*words, 'R');
    if (radius != nullptr && literal(*radius) == 0.0)
      report.at(radius->range, "the arc has the radius 0; the control stops with an alarm; write the radius");
    else if (const nc::Word* centre = radius == nullptr ? nullptr : findAnyOf(*words, "IJK");
             centre != nullptr && centre->value != nullptr && literal(*centre) && literal(*centre) != 0.0)
      report.at(
          centre->range,
          "`{}` beside `{}`: the arc has a centre and a radius; the control takes the radius alone; leave "
          "one of them out",
          wordText(*centre), wordText(*radius));
    else if (!hasAny(*words, "IJKR"))
      report.at(
          arc->range,
          "the arc has neither a centre (I, J, K) nor a radius (R); the control stops with alarm 22 or moves "
          "straight; write one of them, or G1");
  }
}

// G2 or G3 of an earlier block is in force on every path. One finding for what follows one arc.
void ofModeInForce(const CheckedProgram& input, Report& report) {
  const std::vector<std::optional<Modes>>& modes = input.modes();
  bool told = false;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const Block& block = input.program.blocks[i];
    const auto* words = std::get_if<Words>(&block.body);
    if (words == nullptr) continue;
    bool certain = !callOf(*words) && modes[i] && !modes[i]->callsAfterMoves, own = false;
    for (const nc::Word& word : words->words) {
      if (word.address == 'M' || word.address == 'T') certain = false;
      if (word.address != 'G') continue;
      const auto code = literal(word);
      own = own || (code && *code >= 0 && *code <= 3);
      certain = certain && code && goesWithArc(*code) && *code != 53;
    }
    if (own) told = false;
    if (!certain || own || told || modes[i]->motion < 2 || modes[i]->cycle != Certain::No) continue;
    const nc::Word* axis = findAnyOf(*words, "XYZUVW");
    if (axis == nullptr || hasAny(*words, "IJKR")) continue;
    told = true;
    report.at(
        axis->range,
        "G{} of an earlier block is still in force, and this one has neither a centre (I, J, K) nor a "
        "radius (R); the control stops with alarm 22 or moves straight; write G1 before it if a straight "
        "move is meant",
        modes[i]->motion);
  }
}

} // namespace

void arcWithoutCentre(const CheckedProgram& input, Report& report) {
  ofOwnCode(input, report);
  ofModeInForce(input, report);
}

// The words before the code are meant in the mode that was in force, those after it in the new one.
void modeAfterAxis(const CheckedProgram& input, Report& report) {
  const std::vector<std::optional<Modes>>& modes = input.modes();
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const auto* words = std::get_if<Words>(&input.program.blocks[i].body);
    if (words == nullptr || !modes[i] || callOf(*words)) continue;
    const nc::Word *before = nullptr, *code = nullptr, *after = nullptr;
    bool plain = true;
    for (const nc::Word& word : words->words) {
      const auto number = word.address == 'G' ? literal(word) : std::nullopt;
      const bool axis = std::string_view("XYZ").find(word.address) != std::string_view::npos;
      if (word.address == 'G' && !(number && (goesWithArc(*number) || *number == 2 || *number == 3)))
        plain = false;
      if (number == 90.0 || number == 91.0) {
        plain = plain && code == nullptr; // of both codesExclude speaks
        code = &word;
      }
      if (axis) (code == nullptr ? before : after) = &word;
    }
    if (!plain || before == nullptr || code == nullptr || after == nullptr) continue;
    if (modes[i]->distance == static_cast<int>(*literal(*code))) continue;
    report.at(code->range,
              "`{0}` comes between the axis words of its block; a Fanuc counts `{1}` by it as well, controls "
              "that take what precedes it in the mode before go elsewhere; write two blocks, or `{0}` first",
              wordText(*code), wordText(*before));
  }
}

} // namespace dotek::frontend::macrob
