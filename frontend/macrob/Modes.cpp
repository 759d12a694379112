#include "frontend/macrob/Modes.h"

#include "frontend/macrob/Calls.h"
#include "frontend/macrob/Walk.h"
#include "ir/Flow.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace dotek::frontend::macrob {
namespace {

constexpr std::size_t kMostBlocks = 20000;

bool isOneOf(double code, std::initializer_list<double> codes) {
  return std::find(codes.begin(), codes.end(), code) != codes.end();
}

bool endsProgram(const Words& words) {
  return findCode(words, 'M', 30) != nullptr || findCode(words, 'M', 2) != nullptr;
}

Certain joined(Certain a, Certain b) {
  return a == b ? a : Certain::Unknown;
}
int joined(int a, int b, int unknown) {
  return a == b ? a : unknown;
}

Modes joined(Modes a, const Modes& b) {
  a.feed = joined(a.feed, b.feed);
  a.cycle = joined(a.cycle, b.cycle);
  a.levelR = joined(a.levelR, b.levelR);
  a.depth = joined(a.depth, b.depth);
  a.peck = joined(a.peck, b.peck);
  a.compensation = joined(a.compensation, b.compensation);
  a.rotation = joined(a.rotation, b.rotation);
  a.returnsToR = joined(a.returnsToR, b.returnsToR);
  a.cycleCode = joined(a.cycleCode, b.cycleCode, 0);
  a.plane = joined(a.plane, b.plane, 0);
  a.distance = joined(a.distance, b.distance, 0);
  a.system = joined(a.system, b.system, 0);
  a.motion = joined(a.motion, b.motion, -1);
  for (std::size_t i = 0; i < a.at.size(); ++i)
    if (a.at[i] != b.at[i]) a.at[i].reset();
  for (std::size_t i = 0; i < a.turned.size(); ++i)
    a.turned[i] = a.turned[i] && b.turned[i];
  a.callsAfterMoves = a.callsAfterMoves || b.callsAfterMoves;
  return a;
}

Modes unknown(const Modes& before) {
  Modes out;
  out.callsAfterMoves = before.callsAfterMoves;
  return out;
}

// Codes of the family that move the tool to where a program cannot tell, or shift what it counts from.
constexpr std::array kLosePosition = {10.0, 16.0, 28.0, 30.0, 51.0, 51.1, 52.0, 53.0, 92.0};
// Codes of the family that choose another zero.
constexpr std::array kSystems = {54.0, 54.1, 55.0, 56.0, 57.0, 58.0, 59.0};
// Codes of the family that change no mode kept here.
constexpr std::array kOthers = {4.0,  5.1,  8.0,  9.0,  11.0, 15.0, 20.0, 21.0, 22.0, 23.0,
                                31.0, 43.0, 44.0, 49.0, 50.0, 50.1, 61.0, 62.0, 63.0, 64.0,
                                67.0, 80.0, 94.0, 95.0, 96.0, 97.0, 98.0, 99.0};

template <class Codes> bool isIn(double code, const Codes& codes) {
  return std::find(codes.begin(), codes.end(), code) != codes.end();
}

bool isKept(double code) {
  return code == 0 || isOneOf(code, {1, 2, 3, 17, 18, 19, 40, 41, 42, 68, 69, 90, 91}) ||
         (code >= 73 && code <= 89 && code == std::floor(code)) || isIn(code, kLosePosition) ||
         isIn(code, kSystems) || isIn(code, kOthers);
}

// M codes that a builder may have given a macro are not known.
bool isKeptM(double code, const stdlib::Control* control) {
  if (isOneOf(code, {0, 1, 3, 4, 5, 6, 7, 8, 9, 19, 29})) return true;
  return control != nullptr && code >= 0 && code < 1e5 &&
         control->find('M', static_cast<std::uint32_t>(std::lround(code * 10))) != nullptr;
}

bool callsByCode(char letter, double code, const stdlib::Control* control) {
  return control != nullptr &&
         std::any_of(control->callCodes.begin(), control->callCodes.end(), [&](const stdlib::CallCode& call) {
           return call.letter == letter &&
                  (letter == 'T' || (code >= call.first && code < call.first + call.count));
         });
}

// Whether the codes of the block are all known, so that its effect is.
bool isPlain(const Words& words, const stdlib::Control* control) {
  return std::all_of(words.words.begin(), words.words.end(), [&](const nc::Word& word) {
    if (word.address != 'G' && word.address != 'M' && word.address != 'T') return true;
    const auto code = literal(word);
    if (word.address == 'T') return !callsByCode('T', 0, control);
    if (!code || callsByCode(word.address, *code, control)) return false;
    return word.address == 'G' ? isKept(*code) : isKeptM(*code, control);
  });
}

bool hasWord(const Words& words, char letter) {
  return std::any_of(words.words.begin(), words.words.end(),
                     [&](const nc::Word& word) { return word.address == letter; });
}

void move(const Words& words, Modes& modes, const stdlib::Control* control) {
  bool lost = false, system = false, skips = false, length = false, other = false;
  for (const nc::Word& word : words.words) {
    const auto code = word.address == 'G' ? literal(word) : std::nullopt;
    if (!code) continue;
    lost = lost || isIn(*code, kLosePosition);
    system = system || isIn(*code, kSystems);
    skips = skips || *code == 31;
    length = length || isOneOf(*code, {43, 44, 49});
    other = other || isOneOf(*code, {4, 68});
  }
  if (lost || findCode(words, 'M', 6) != nullptr || modes.motion < 0) return modes.at.fill(std::nullopt);
  if (system) modes.at.fill(std::nullopt);
  if (other) return;
  if (length) modes.at[2].reset();
  for (const nc::Word& word : words.words) {
    const std::size_t axis = word.address >= 'X' && word.address <= 'Z'
                                 ? static_cast<std::size_t>(word.address - 'X')
                                 : modes.at.size();
    if (std::string_view("UVW").find(word.address) != std::string_view::npos) modes.at.fill(std::nullopt);
    if (axis >= modes.at.size()) continue;
    std::optional<double>& at = modes.at[axis];
    const auto value = literal(word);
    const auto* number = word.value == nullptr ? nullptr : std::get_if<nc::Number>(&word.value->node);
    const auto* negated = word.value == nullptr ? nullptr : std::get_if<nc::Negated>(&word.value->node);
    if (negated != nullptr) number = std::get_if<nc::Number>(&negated->operand->node);
    // Without a point it may count increments.
    const bool certain =
        number != nullptr && (number->point || number->value == 0 ||
                              (control != nullptr && !control->countsIncrements(word.address)));
    if (!value || !certain || skips || modes.cycle != Certain::No || modes.distance == 0)
      at.reset();
    else if (modes.distance == 90)
      at = value;
    else if (at)
      *at += *value;
  }
}

// Which axes moved in turned coordinates. G28 and others that take the words go to a place of the machine.
void turn(const Words& words, const Modes& before, Modes& modes) {
  bool other = findCode(words, 'M', 6) != nullptr;
  for (const nc::Word& word : words.words) {
    const auto code = word.address == 'G' ? literal(word) : std::nullopt;
    other = other || (code && isOneOf(*code, {4, 10, 28, 29, 30, 31, 52, 53, 60, 68, 92}));
  }
  const bool turns = before.rotation == Certain::Yes && modes.rotation == Certain::Yes && modes.plane != 0;
  for (std::size_t i = 0; i < modes.turned.size(); ++i) {
    const auto letter = static_cast<char>('X' + i);
    if (!hasWord(words, letter)) continue;
    const bool inPlane = turns && letter != lettersOf(modes.plane).depth;
    if (inPlane && !other && modes.motion >= 0)
      modes.turned[i] = true;
    else if (other || modes.distance != 91)
      modes.turned[i] = false;
  }
}

Modes after(const Block& block, const Modes& before, const stdlib::Control* control) {
  if (std::holds_alternative<Unread>(block.body)) return unknown(before);
  const auto* words = std::get_if<Words>(&block.body);
  if (words == nullptr) return block.repaired ? unknown(before) : before;
  if (const auto call = callOf(*words); call && call->kind != CallKind::Return) {
    Modes out = unknown(before);
    if (call->kind == CallKind::Simple) { // gives back the modes that it needs otherwise
      out.plane = before.plane;
      out.distance = before.distance;
    }
    if (call->kind == CallKind::AfterMoves || call->kind == CallKind::EachBlock) out.callsAfterMoves = true;
    if (call->kind == CallKind::Off) {
      if (!before.callsAfterMoves) return before;
      out.callsAfterMoves = false;
    }
    return out;
  }
  if (before.callsAfterMoves || !isPlain(*words, control)) return unknown(before);
  Modes out = within(*words, before);
  if (hasWord(*words, 'F')) out.feed = Certain::Yes;
  if (out.cycle != Certain::No) {
    if (hasWord(*words, 'R')) out.levelR = Certain::Yes;
    if (hasWord(*words, 'Q')) out.peck = Certain::Yes;
    if (out.plane == 0 || hasWord(*words, lettersOf(out.plane).depth)) out.depth = Certain::Yes;
  }
  if (block.repaired)
    out.at.fill(std::nullopt); // its codes are known, its values are not
  else
    move(*words, out, control);
  turn(*words, before, out);
  return out;
}

} // namespace

