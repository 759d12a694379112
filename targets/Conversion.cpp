#include "targets/Conversion.h"

#include "project/CycleFiles.h"
#include "project/CycleValues.h"
#include "project/Values.h"
#include "stdlib/CodeSpan.h"
#include "support/Decimal.h"
#include "support/messages/Commands.h"
#include "support/messages/Fanuc.h"
#include "support/messages/Sim.h"

#include <algorithm>
#include <utility>

namespace dotek::targets {

namespace {

// Names of the given options that speak of cycles.
std::vector<std::string> cycleOptions(const ConvertOptions& options) {
  const CommonOptions& common = options.common;
  std::vector<std::string> out;
  const auto add = [&](bool given, const char* name) {
    if (given) out.emplace_back(name);
  };
  add(common.job.has_value(), "--job");
  add(!common.set.empty(), "--set");
  add(!common.field.empty(), "--field");
  add(!common.host.empty(), "--host");
  add(common.recover, "--recover");
  add(options.source.prog.has_value(), "--prog");
  add(options.source.form.has_value(), "--form");
  add(options.source.routine.has_value(), "--routine");
  add(options.source.cycle.has_value(), "--cycle");
  add(!options.letters.empty(), "--arg");
  add(!options.defaults.empty(), "--default");
  add(options.useDefaults, "--defaults");
  add(options.switchProbe, "--probe-power");
  add(!options.results.empty(), "--result");
  add(options.calls != Calls::Inline, "--calls");
  for (const std::string& name : common.assume)
    // The run of --verify takes it for the source; codes that do nothing are those of the controls.
    if (name != "plain-messages" && !(name == "probe-on" && options.verify) &&
        stdlib::auxiliaryCodes({name}).empty())
      out.push_back("--assume " + name);
  return out;
}

} // namespace

void readLetters(ConversionContext& context) {
  Diagnostics& diagnostics = context.session.diagnostics();
  for (const auto& [name, text] : context.options.letters) {
    if (text.size() != 1)
      diagnostics.report<diag::LetterNotAllowed>({}, name, text);
    else if (!context.letters.emplace(name, text[0]).second)
      diagnostics.report<diag::GivenTwice>({}, "--arg", name);
  }
}

void refuseOptions(const ConvertOptions& options, bool programs, bool cycles, Diagnostics& diagnostics) {
  if (programs && !cycles)
    for (const std::string& name : cycleOptions(options))
      diagnostics.report<diag::OptionOfCycles>({}, name);
  if (cycles && !programs) {
    if (!options.fromControl.empty()) diagnostics.report<diag::OptionOfPrograms>({}, "--from-control");
    if (options.renumber) diagnostics.report<diag::OptionOfPrograms>({}, "--renumber");
    if (!options.variables.empty()) diagnostics.report<diag::OptionOfPrograms>({}, "--var");
  }
}

namespace {

// Literals of the cycle language as numbers: `18mm`, `G54`. Values that are none are reported.
dotek::project::NamedTexts defaultsAsNumbers(const std::string& path, ConversionContext& context) {
  dotek::project::NamedTexts out = context.options.defaults;
  Session& session = context.session;
  if (std::all_of(out.begin(), out.end(),
                  [](const auto& one) { return parseNumber(one.second).has_value(); }))
    return out;
  Diagnostics said = std::exchange(session.diagnostics(), Diagnostics());
  dotek::project::CycleFiles files(session);
  const auto* const tree = files.linked(path); // it has been lowered
  session.diagnostics() = std::move(said);
  if (tree == nullptr) return out;
  std::erase_if(out, [&](auto& one) {
    auto& [name, text] = one;
    if (parseNumber(text)) return false;
    Diagnostics found;
    const auto values = dotek::project::cycleValues(*tree, {{name, text}}, found);
    if (const auto value = values.find(name); value != values.end()) {
      text = numberText(value->second);
      return false;
    }
    bool wrong = false; // else the cycle has no such parameter, which is reported by name
    for (Diagnostic& d : found.all()) {
      if (d.code != diag::ParameterValue::code) continue;
      wrong = true;
      context.usedDefaults.insert(name);
      if (const std::size_t flag = d.message.find("--set"); flag != std::string::npos)
        d.message.replace(flag, 5, "--default");
      session.diagnostics().add(std::move(d));
    }
    return wrong;
  });
  return out;
}

} // namespace

std::optional<LoweredSource> lowerSource(const CycleFolder& folder, ConversionContext& context) {
  Session& session = context.session;
  std::optional<LoweredCycle> lowered = context.compilation.lower(folder);
  if (!lowered) return std::nullopt;
  LoweredSource out{std::move(*lowered), {}};
  if (const std::string* const file = context.compilation.fileOf(folder)) {
    applyDefaults(defaultsAsNumbers(*file, context), out.lowered, context.usedDefaults, session);
    return out;
  }
  ir::Cycle& cycle = out.lowered.cycle;
  cycle.name = folder.name;
  applyDefaults(context.options.defaults, out.lowered, context.usedDefaults, session);
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id)
    if (const auto value = cycle.variable(id).defaultValue) out.defaults.emplace(id, *value);
  settleValues(folder, out.lowered, session);
  return out;
}

} // namespace dotek::targets
