#include "ir/Walk.h"
#include "lint/NcProgram.h"

#include <algorithm>

namespace dotek::lint::rule {
namespace {

// The axis of #5001 or #5041 and the following: where the axis is, past the contact by what it needs to stop.
// #5021 has no skip position beside it.
std::optional<AxisSet> stopAxis(std::uint32_t number) {
  for (const std::uint32_t first : {5001U, 5041U})
    if (number >= first && number <= first + 2) return static_cast<AxisSet>(1U << (number - first));
  return std::nullopt;
}

// What is stored here is held against a contact later: a bound of it, no measure.
bool isBound(const NcProgram& nc, const ir::ProgramStatement& statement) {
  const auto kept = storedNumber(statement);
  if (!kept) return false;
  for (std::size_t i = 0; i < nc.program.body.size(); ++i) {
    bool reads = false, contact = false;
    for (const VariableRead& read : nc.reads(i)) {
      reads = reads || read.number == *kept;
      contact = contact || contactAxis(read.number).has_value();
    }
    if (reads && contact) return true;
  }
  return false;
}

void check(const NcProgram& nc, Report& report) {
  const auto& body = nc.program.body;
  for (const std::size_t i : nc.skips()) {
    const ir::NcBlock* skip = skipOf(body[i]);
    if (hasCode(*skip, 'M', 78)) continue; // of a Haas: an alarm where anything is met, so it arrives
    const ir::ProgramStatement* taken = nullptr;
    std::uint32_t number = 0;
    SourceRange at;
    bool asksContact = false, keepsPlace = false;
    for (std::size_t k = i + 1; k < body.size(); ++k) {
      const auto* block = std::get_if<ir::NcBlock>(&body[k].node);
      if ((block != nullptr && axesOf(*block) != 0) || callOf(body[k]) != nullptr) break;
      if (std::holds_alternative<ir::Exit>(body[k].node)) break;
      for (const VariableRead& read : nc.reads(k))
        asksContact = asksContact || contactAxis(read.number).has_value();
      const auto* store = std::get_if<ir::Store>(&body[k].node);
      if (store == nullptr) continue;
      // A copy by itself is a place to go back to, and so is what is kept of the other axes beside it.
      if (const auto copied = variableNumber(*store->value)) keepsPlace = keepsPlace || stopAxis(*copied);
      if (taken != nullptr || std::holds_alternative<ir::MachineVariable>(store->value->node)) continue;
      ir::eachNode(store->value, [&](const ir::Expression& node) {
        const auto read = variableNumber(node);
        const auto axis = read ? stopAxis(*read) : std::nullopt;
        if (!axis || (*axis & axesOf(*skip)) == 0 || taken != nullptr) return;
        taken = &body[k];
        number = *read;
        at = node.range;
      });
    }
    if (taken == nullptr || asksContact || keepsPlace || isBound(nc, *taken)) continue;
    report
        .at(at.hasPlace() ? at : taken->origin.range(),
            "#{} is where the axis has come to rest after this G31, past the contact by what it needs to "
            "stop, "
            "which grows with the feed; #{} is where the signal came: write that",
            number, 5061 + (number - 1) % 20)
        .note(body[i].origin.range(), "the G31");
  }
}

} // namespace

DOTEK_LINT_RULE(stop_taken_for_contact){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .program = check,
};

} // namespace dotek::lint::rule