const PlaneLetters& lettersOf(int plane) {
  static constexpr std::array<PlaneLetters, 3> kPlanes = {{
      {{'X', 'Y'}, {'I', 'J'}, 'Z', 'K'},
      {{'Z', 'X'}, {'K', 'I'}, 'Y', 'J'},
      {{'Y', 'Z'}, {'J', 'K'}, 'X', 'I'},
  }};
  return kPlanes[static_cast<std::size_t>(plane - 17)];
}

bool isMain(const Program& program) {
  return program.name && std::any_of(program.blocks.begin(), program.blocks.end(), [](const Block& block) {
           const auto* words = std::get_if<Words>(&block.body);
           return words != nullptr && endsProgram(*words);
         });
}

Modes within(const Words& words, Modes out) {
  for (const nc::Word& word : words.words) {
    const auto number = word.address == 'G' ? literal(word) : std::nullopt;
    if (!number || *number != std::floor(*number) || std::abs(*number) > 1000) continue;
    const int code = static_cast<int>(*number);
    if (code >= 0 && code <= 3) {
      out.motion = code;
      out.cycle = Certain::No;
    }
    if (code >= 17 && code <= 19) out.plane = code;
    if (code >= 40 && code <= 42) out.compensation = code == 40 ? Certain::No : Certain::Yes;
    if (code == 68 || code == 69) out.rotation = code == 68 ? Certain::Yes : Certain::No;
    if (code == 80) out.cycle = Certain::No;
    if (code == 90 || code == 91) out.distance = code;
    if (code >= 54 && code <= 59) out.system = code;
    if (code == 98 || code == 99) out.returnsToR = code == 99 ? Certain::Yes : Certain::No;
    if (code == 73 || code == 74 || code == 76 || (code >= 81 && code <= 89)) {
      const Certain kept = out.cycle == Certain::No ? Certain::No : Certain::Unknown;
      if (out.cycle != Certain::Yes) out.levelR = out.depth = out.peck = kept;
      out.cycle = Certain::Yes;
      out.cycleCode = code;
    }
  }
  if (findCode(words, 'G', 54.1) != nullptr) out.system = 0;
  return out;
}

