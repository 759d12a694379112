#include "lint/Machining.h"

#include "lint/Skips.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace dotek::lint {
namespace {

using Codes = std::initializer_list<double>;

bool isOneOf(double code, Codes codes) {
  return std::find(codes.begin(), codes.end(), code) != codes.end();
}

// M codes that neither turn the spindle nor stop it, on every machine of the family.
constexpr std::array kNeutral = {0.0, 1.0, 7.0, 8.0, 9.0, 10.0, 11.0, 30.0, 2.0, 48.0, 49.0};

constexpr double kOffsetOfHaas = 154; // with P a work offset

struct ModeCodes {
  Mode mode;
  double begin, begin2, end;
};
constexpr std::array kModeCodes = {
    ModeCodes{Mode::Compensation, 41, 42, 40}, ModeCodes{Mode::Rotation, 68, 68, 69},
    ModeCodes{Mode::Scaling, 51, 51, 50},      ModeCodes{Mode::Polar, 16, 16, 15},
    ModeCodes{Mode::CannedCycle, 81, 82, 80},
};

bool isCycle(double code) {
  return code == 73 || code == 74 || code == 76 || (code >= 81 && code <= 89 && code == std::floor(code));
}

Machining unknown(const Machining& before) {
  Machining out;
  out.spindle = out.speed = out.length = out.offset = out.taken = Certain::Unknown;
  out.lengthOf = before.lengthOf;
  out.change = before.change;
  for (Machining::Modal& mode : out.modes)
    mode.on = Certain::Unknown;
  return out;
}

Certain joined(Certain a, Certain b) {
  return a == b ? a : Certain::Unknown;
}

bool meet(Machining& into, const Machining& other) {
  const Machining before = into;
  into.spindle = joined(into.spindle, other.spindle);
  into.speed = joined(into.speed, other.speed);
  into.length = joined(into.length, other.length);
  into.offset = joined(into.offset, other.offset);
  for (std::size_t i = 0; i < kModes; ++i) {
    into.modes[i].on = joined(into.modes[i].on, other.modes[i].on);
    if (into.modes[i].since != other.modes[i].since) into.modes[i].since = Machining::kNowhere;
  }
  // A fact may change a few times only: what disagrees stays unknown.
  if (into.tool != other.tool) into.tool = -1;
  if (into.called != other.called) into.called = -1;
  if (into.lengthOf != other.lengthOf) into.lengthOf = -1;
  into.taken = joined(into.taken, other.taken);
  if (into.change != other.change) into.change = Machining::kNowhere;
  if (into.distance != other.distance) into.distance = 0;
  if (into.motion != other.motion) into.motion = -1;
  into.lowered = into.lowered && other.lowered;
  if (into.z != other.z) into.z.reset();
  return !(into == before);
}

void moveZ(const ir::NcBlock& block, Machining& state) {
  const ir::Word* z = firstWord(block, "Z");
  const bool elsewhere = std::any_of(block.words.begin(), block.words.end(), [](const ir::Word& word) {
    const double* code = word.address == 'G' ? ir::constantValue(word.value) : nullptr;
    return code != nullptr && isOneOf(*code, {10, 28, 30, 31, 52, 53, 92, 4});
  });
  if (elsewhere) {
    if (z != nullptr) state.z.reset();
    if (codeWord(block, 'G', 53) != nullptr || codeWord(block, 'G', 28) != nullptr) state.lowered = false;
    return;
  }
  if (z == nullptr || state.mode(Mode::CannedCycle).on != Certain::No) return;
  const double* value = ir::constantValue(z->value);
  if (state.motion == 0) state.lowered = false;
  if (state.motion > 0 && value != nullptr)
    if ((state.distance == 91 && *value < 0) || (state.distance == 90 && state.z && *value < *state.z))
      state.lowered = true;
  if (state.distance == 90 && value != nullptr)
    state.z = *value;
  else
    state.z.reset();
}

Machining after(const ir::ProgramStatement& statement, std::size_t at, const Machining& before) {
  if (const ir::Call* call = callOf(statement)) {
    Machining out = unknown(before);
    // A macro gives back what it changes, as for distanceModes().
    if (call->kind != ir::CallKind::Subprogram) out.distance = before.distance;
    return out;
  }
  const auto* block = std::get_if<ir::NcBlock>(&statement.node);
  if (block == nullptr) return before;
  for (const ir::Word& word : block->words) {
    const double* code = ir::constantValue(word.value);
    if ((word.address == 'G' || word.address == 'M') &&
        (code == nullptr ||
         (word.address == 'G' && *code >= 100 && !(*code == kOffsetOfHaas && hasWord(*block, 'P')))))
      return unknown(before);
  }
  Machining out = within(*block, at, before);
  bool changes = false;
  for (const ir::Word& word : block->words) {
    const double* code = ir::constantValue(word.value);
    if (word.address == 'T')
      out.called = code != nullptr && *code >= 0 && *code < 1e6 ? static_cast<int>(*code) : -1;
    if (word.address != 'M') continue;
    if (isOneOf(*code, {3, 4, 13, 14}))
      out.spindle = Certain::Yes;
    else if (isOneOf(*code, {5, 19}))
      out.spindle = Certain::No;
    else if (*code == 6)
      changes = true;
    else if (std::find(kNeutral.begin(), kNeutral.end(), *code) == kNeutral.end())
      out.spindle = Certain::Unknown;
  }
  if (changes) {
    out.spindle = hasCode(*block, 'M', 3) || hasCode(*block, 'M', 4) ? Certain::Yes : Certain::No;
    out.tool = out.called;
    out.called = -1;
    out.taken = Certain::No;
    out.change = at;
    out.lowered = false;
    out.z.reset();
  }
  if (const auto s = wordValue(*block, 'S'); s || hasWord(*block, 'S'))
    out.speed = !s || *s > 0 ? Certain::Yes : Certain::No;
  if (hasWord(*block, 'D')) out.offset = Certain::Yes;
  if (std::any_of(block->words.begin(), block->words.end(), [](const ir::Word& word) {
        const double* code = word.address == 'G' ? ir::constantValue(word.value) : nullptr;
        return code != nullptr && *code >= 43 && *code < 45;
      })) {
    out.lengthOf = out.tool;
    out.taken = Certain::Yes;
  }
  moveZ(*block, out);
  return out;
}

} // namespace

