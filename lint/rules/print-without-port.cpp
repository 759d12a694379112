#include "ir/Dataflow.h"
#include "ir/Match.h"
#include "lint/Skips.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <set>
#include <utility>

namespace dotek::lint::rule {
namespace {

// Assumed: closed, unless a program that is not given has opened it.
enum class PortState : std::uint8_t { Closed, Assumed, Open, Unknown };

constexpr std::string_view kOpenAlready =
    "POPEN while the port is open already; the control may stop with an alarm; take it out, or write PCLOS "
    "before";
constexpr std::string_view kNotOpen =
    "PCLOS while the port is not open; the control may stop with an alarm; take it out, or write the POPEN "
    "that is missing";
constexpr std::string_view kClosed = "nothing has opened the port before this block prints; the control "
                                     "prints nothing or stops with an alarm; "
                                     "write POPEN before, and PCLOS after the last one";
constexpr std::string_view kNobody =
    "neither this program nor one that calls it, as far as they are given, opens the port before this block "
    "prints; the control prints nothing or stops with an alarm; write POPEN before, and PCLOS after the last "
    "one, or lint it together with the program that does";

constexpr std::string_view kLeftOpen =
    "nothing closes the port before the program ends; the end resets the control, which may cut off what is "
    "still to be printed; write PCLOS after the last block that prints";

bool meet(PortState& into, PortState other) {
  if (into == other || into == PortState::Unknown) return false;
  const auto closed = [](PortState one) { return one == PortState::Closed || one == PortState::Assumed; };
  const PortState merged = closed(into) && closed(other) ? PortState::Assumed : PortState::Unknown;
  return std::exchange(into, merged) != merged;
}

// The programs of a project, each judged with the port as those that call it leave it.
class Ports {
public:
  Ports(const Project& project, Report& report) : project_(project), report_(report) {
    eachProgram(project, [&](const ir::Program& program, const macrob::File&) {
      all_.push_back(&program);
      if (program.number != 0) byNumber_[static_cast<std::uint32_t>(program.number)].push_back(&program);
      for (const ir::ProgramStatement& statement : program.body)
        if (const std::uint32_t number = numberOf(statement); number != 0) called_.insert(number);
    });
  }

  void check() {
    for (const ir::Program* program : all_)
      if (!called_.contains(static_cast<std::uint32_t>(program->number)))
        enter(*program, endsProgram(*program) ? PortState::Closed : PortState::Assumed, {});
    while (!open_.empty()) {
      const Entry entry = open_.front();
      open_.pop_front();
      judge(entry);
    }
  }

private:
  struct Entry {
    const ir::Program* program;
    PortState state;
    SourceRange call; // with that state; without a place: nothing calls it
  };
  using Key = std::pair<const ir::Program*, PortState>;

  // Of the program that a statement calls here; 0: none, or its number is computed.
  static std::uint32_t numberOf(const ir::ProgramStatement& statement) {
    const ir::Call* const call = callOf(statement);
    const double* const number =
        call != nullptr && call->program ? ir::constantValue(call->program) : nullptr;
    return number != nullptr && *number >= 1 && *number < 1e8
               ? static_cast<std::uint32_t>(std::lround(*number))
               : 0;
  }

  // The one program of the files that the statement carries out; nullptr: none, or it is not certain.
  const ir::Program* ownOf(const ir::ProgramStatement& statement) const {
    const ir::Call* const call = callOf(statement);
    if (call == nullptr || call->kind == ir::CallKind::AfterMoves) return nullptr;
    const auto at = byNumber_.find(numberOf(statement));
    return at != byNumber_.end() && at->second.size() == 1 ? at->second.front() : nullptr;
  }

  bool isVendors(const ir::ProgramStatement& statement) const {
    const std::uint32_t number = numberOf(statement);
    if (number == 0 || byNumber_.contains(number)) return false;
    for (const stdlib::MacroSet& set : project_.macroSets)
      if (set.calls(number)) return true;
    return false;
  }

  PortState after(const ir::ProgramStatement& statement, PortState state, int depth) {
    if (const auto* port = std::get_if<ir::Port>(&statement.node))
      return port->open ? PortState::Open : PortState::Closed;
    if (callOf(statement) == nullptr) return state;
    if (const ir::Program* own = ownOf(statement)) return leaves(*own, state, depth + 1);
    // A vendor's macro that prints opens the port and closes it.
    return state != PortState::Open && isVendors(statement) ? state : PortState::Unknown;
  }

  std::vector<std::optional<PortState>> states(const ir::Program& program, PortState entry, int depth) {
    return ir::factsBefore<PortState>(
        program.body, entry,
        [&](std::size_t at, std::size_t, PortState state) { return after(program.body[at], state, depth); },
        meet);
  }