namespace {

// Blocks that may run after each block; `blocks.size()`: the program ends there. All computed jumps lead to
// the same ones.
struct Successors {
  std::vector<ir::Next> next;
  std::vector<bool> computed;
  std::vector<std::size_t> numbered; // blocks with a number
};

Successors successorsOf(const Program& program) {
  const std::size_t count = program.blocks.size();
  std::map<std::uint64_t, std::vector<std::size_t>> numbered;
  for (std::size_t i = 0; i < count; ++i)
    if (program.blocks[i].sequenceNumber) numbered[program.blocks[i].sequenceNumber->value].push_back(i);
  Successors successors;
  for (const auto& [number, places] : numbered)
    successors.numbered.insert(successors.numbered.end(), places.begin(), places.end());
  successors.computed.resize(count);
  std::vector<ir::Next>& out = successors.next;
  out.resize(count);
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < count; ++i) {
    const Block& block = program.blocks[i];
    bool falls = true;
    const auto* words = std::get_if<Words>(&block.body);
    if (words != nullptr && (endsProgram(*words) || findCode(*words, 'M', 99) != nullptr)) {
      out[i].add(count);
      falls = block.blockDelete.has_value();
    }
    if (const Goto* jump = gotoOf(block)) {
      falls = !std::holds_alternative<Goto>(block.body) || block.blockDelete;
      if (const auto target = literal(*jump->target)) {
        const auto found = *target >= 0 && *target < 1e15 ? numbered.find(static_cast<std::uint64_t>(*target))
                                                          : numbered.end();
        if (found != numbered.end()) {
          const auto later = std::upper_bound(found->second.begin(), found->second.end(), i);
          out[i].add(later != found->second.end() ? *later : found->second.front());
        }
      } else {
        successors.computed[i] = true;
      }
    }
    if (std::holds_alternative<Do>(block.body)) open.push_back(i);
    if (std::holds_alternative<End>(block.body) && !open.empty()) {
      // A loop without a condition is left by jumps alone.
      const std::size_t begin = open.back();
      open.pop_back();
      out[i].add(begin);
      falls = false;
      if (std::get<Do>(program.blocks[begin].body).condition != nullptr) out[begin].add(i + 1);
    }
    if (falls) out[i].add(i + 1);
  }
  return successors;
}

} // namespace

