// What copied blocks leave in force: saved by Modes.cpp where a bare code puts it back, refused otherwise.
#include "backends/common/MacroCall.h"
#include "backends/fanuc/State.h"
#include "ir/Flow.h"
#include "ir/Walk.h"
#include "support/messages/Fanuc.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace dotek::backends::fanuc {

namespace {

using stdlib::Function;

// What one block may have changed: a modal group, or the shift along one axis.
using Key =
    std::pair<char, int>; // 'G' and group; 'S' and axis letter; 'C' and tenths of a code without group
constexpr std::size_t kMostCauses = 4; // of one key: more paths say nothing new

struct Cause {
  std::size_t at = 0;
  std::string text; // "G68", "G52 Y", "H"
  bool operator<(const Cause& other) const { return at != other.at ? at < other.at : text < other.text; }
};
using InForce = std::map<Key, std::set<Cause>>;

bool merge(InForce& into, const InForce& from) {
  bool changed = false;
  for (const auto& [key, causes] : from)
    for (const Cause& cause : causes) {
      auto& known = into[key];
      if (known.size() < kMostCauses && known.insert(cause).second) changed = true;
    }
  return changed;
}

constexpr std::uint32_t kExactStop = 90; // G9 holds in its block only

// Modal, and a bare code of its group puts it back.
bool isMode(const stdlib::CodeInfo& code) {
  switch (code.function) {
  case Function::PathMode:
  case Function::PolarOn:
  case Function::PolarOff:
  case Function::ReturnInitial:
  case Function::ReturnR: return code.group.has_value();
  default: return false;
  }
}

std::optional<std::uint32_t> tenthsOf(const ir::Word& word) {
  const double* value = word.value == nullptr ? nullptr : ir::constantValue(word.value);
  if (value == nullptr || !(*value >= 0 && *value < 100000)) return std::nullopt;
  return static_cast<std::uint32_t>(std::lround(*value * 10));
}

std::string wordText(char letter, std::uint32_t tenths) {
  stdlib::CodeInfo code;
  code.letter = letter;
  code.tenths = tenths;
  return codeText(code);
}

class Copies {
public:
  explicit Copies(State& state) : state_(state) {
    for (const Function function :
         {Function::Rapid, Function::PlaneXY, Function::Absolute, Function::FeedPerMinute})
      if (const auto* code = state.control.find(function); code != nullptr && code->group)
        always_.insert(*code->group);
  }

  CopiedModes find() {
    const auto& list = state_.cycle.body;
    if (std::none_of(list.begin(), list.end(), [](const ir::CycleStatement& statement) {
          return std::holds_alternative<ir::OpaqueBlock>(statement.node);
        }))
      return {};
    const auto next = ir::successors(list);
    std::vector<InForce> before(list.size() + 1);
    std::vector<bool> reached(list.size() + 1, false);
    std::deque<std::size_t> open = {0};
    reached[0] = true;
    for (; !open.empty(); open.pop_front()) {
      const std::size_t at = open.front();
      if (at >= list.size()) continue;
      const InForce after = behind(at, before[at]);
      for (const std::size_t to : next[at]) {
        const bool changed = merge(before[to], after) || !reached[to];
        reached[to] = true;
        if (changed) open.push_back(to);
      }
    }
    for (std::size_t i = 0; i < list.size(); ++i)
      if (reached[i]) report(list[i]);
    for (const auto& [key, causes] : before.back())
      if (key != kAnything && !(key == extendedKey() && isExtendedPutBack()))
        for (const Cause& cause : causes)
          if (!isResult(key, cause)) refuse(key, cause);
    for (std::size_t i = 0; i < list.size(); ++i)
      out_.inForce.push_back(before[i].empty() ? "" : before[i].begin()->second.begin()->text);
    if (!lost_.empty()) state_.remarks.push_back("CHANGES THAT ARE NOT PUT BACK:" + lost_);
    return std::move(out_);
  }

private:
  static constexpr Key kAnything = {'C', -1}; // a subprogram, an unknown code

  std::optional<int> groupOf(Function function) const {
    const auto* code = state_.control.find(function);
    return code == nullptr ? std::nullopt : code->group;
  }
  bool isGroup(const Key& key, Function function) const {
    const auto group = groupOf(function);
    return group && key == Key{'G', *group};
  }
  // The caller has one of G54 to G59, as an alarm makes sure, and that is put back.
  Key extendedKey() const { return {'E', 0}; }
  bool isExtendedPutBack() const { return state_.guards.extended == Guard::Checked; }