const ir::Word* codeWord(const ir::NcBlock& block, char address, double code) {
  for (const ir::Word& word : block.words)
    if (const double* value = ir::constantValue(word.value);
        word.address == address && value != nullptr && *value == code)
      return &word;
  return nullptr;
}

const ir::Word* firstWord(const ir::NcBlock& block, std::string_view letters) {
  for (const ir::Word& word : block.words)
    if (letters.find(word.address) != std::string_view::npos) return &word;
  return nullptr;
}

int cycleOf(const ir::NcBlock& block) {
  for (const ir::Word& word : block.words) {
    const double* code = word.address == 'G' ? ir::constantValue(word.value) : nullptr;
    if (code != nullptr && isCycle(*code)) return static_cast<int>(*code);
  }
  return 0;
}

Machining within(const ir::NcBlock& block, std::size_t at, Machining out) {
  const auto set = [&](Mode mode, bool on) {
    Machining::Modal& modal = out.modes[static_cast<std::size_t>(mode)];
    if (on && modal.on == Certain::Yes) return;
    modal = on ? Machining::Modal{Certain::Yes, at} : Machining::Modal{};
  };
  for (const ir::Word& word : block.words) {
    const double* code = word.address == 'G' ? ir::constantValue(word.value) : nullptr;
    if (code == nullptr) continue;
    if (*code == 90 || *code == 91) out.distance = static_cast<int>(*code);
    if (isOneOf(*code, {0, 1, 2, 3})) {
      out.motion = static_cast<int>(*code);
      set(Mode::CannedCycle, false);
    }
    if (isCycle(*code)) set(Mode::CannedCycle, true);
    if (*code >= 43 && *code < 45) out.length = Certain::Yes;
    if (*code == 49) out.length = Certain::No;
    for (const ModeCodes& one : kModeCodes) {
      if (one.mode != Mode::CannedCycle && (*code == one.begin || *code == one.begin2)) set(one.mode, true);
      if (*code == one.end) set(one.mode, false);
    }
  }
  return out;
}

std::vector<std::optional<Machining>>
machiningBefore(const ir::Program& program, const ir::ProgramFlow& flow,
                const std::function<bool(const ir::ProgramStatement&)>& touches) {
  if (!endsProgram(program)) return {};
  bool mills = false;
  std::vector<std::size_t> touching;
  for (std::size_t i = 0; i < program.body.size(); ++i) {
    if (touches(program.body[i])) touching.push_back(i);
    const auto* block = std::get_if<ir::NcBlock>(&program.body[i].node);
    if (block == nullptr) continue;
    mills = mills || hasCode(*block, 'M', 6) || hasCode(*block, 'G', 43);
    // A lathe names the offset in T.
    const auto tool = wordValue(*block, 'T');
    if (tool && *tool >= 100 && !hasCode(*block, 'M', 6) && !hasCode(*block, 'G', 43)) return {};
  }
  if (!mills) return {};
  auto facts = ir::factsBefore<Machining>(
      program.body, flow, Machining{},
      [&](std::size_t at, std::size_t, const Machining& before) {
        return after(program.body[at], at, before);
      },
      [](Machining& into, const Machining& other) { return meet(into, other); });
  std::set<std::size_t> turned; // changes to tools that the program turns
  for (const std::optional<Machining>& fact : facts)
    if (fact && fact->spindle == Certain::Yes) turned.insert(fact->change);
  std::set<std::size_t> changes;
  std::set<int> tools;
  for (const std::size_t at : touching) {
    // What is called may look whether a tool that has cut is whole.
    if (!facts[at] || (skipOf(program.body[at]) == nullptr && turned.contains(facts[at]->change))) continue;
    changes.insert(facts[at]->change);
    if (facts[at]->tool >= 0) tools.insert(facts[at]->tool);
  }
  for (std::optional<Machining>& fact : facts)
    if (fact) fact->probes = changes.contains(fact->change) || tools.contains(fact->tool);
  return facts;
}

} // namespace dotek::lint