std::vector<std::optional<Modes>> modesBefore(const Program& program, const stdlib::Control* control) {
  const std::size_t count = program.blocks.size();
  std::vector<std::optional<Modes>> out;
  if (count == 0 || count > kMostBlocks) return out;
  out.resize(count);
  Modes entry;
  if (isMain(program)) {
    entry.feed = entry.cycle = entry.compensation = entry.rotation = Certain::No;
    entry.levelR = entry.depth = entry.peck = Certain::No;
    entry.plane = 17;
    entry.system = 54;
  }
  out[0] = entry;
  const Successors successors = successorsOf(program);
  std::optional<Modes> atJumps; // after the computed jumps
  std::vector<std::size_t> work = {0};
  while (!work.empty()) {
    const std::size_t at = work.back();
    work.pop_back();
    const Block& block = program.blocks[at];
    Modes then = after(block, *out[at], control);
    if (block.blockDelete) then = joined(then, *out[at]);
    const auto reaches = [&](std::optional<Modes>& there) {
      const Modes merged = there ? joined(*there, then) : then;
      if (there && *there == merged) return false;
      there = merged;
      return true;
    };
    for (const std::size_t next : successors.next[at])
      if (next < count && reaches(out[next])) work.push_back(next);
    if (!successors.computed[at] || !reaches(atJumps)) continue;
    for (const std::size_t next : successors.numbered)
      if (reaches(out[next])) work.push_back(next);
  }
  return out;
}

std::vector<bool> passedByAllPaths(const Program& program) {
  const std::size_t count = program.blocks.size();
  const Successors successors = successorsOf(program);
  constexpr std::size_t kNone = SIZE_MAX;
  std::vector<std::size_t> from(count + 1, kNone); // on the way from the first block
  bool jumped = false;                             // what computed jumps lead to is looked at once
  const auto eachNext = [&](std::size_t at, const auto& visit) {
    if (at >= count) return;
    for (const std::size_t next : successors.next[at])
      if (next <= count) visit(next);
    if (!successors.computed[at] || std::exchange(jumped, true)) return;
    for (const std::size_t next : successors.numbered)
      visit(next);
  };
  std::vector<std::size_t> work = {0};
  from[0] = 0;
  while (!work.empty()) {
    const std::size_t at = work.back();
    work.pop_back();
    eachNext(at, [&](std::size_t next) {
      if (from[next] != kNone) return;
      from[next] = at;
      work.push_back(next);
    });
  }
  std::vector<bool> out(count, from[count] == kNone);
  if (count == 0 || from[count] == kNone) return out;

  // One path to the end; all others leave it and come back. A block that none goes around is passed by all.
  std::vector<std::size_t> path = {count};
  while (path.back() != 0)
    path.push_back(from[path.back()]);
  std::reverse(path.begin(), path.end());
  std::vector<std::size_t> place(count + 1, kNone);
  for (std::size_t i = 0; i < path.size(); ++i)
    place[path[i]] = i;
  std::vector<bool> seen(count + 1, false);
  std::size_t farthest = 0;
  jumped = false;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (farthest == i) out[path[i]] = true;
    work = {path[i]};
    while (!work.empty()) {
      const std::size_t at = work.back();
      work.pop_back();
      eachNext(at, [&](std::size_t next) {
        if (place[next] != kNone) {
          farthest = std::max(farthest, place[next]);
        } else if (!seen[next]) {
          seen[next] = true;
          work.push_back(next);
        }
      });
    }
  }
  return out;
}

} // namespace dotek::frontend::macrob