  // The length of a tool that the branch itself has loaded: the caller's is that of a tool which is no more
  // in the spindle, and as with G43 the header says so.
  bool endsOwnTool(const Cause& cause) {
    const auto* off = state_.control.find(Function::ToolLengthOff);
    if (off == nullptr || cause.text != codeText(*off)) return false;
    const auto& list = state_.cycle.body;
    const bool own = std::any_of(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(cause.at),
                                 [&](const ir::CycleStatement& statement) { return changesTool(statement); });
    if (own) lost_ += " " + cause.text;
    return own;
  }
  // What the cycle is there to leave; the header says so.
  bool isResult(const Key& key, const Cause& cause) {
    if (isGroup(key, Function::ToolLengthOff)) return endsOwnTool(cause);
    return isGroup(key, Function::RotationOff) && turnsAsMeasured(cause);
  }

  // Turned coordinates by an angle that the program reads from variables, after its last move: what comes
  // next is machined along the part. A written angle, or one that is typed, is none of a measurement.
  bool turnsAsMeasured(const Cause& cause) {
    const auto& list = state_.cycle.body;
    const auto* block = std::get_if<ir::OpaqueBlock>(&list[cause.at].node);
    const bool measured =
        block != nullptr && std::any_of(block->words.begin(), block->words.end(), [](const ir::Word& word) {
          return word.address == 'R' && word.value != nullptr && readsVariable(word.value);
        });
    if (!measured) return false;
    const ir::ProgramFlow flow = ir::flowOf(list);
    std::vector<bool> moves(list.size() + 1);
    std::transform(list.begin(), list.end(), moves.begin(), movesProbe);
    const std::vector<bool> later = ir::leadingTo(moves, flow);
    const ir::Next& next = flow.next[cause.at];
    const bool last = std::none_of(next.begin(), next.end(), [&](std::size_t to) { return later[to]; });
    if (!last) return false;
    lost_ += " " + cause.text;
    out_.staysTurned = true;
    return true;
  }
  static bool readsVariable(const ir::ExpressionPtr& value) {
    bool out = false;
    ir::eachNode(value, [&](const ir::Expression& node) {
      out = out || std::holds_alternative<ir::MachineVariable>(node.node) ||
            std::holds_alternative<ir::MeasuredResult>(node.node);
    });
    return out;
  }
  bool changesTool(const ir::CycleStatement& statement) const {
    const auto* block = std::get_if<ir::OpaqueBlock>(&statement.node);
    return block != nullptr &&
           std::any_of(block->words.begin(), block->words.end(), [&](const ir::Word& word) {
             const auto tenths = tenthsOf(word);
             const auto* code = word.address == 'M' && tenths ? state_.control.find('M', *tenths) : nullptr;
             return code != nullptr && code->function == Function::ToolChange;
           });
  }

  InForce behind(std::size_t at, InForce now) const {
    const ir::CycleStatement& statement = state_.cycle.body[at];
    match(
        statement,
        [&](const ir::SetMode& node) {
          if (node.mode == ir::Mode::CutterCompOff) clear(now, Function::CutterCompOff);
          if (node.mode == ir::Mode::CannedCycleOff) clear(now, Function::CannedCycleOff);
          if (node.mode == ir::Mode::WorkSystem) now.erase(extendedKey());
        },
        [&](const ir::OpaqueBlock& node) { apply(at, node, now); },
        [](const ir::OneOf<ir::Label, ir::Jump, ir::Branch, ir::Store, ir::Move, ir::Measure, ir::CallCycle,
                           ir::ProbePower, ir::Comment, ir::Assign, ir::Return, ir::Spindle, ir::Coolant,
                           ir::Dwell, ir::Stop, ir::Alarm, ir::Port, ir::Print> auto&) {});
    return now;
  }
  void clear(InForce& now, Function function) const {
    if (const auto group = groupOf(function)) now.erase({'G', *group});
  }

  void apply(std::size_t at, const ir::OpaqueBlock& block, InForce& now) const {
    bool takesH = false; // a code of the block reads H in its own path
    for (const ir::Word& word : block.words) {
      const auto tenths = tenthsOf(word);
      if ((word.address != 'G' && word.address != 'M') || !tenths) continue;
      const auto* code = state_.control.find(word.address, *tenths);
      if (code == nullptr ? word.address == 'G' : code->function == Function::SubprogramCall) {
        now[kAnything] = {{at, wordText(word.address, *tenths)}};
        takesH = true;
      } else if (code != nullptr && word.address == 'G') {
        takesH = takesH || code->function == Function::ToolLengthPlus || !code->group;
        applyCode(at, *code, block, now);
      }
    }
    const auto length = groupOf(Function::ToolLengthOff);
    if (takesH || !length) return;
    for (const ir::Word& word : block.words)
      if (word.address == 'H' && !now.contains({'G', *length})) now[{'G', *length}] = {{at, "H"}};
  }

