#include "backends/fanuc/State.h"
#include "support/messages/Fanuc.h"

#include <algorithm>

namespace dotek::backends::fanuc {

namespace {

// Locals that argument specification I reaches (Fanuc: #10, #12, #14 to #16 and #27 on have no letter).
bool hasLetter(std::uint32_t local) {
  return local <= 9 || local == 11 || local == 13 || (local >= 17 && local <= 26);
}

} // namespace

Locals::Locals(std::uint32_t count, const std::vector<Argument>& arguments) {
  for (const bool letters : {true, false})
    for (std::uint32_t local = 1; local <= count; ++local) {
      const bool taken = std::any_of(arguments.begin(), arguments.end(),
                                     [&](const Argument& a) { return a.local == local; });
      if (hasLetter(local) == letters && !taken) free_.push_back(local);
    }
}

std::uint32_t Locals::take() {
  if (free_.empty()) return 0;
  const std::uint32_t local = free_.back();
  free_.pop_back();
  return local;
}

State::State(const ir::Cycle& given, const EmitOptions& emitOptions, const SourceMap& sourceMap,
             Diagnostics& report, std::vector<Argument> letters)
    : cycle(given), options(emitOptions), control(emitOptions.control), macros(emitOptions.macros),
      sources(sourceMap), diagnostics(report), arguments(std::move(letters)),
      pool(emitOptions.branch ? Locals(emitOptions.branch->variables)
                              : Locals(emitOptions.control.locals, arguments)) {
  for (const Argument& argument : arguments)
    locals[argument.variable] = argument.local;
}

std::string State::local(ir::VariableId id) {
  if (options.branch)
    if (const auto hole = options.branch->holes.find(id); hole != options.branch->holes.end())
      return hole->second;
  auto found = locals.find(id);
  if (found == locals.end()) {
    const std::uint32_t taken = pool.take();
    if (taken == 0)
      refuse<diag::TooManyLocals>(cycle.range, cycle.variable(id).name,
                                  options.branch ? options.branch->variables.size() : control.locals);
    found = locals.emplace(id, taken).first;
  }
  return "#" + std::to_string(found->second);
}

std::uint32_t State::helper() {
  std::uint32_t taken = 0;
  if (freeHelpers.empty()) {
    taken = pool.take();
  } else {
    taken = freeHelpers.back();
    freeHelpers.pop_back();
  }
  if (taken != 0) helpers.push_back(taken);
  return taken;
}

void State::releaseHelpers() {
  // Not back to the pool: a loop may run this statement again while another value is there. The first
  // taken is the next taken.
  for (; !helpers.empty(); helpers.pop_back())
    freeHelpers.push_back(helpers.back());
}

std::optional<ir::VariableId> State::findHost(std::string_view name) const {
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id)
    if (cycle.variable(id).role == ir::Role::Host && cycle.variable(id).name == name) return id;
  return std::nullopt;
}

ir::VariableId State::host(std::string_view name) {
  if (const auto found = findHost(name)) return *found;
  ir::Variable added;
  added.name = std::string(name);
  added.kind = ir::Kind::Length;
  added.role = ir::Role::Host;
  return cycle.add(std::move(added));
}

ir::ExpressionPtr State::start(ir::Axis axis) {
  const std::string name = std::string("start_") + static_cast<char>(ir::letterOf(axis) - 'A' + 'a');
  if (const auto fixed = options.fixed.find(name); fixed != options.fixed.end())
    return ir::constant(fixed->second);
  const ir::VariableId id = host(name);
  if (!control.variables.blockEnd && !isArgument(id))
    refuse<diag::StartUnknown>(cycle.range, std::string(1, ir::letterOf(axis)));
  return ir::variable(id);
}

bool State::isArgument(ir::VariableId id) const {
  return std::any_of(arguments.begin(), arguments.end(), [&](const Argument& a) { return a.variable == id; });
}

std::string codeText(const stdlib::CodeInfo& code) {
  std::string out(1, code.letter);
  out += std::to_string(code.tenths / 10);
  if (code.tenths % 10 != 0) out += "." + std::to_string(code.tenths % 10);
  return out;
}

} // namespace dotek::backends::fanuc
