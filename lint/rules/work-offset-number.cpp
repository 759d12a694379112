#include "frontend/macrob/Calls.h"
#include "lint/Probing.h"

#include <cmath>

namespace dotek::lint::rule {
namespace {

// Numbers that the macro takes for a work offset: G54 to G59 by their G number; 1 to 6, or those of the
// additional systems and of the external offset, by index; S154.01 to S154.99 are the additional systems G154
// of a Haas, and G54.1 P1 to P99 where a set follows them. OfHaas: an index only in the version for it.
enum class Named : std::uint8_t { None, OfHaas, Offset };
Named namedBy(stdlib::SystemCode code, double number) {
  const bool byNumber = code == stdlib::SystemCode::GNumber;
  if (number > 154 && number < 155) return byNumber ? Named::Offset : Named::OfHaas;
  if (number != std::floor(number))
    return byNumber && number > 54 && number < 55 ? Named::Offset : Named::None;
  if (number >= 54 && number <= 59) return byNumber ? Named::Offset : Named::OfHaas;
  return !byNumber && ((number >= 0 && number <= 7) || (number >= 101 && number <= 400)) ? Named::Offset
                                                                                         : Named::None;
}

// Whether the control has the additional systems of a Haas. Yes where nobody has said which control it is.
bool mayBeHaas(const Project& project) {
  return project.control == nullptr || project.control->find('G', 1540) != nullptr;
}

// Calls of one set in one file: one finding with its places.
class Wrong {
public:
  void add(const stdlib::MacroSet& set, std::string taken, SourceRange range) {
    for (One& one : found_)
      if (one.set == &set && one.taken == taken) return one.places.push_back(range);
    found_.push_back({&set, std::move(taken), {range}});
  }
  void tell(const SourceMap& sources, Report& report) const {
    for (const One& one : found_) {
      Diagnostic& told = report.at(one.places.front(),
                                   "`{}` names no work offset for {}, which takes {}; the macro stops with "
                                   "an alarm, or writes another variable",
                                   sources.textUtf8(one.places.front()), one.set->title, one.taken);
      for (std::size_t i = 1; i < one.places.size(); ++i)
        told.note(one.places[i], "nor does `" + sources.textUtf8(one.places[i]) + "`");
    }
  }

private:
  struct One {
    const stdlib::MacroSet* set = nullptr;
    std::string taken;
    std::vector<SourceRange> places;
  };
  std::vector<One> found_;
};

void checkCall(const macrob::Words& words, const Project& project, Wrong& found) {
  const auto call = macrob::callOf(words);
  const auto number = call ? macrob::calledProgram(*call) : std::nullopt;
  if (!number || call->kind != macrob::CallKind::Simple) return;
  for (const stdlib::MacroSet& set : project.macroSets) {
    const auto signatures = set.of(*number);
    if (signatures.empty()) continue;
    std::string letters;
    for (const macrob::CallArgument& argument : call->arguments)
      letters += argument.word->address;
    if (!mayBeOf(set, *number, letters)) return;
    for (const macrob::CallArgument& argument : call->arguments) {
      const stdlib::MacroArgument* known = signatures.front()->find(argument.word->address);
      if (known == nullptr || known->role != stdlib::ArgumentRole::System) continue;
      const auto value = macrob::literal(*argument.word);
      if (!value) continue;
      const Named named = namedBy(known->systemCode, *value);
      if (named == Named::Offset || (named == Named::OfHaas && mayBeHaas(project))) continue;
      const std::string taken = known->systemCode == stdlib::SystemCode::GNumber ? "54 to 59"
                                : mayBeHaas(project) ? "1 to 6, 54 to 59, or 101 and above"
                                                     : "1 to 6, or 101 and above";
      found.add(set, taken, argument.word->range);
    }
    return;
  }
}

// G10 L2 P0 to P6: the external offset and G54 to G59.
// G54.1 takes the number of the additional system from its block.
void checkAdditional(const macrob::Words& words, Report& report) {
  const auto* code = macrob::findCode(words, 'G', 54.1);
  if (code == nullptr || macrob::callOf(words)) return;
  for (const auto& word : words.words)
    if (word.address == 'P') return;
  report.at(code->range,
            "G54.1 has no P, so which additional work offset is meant is open; the control takes "
            "P1 or stops with an alarm; write P");
}

void checkTable(const macrob::Words& words, const Project& project, Report& report) {
  if (macrob::findCode(words, 'G', 10) == nullptr || macrob::findCode(words, 'L', 2) == nullptr) return;
  for (const auto& word : words.words) {
    const auto value = word.address == 'P' ? macrob::literal(word) : std::nullopt;
    if (value && (*value < 0 || *value > 6))
      report.at(word.range,
                "`{}` names no work offset for G10 L2, which takes P0 to P6; the control stops with an alarm",
                project.sources.textUtf8(word.range));
  }
}

void check(const Project& project, Report& report) {
  for (const NcFile& nc : project.programs) {
    Wrong found;
    for (const macrob::Program& program : nc.file->programs)
      for (const macrob::Block& block : program.blocks)
        if (const auto* words = std::get_if<macrob::Words>(&block.body)) {
          checkCall(*words, project, found);
          checkTable(*words, project, report);
          checkAdditional(*words, report);
        }
    found.tell(project.sources, report);
  }
}

} // namespace

DOTEK_LINT_RULE(work_offset_number){
    .severity = Severity::Warning,
    .tier = Tier::Syntax,
    .check = check,
};

} // namespace dotek::lint::rule