  void applyCode(std::size_t at, const stdlib::CodeInfo& code, const ir::OpaqueBlock& block,
                 InForce& now) const {
    const std::string text = codeText(code);
    switch (code.function) {
    case Function::LocalShift: return shift(at, text, block, now);
    case Function::SetPosition: now[{'C', static_cast<int>(code.tenths)}] = {{at, text}}; return;
    case Function::ExtendedWorkSystem: now[extendedKey()] = {{at, text}}; return;
    case Function::WorkSystem: now.erase(extendedKey()); return;
    case Function::ToolLengthPlus: // demanded as well; that another H is in force is in the header
    case Function::CutterCompOff:
    case Function::CannedCycleOff:
    case Function::RotationOff:
    case Function::ScalingOff:
    case Function::Metric: // demanded of the caller
      if (code.group) now.erase({'G', *code.group});
      return;
    default:
      if (isMode(code)) return;      // saved
      if (smoothsPath(code)) return; // the header says so
      if (code.function == Function::PathMode && code.tenths != kExactStop) {
        now[{'C', static_cast<int>(code.tenths)}] = {{at, text}};
        return;
      }
      if (code.group && !always_.contains(*code.group)) now[{'G', *code.group}] = {{at, text}};
    }
  }

  // How exactly corners are passed, as G8 and G5.1 say it: no position depends on it, and no variable tells
  // it.
  static bool smoothsPath(const stdlib::CodeInfo& code) {
    return code.function == Function::PathMode && !code.group && code.tenths != kExactStop;
  }

  // The caller has no shift: 0 along the axis is none.
  static void shift(std::size_t at, const std::string& code, const ir::OpaqueBlock& block, InForce& now) {
    for (const ir::Word& word : block.words) {
      if (std::string_view("XYZABCUVW").find(word.address) == std::string_view::npos) continue;
      const double* value = word.value == nullptr ? nullptr : ir::constantValue(word.value);
      const Key key = {'S', word.address};
      if (value != nullptr && *value == 0)
        now.erase(key);
      else
        now[key] = {{at, code + " " + word.address}};
    }
  }

  // What is saved, and what the user has to know, for each block that may run.
  void report(const ir::CycleStatement& statement) {
    const auto* block = std::get_if<ir::OpaqueBlock>(&statement.node);
    if (block == nullptr) return;
    for (const ir::Word& word : block->words) {
      const auto tenths = tenthsOf(word);
      if ((word.address != 'G' && word.address != 'M') || !tenths) continue;
      const auto* code = state_.control.find(word.address, *tenths);
      if (word.address == 'M') {
        const bool subprogram = code != nullptr && code->function == Function::SubprogramCall;
        if (code == nullptr || subprogram || code->function == Function::Other ||
            code->function == Function::ToolChange)
          lose(word, *tenths);
        out_.workSystem = out_.workSystem || subprogram;
      } else if (code != nullptr && (code->function == Function::ToolLengthPlus || smoothsPath(*code))) {
        lose(word, *tenths);
      } else if (code == nullptr) {
        const std::string text = wordText('G', *tenths);
        out_.workSystem = true;
        if (state_.reported.insert("copied " + text).second)
          state_.diagnostics.report<diag::CopiedCodeUnknown>(
              word.range.hasPlace() ? word.range : statement.origin.range(), state_.control.title, text);
      } else if (code->function == Function::WorkSystem || code->function == Function::ExtendedWorkSystem) {
        out_.workSystem = true;
      } else if (isMode(*code) && !always_.contains(*code->group)) {
        always_.insert(*code->group); // once
        out_.groups.push_back(code);
      }
    }
  }
  void lose(const ir::Word& word, std::uint32_t tenths) {
    const std::string text = wordText(word.address, tenths);
    if (state_.reported.insert("not put back " + text).second) lost_ += " " + text;
  }

  void refuse(const Key& key, const Cause& cause) {
    const ir::CycleStatement& statement = state_.cycle.body[cause.at];
    std::string how = "under it", remedy = "take the block out of the branch";
    const auto end = [&](std::string_view what, Function off) {
      how = what;
      if (const auto* code = state_.control.find(off))
        remedy = "write `" + codeText(*code) + "` after it, or take the block out of the branch";
    };
    if (isGroup(key, Function::ToolLengthOff))
      how = "without the tool length that it had, and a code that puts it back would move the axis";
    else if (isGroup(key, Function::CutterCompOff))
      end("beside its path", Function::CutterCompOff);
    else if (isGroup(key, Function::CannedCycleOff))
      end("drilling at its next positions", Function::CannedCycleOff);
    else if (isGroup(key, Function::RotationOff))
      end("in turned coordinates", Function::RotationOff);
    else if (isGroup(key, Function::ScalingOff))
      end("in scaled coordinates", Function::ScalingOff);
    else if (key == extendedKey())
      how = "in another work system";
    else if (key.first == 'S') {
      how = "in shifted coordinates";
      remedy = "write `" + cause.text + "0.` after it, or take the block out of the branch";
    }
    state_.refuse<diag::ModeNotRestored>(statement.origin.range(), cause.text, how, remedy);
  }

  State& state_;
  CopiedModes out_;
  std::set<int> always_; // groups that are put back anyway
  std::string lost_;
};

} // namespace

CopiedModes findCopiedModes(State& state) {
  return Copies(state).find();
}

} // namespace dotek::backends::fanuc