  // How a call leaves the port.
  PortState leaves(const ir::Program& program, PortState entry, int depth) {
    constexpr int kDeepest = 32; // no control nests more calls
    if (depth > kDeepest) return PortState::Unknown;
    // Of one that calls itself nothing is known.
    const auto [at, added] = left_.try_emplace(Key{&program, entry}, PortState::Unknown);
    if (!added) return at->second;
    std::optional<PortState> out;
    const auto before = states(program, entry, depth);
    for (std::size_t i = 0; i < program.body.size(); ++i) {
      if (!before[i] || !std::holds_alternative<ir::Exit>(program.body[i].node)) continue;
      if (out)
        meet(*out, *before[i]);
      else
        out = *before[i];
    }
    return left_[Key{&program, entry}] = out.value_or(PortState::Unknown);
  }

  void enter(const ir::Program& program, PortState state, SourceRange call) {
    if (state != PortState::Unknown && entered_.insert({&program, state}).second)
      open_.push_back({&program, state, call});
  }

  void judge(const Entry& entry) {
    const auto& body = entry.program->body;
    const auto before = states(*entry.program, entry.state, 0);
    bool printed = false; // one finding is enough
    for (std::size_t i = 0; i < body.size(); ++i) {
      if (!before[i] || *before[i] == PortState::Unknown) continue;
      const PortState state = *before[i];
      const auto* port = std::get_if<ir::Port>(&body[i].node);
      if (const ir::Program* own = ownOf(body[i])) enter(*own, state, body[i].origin.range());
      if (std::holds_alternative<ir::Print>(body[i].node) && state != PortState::Open && !printed) {
        printed = true;
        if (state == PortState::Closed)
          tell(body[i], kClosed, entry);
        else
          tell(body[i], kNobody, entry, Severity::Note);
      }
      if (!printed && state == PortState::Open && ir::endsProgram(body[i])) leftOpen(entry, i);
      if (printed || port == nullptr) continue;
      if (port->open && state == PortState::Open) tell(body[i], kOpenAlready, entry);
      if (!port->open && state == PortState::Closed) tell(body[i], kNotOpen, entry);
    }
  }

  // The program ends here with the port open.
  void leftOpen(const Entry& entry, std::size_t end) {
    const auto& body = entry.program->body;
    for (std::size_t i = end; i-- > 0;) {
      const auto* port = std::get_if<ir::Port>(&body[i].node);
      if (port == nullptr && (ownOf(body[i]) == nullptr || !opens(*ownOf(body[i])))) continue;
      if (port == nullptr || port->open) tell(body[i], kLeftOpen, entry, Severity::Warning, &body[end]);
      return;
    }
    tell(body[end], kLeftOpen, entry); // the caller has opened it
  }

  static bool opens(const ir::Program& program) {
    return std::any_of(program.body.begin(), program.body.end(), [](const ir::ProgramStatement& statement) {
      const auto* port = std::get_if<ir::Port>(&statement.node);
      return port != nullptr && port->open;
    });
  }

  void tell(const ir::ProgramStatement& statement, std::string_view text, const Entry& entry,
            Severity severity = Severity::Warning, const ir::ProgramStatement* end = nullptr) {
    const SourceRange range = statement.origin.range();
    if (!told_.insert({range.file, range.begin}).second) return;
    Diagnostic& one = report_.at(range, "{}", text);
    one.severity = severity;
    if (end != nullptr) one.note(end->origin.range(), "the program ends here with the port open");
    if (entry.call.hasPlace())
      one.note(entry.call, entry.state == PortState::Open ? "called here, with the port open"
                                                          : "called here, with the port closed");
  }

  const Project& project_;
  Report& report_;
  std::vector<const ir::Program*> all_;
  std::map<std::uint32_t, std::vector<const ir::Program*>> byNumber_;
  std::set<std::uint32_t> called_;
  std::map<Key, PortState> left_;
  std::set<Key> entered_;
  std::deque<Entry> open_;
  std::set<std::pair<FileId, std::uint32_t>> told_;
};

// Where no program opens, closes or prints there is nothing to find.
bool usesPort(const Project& project) {
  bool out = false;
  eachProgram(project, [&](const ir::Program& program, const macrob::File&) {
    out = out || std::any_of(program.body.begin(), program.body.end(), [](const ir::ProgramStatement& one) {
            return ir::match(
                one, [](const ir::OneOf<ir::Port, ir::Print> auto&) { return true; },
                [](const ir::OneOf<ir::NcBlock, ir::Store, ir::Comment, ir::Call, ir::Label, ir::Jump,
                                   ir::Branch, ir::JumpTo, ir::Loop, ir::LoopEnd, ir::Exit, ir::Raise,
                                   ir::Notice, ir::NameVariables> auto&) { return false; });
          });
  });
  return out;
}

void check(const Project& project, Report& report) {
  if (project.control != nullptr && project.control->functions.contains("print_without_port")) return;
  if (!usesPort(project)) return;
  Ports(project, report).check();
}

} // namespace

DOTEK_LINT_RULE(print_without_port){
    .severity = Severity::Warning,
    .tier = Tier::Ir,
    .check = check,
};

} // namespace dotek::lint::rule
