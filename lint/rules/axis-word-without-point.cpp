#include "lint/ProgBlocks.h"
#include "support/Decimal.h"

#include <set>

namespace dotek::lint::rule {
namespace {

bool isWhole(const std::string& digits) {
  const auto value = parseNumber(digits);
  return value && *value != 0 && digits.find('.') == std::string::npos;
}

bool isLength(const Project& project, char letter) {
  return project.postControl ? project.postControl->isLength(letter)
                             : ir::isAddressIn(stdlib::kLengthAddresses, letter);
}

bool isDwell(const std::vector<ProgWord>& words) {
  for (const ProgWord& word : words)
    if (word.address == 'G' && (word.digits == "4" || word.digits == "04")) return true;
  return false;
}

bool isSelector(const Project& project, std::uint32_t program, char letter) {
  for (const stdlib::MacroSet& set : project.macroSets) {
    for (const stdlib::MacroSignature* signature : set.of(program)) {
      const stdlib::MacroArgument* argument = signature->find(letter);
      if (argument != nullptr && argument->selector) return true;
    }
  }
  return false;
}

// Numeric keywords whose picture prints a point.
std::set<std::string> pointed(const compost::Program& prog) {
  std::set<std::uint32_t> pictures;
  for (const compost::Item& item : prog.items) {
    const auto* picture = std::get_if<compost::PictureDefinition>(&item);
    if (picture != nullptr &&
        picture->picture.text.substr(0, picture->picture.text.find(';')).find('.') != std::string::npos)
      pictures.insert(picture->number);
  }
  std::set<std::string> out;
  for (const compost::Item& item : prog.items) {
    const auto* format = std::get_if<compost::FormatDirective>(&item);
    if (format != nullptr && pictures.contains(format->number)) out.insert(format->name);
  }
  return out;
}

void checkProg(const compost::Program& prog, const Project& project, Report& report) {
  const std::set<std::string> keywords = pointed(prog);
  if (keywords.empty()) return;
  std::vector<ProgBlock> blocks;
  for (const compost::Item& item : prog.items) {
    const auto* routine = std::get_if<compost::Routine>(&item);
    if (routine == nullptr) continue;
    for (const ProgBlock* block : ownBlocks(*routine, prog, project))
      blocks.push_back(*block);
  }
  std::set<char> withPoint;
  for (const ProgBlock& block : blocks)
    for (const ProgWord& word : wordsOf(block, nullptr))
      if (word.hole != nullptr && keywords.contains(word.hole->word->name)) withPoint.insert(word.address);
  for (const ProgBlock& block : blocks) {
    const std::vector<ProgWord> words = wordsOf(block, nullptr);
    if (isDwell(words)) continue;
    const std::uint32_t program = macroCalled(words);
    for (const ProgWord& word : words) {
      if (word.hole != nullptr || !isLength(project, word.address)) continue;
      if (!isWhole(word.digits) || !withPoint.contains(word.address)) continue;
      if (isSelector(project, program, word.address)) continue;
      report.at(word.range,
                "word `{0}{1}` has no decimal point, other words `{0}` of this post have one; a control that "
                "counts increments moves to {2}; write `{0}{1}.`",
                word.address, word.digits, numberText(parseNumber(word.digits).value_or(0) / 1000));
    }
  }
}

void check(const Project& project, Report& report) {
  for (const compost::Program* prog : project.progs)
    checkProg(*prog, project, report);
}

} // namespace

DOTEK_LINT_RULE(axis_word_without_point){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
