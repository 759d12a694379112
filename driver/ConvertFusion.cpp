#include "driver/ConvertFusion.h"

#include "frontend/gibbs/Ast.h"
#include "ir/Fold.h"
#include "support/messages/Commands.h"
#include "support/messages/Fusion.h"
#include "support/messages/Nc.h"

#include <algorithm>

namespace dotek::driver {

namespace fusion = backends::fusion;
namespace gibbs = frontend::gibbs;

namespace {

std::optional<double> numberOf(const gibbs::Expression& expression) {
  const auto* unary = std::get_if<gibbs::Unary>(&expression.node);
  const auto* number =
      std::get_if<gibbs::NumberLiteral>(unary != nullptr ? &unary->operand->node : &expression.node);
  if (number == nullptr) return std::nullopt;
  const bool minus = unary != nullptr && unary->op == gibbs::UnaryOperator::Minus;
  return minus && number->value != 0 ? -number->value : number->value;
}

// What the dialog offers for its fields: both states of a check box, the entries of a list.
std::map<ir::VariableId, std::vector<fusion::Choice>>
choicesOf(const CycleFolder& folder, const ir::Cycle& cycle, const SourceMap& sources) {
  std::map<ir::VariableId, std::vector<fusion::Choice>> out;
  if (!folder.cycle->dialog) return out;
  const Encoding encoding = sources.file(folder.cycle->dialog->file).encoding();
  std::map<std::string, ir::VariableId> ids;
  for (ir::VariableId id = 0; id < cycle.variables.size(); ++id)
    if (cycle.variable(id).role == ir::Role::Parameter)
      ids.emplace(gibbs::foldCase(cycle.variable(id).name), id);
  std::vector<std::optional<ir::VariableId>> lists; // in the order of creation, which is their number
  for (const gibbs::Control& control : folder.cycle->dialog->controls) {
    const std::string kind = gibbs::foldCase(control.kind.text);
    const auto found = control.variable ? ids.find(gibbs::foldCase(control.variable->text)) : ids.end();
    if (kind == gibbs::foldCase("CHECK") && found != ids.end()) out[found->second] = {{0, "no"}, {1, "yes"}};
    if (kind == gibbs::foldCase("DROPDOWN_NEW"))
      lists.push_back(found == ids.end() ? std::nullopt : std::optional(found->second));
    if (kind != gibbs::foldCase("DROPDOWN_ADD") || control.arguments.size() != 3) continue;
    const auto list = numberOf(*control.arguments[0]);
    const auto value = numberOf(*control.arguments[2]);
    const auto* text = std::get_if<gibbs::TextLiteral>(&control.arguments[1]->node);
    if (!list || !value || text == nullptr || *list < 1 || *list > static_cast<double>(lists.size()))
      continue;
    if (const auto id = lists[static_cast<std::size_t>(*list) - 1])
      out[*id].push_back({*value, toUtf8(text->text, encoding)});
  }
  return out;
}

// Notes on what a program on a control changes; a post prints the Prog's text as it is.
void dropNotesOfPrograms(Diagnostics& diagnostics) {
  auto& all = diagnostics.all();
  std::erase_if(all, [](const Diagnostic& one) {
    return one.code == diag::PictureDecimals::code || one.code == diag::AlarmRenumbered::code ||
           one.code == diag::WordLeftOut::code;
  });
}

} // namespace

void FusionParts::checkOptions(const ConvertOptions& options, Diagnostics& diagnostics) {
  if (!options.letters.empty()) diagnostics.report<diag::FanucOption>({}, "--arg");
  if (options.programNumber) diagnostics.report<diag::FanucOption>({}, "--program-number");
  if (options.useDefaults) diagnostics.report<diag::FanucOption>({}, "--defaults use");
  if (options.switchProbe) diagnostics.report<diag::FanucOption>({}, "--probe-power macro");
  if (!options.source.prog) diagnostics.report<diag::FusionNeedsProg>({});
}

void FusionParts::add(const CycleFolder& folder, LoweredCycle& lowered,
                      std::map<ir::VariableId, double> defaults) {
  const std::string& control = inputs_.sourceControl->name;
  if (!options_.control.empty() && options_.control != control)
    session_.diagnostics().report<diag::ControlOfForm>(lowered.cycle.range, control, options_.control);
  const stdlib::MacroSet none = [] {
    stdlib::MacroSet set;
    set.title = "no set";
    return set;
  }();
  const stdlib::MacroSet* macros =
      options_.probeMacros ? inputs_.macroSet(*options_.probeMacros) : lowered.macros;
  const bool foreign = macros != lowered.macros && lowered.macros != nullptr;
  if (macros == nullptr) macros = &none;
  ir::fold(lowered.cycle, lowered.fixed);
  fusion::EmitOptions emit{*inputs_.sourceControl,
                           *macros,
                           foreign,
                           std::move(lowered.printed),
                           lowered.fixed,
                           lowered.fixedByName,
                           {},
                           std::move(defaults)};
  emit.choices = choicesOf(folder, lowered.cycle, session_.sources());
  emit.fixedByName.insert(inputs_.hosts.begin(), inputs_.hosts.end());
  const std::string prefix = fusion::prefixOf(lowered.cycle.name);
  for (const Part& part : parts_)
    if (part.prefix == prefix)
      session_.diagnostics().report<diag::FragmentNameTwice>({}, part.cycle, lowered.cycle.name, prefix);
  auto lines = fusion::emit(lowered.cycle, emit, session_.diagnostics());
  if (options_.probeMacros && !foreign) dropNotesOfPrograms(session_.diagnostics());
  if (lines) parts_.push_back({lowered.cycle.name, prefix, std::move(*lines)});
}

void FusionParts::finish(std::vector<OutputFile>& files, std::vector<MappedResult>& maps) const {
  const auto write = [&](const std::string& name, const std::vector<fusion::EmittedLine>& lines) {
    OutputFile file{name, ""};
    MappedResult map{name, {}};
    for (const fusion::EmittedLine& line : lines) {
      file.text += line.text + "\n";
      std::vector<SourceRange> ranges = line.ranges;
      std::erase_if(ranges, [](const SourceRange& range) { return !range.hasPlace(); });
      map.lines.push_back({static_cast<std::uint32_t>(map.lines.size() + 1), std::move(ranges), line.reason});
    }
    files.push_back(std::move(file));
    maps.push_back(std::move(map));
  };
  if (!options_.probeMacros) dropNotesOfPrograms(session_.diagnostics());
  // An alarm is printed with its number, whatever the macros are.
  std::erase_if(session_.diagnostics().all(),
                [](const Diagnostic& one) { return one.code == diag::AlarmRenumbered::code; });
  if (parts_.empty()) return;
  if (!options_.wholePost) {
    for (const Part& part : parts_)
      write(part.prefix + ".js", part.lines);
    return;
  }
  std::vector<std::vector<fusion::EmittedLine>> fragments;
  std::vector<std::string> prefixes;
  for (const Part& part : parts_) {
    fragments.push_back(part.lines);
    prefixes.push_back(part.prefix);
  }
  write((parts_.size() == 1 ? parts_.front().prefix : std::string("cycles")) + ".cps",
        fusion::postAround(fragments, prefixes));
}

} // namespace dotek::driver
