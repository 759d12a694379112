// convert --to gibbs.
#include "targets/Target.h"
#include "backends/fanuc/Emit.h"
#include "backends/gibbs/Emit.h"
#include "backends/gibbs/TargetFields.h"
#include "backends/gibbs/TargetVerify.h"
#include "ir/Fold.h"
#include "ir/ShareVariables.h"
#include "project/CycleCatalogue.h"
#include "support/messages/CamFolder.h"
#include "support/messages/Commands.h"
#include "support/messages/Cycle.h"
#include "support/messages/Fanuc.h"
#include "targets/Conversion.h"
#include "targets/KeptResults.h"
#include "targets/Reports.h"
#include "targets/Translation.h"

#include <algorithm>
#include <set>

namespace dotek::targets {

namespace gibbs = backends::gibbs;
namespace fanuc = backends::fanuc;

namespace {

// Targets of jumps: block numbers of a post are far below.
constexpr std::uint32_t kFirstNumber = 9001;

// A folder for GibbsCAM with the branch of the Prog, for each cycle of the command.
class GibbsConversion final : public Conversion {
public:
  using Conversion::Conversion;

  bool cycle(const CycleFolder& folder, std::size_t /*index*/) override {
    Diagnostics& diagnostics = session_.diagnostics();
    std::optional<LoweredSource> source = lowerSource(folder, context_);
    if (!source) return false;
    LoweredCycle& lowered = source->lowered;
    const std::string* const file = context_.compilation.fileOf(folder);
    if (file == nullptr && !options_.source.prog)
      diagnostics.report<diag::CamNoPost>(
          folder.place == kNoFile ? SourceRange{} : SourceRange{folder.place, 0, 0}, folder.name);
    const stdlib::MacroSet* macros =
        options_.probeMacros ? session_.macroSet(*options_.probeMacros, &*context_.inputs->control)
                             : lowered.macros;
    if (macros == nullptr)
      diagnostics.report<diag::MissingOption>({}, "convert", "--probe-macros SET",
                                              "the macros that the post calls");
    if (diagnostics.hasErrors()) return true;
    KeptResults results;
    if (file != nullptr) {
      results = keepResults(lowered.cycle, options_.results, diagnostics);
      for (const std::string& name : results.lost)
        diagnostics.report<diag::ResultNotLeft>(lowered.cycle.range, name);
    } else {
      for (const auto& [name, number] : options_.results)
        diagnostics.report<diag::CycleResultUnknown>({}, name, folder.name, "");
    }
    const std::set<ir::VariableId> without = leaveOut(lowered, diagnostics);
    if (const std::optional<SourceRange> report = dropReports(lowered.cycle))
      diagnostics.report<diag::CamReport>(*report);
    const ir::FoldOptions folding{true, session_.limits().steps};
    ir::fold(lowered.cycle, lowered.fixed, folding);
    dropAbsences(lowered);
    fixUnused(lowered, file == nullptr, folding, diagnostics);
    write(folder, lowered, *macros, without, results, file);
    return true;
  }

  // Of the last cycle: the fields that the dialog asks for, by the source's name.
  const std::map<std::string, gibbs::Field>& fields() const { return fields_; }

private:
  void write(const CycleFolder& folder, LoweredCycle& lowered, const stdlib::MacroSet& macros,
             const std::set<ir::VariableId>& without, const KeptResults& results, const std::string* file) {
    Diagnostics& diagnostics = session_.diagnostics();
    const LoweringInputs& inputs = *context_.inputs;
    ir::Cycle& cycle = lowered.cycle;
    gibbs::Names names(cycle, diagnostics);
    gibbs::Folder out = folderOf(folder, lowered, without, names, file, &macros == lowered.macros, session_);
    out.name = options_.source.cycle ? *options_.source.cycle
               : file != nullptr     ? fileStem(cycle.name)
                                     : folder.name;
    for (const auto& first : {inputs.control->variables.blockEnd, inputs.control->variables.position})
      if (first) out.places.push_back(static_cast<std::uint32_t>(*first));
    if (lowered.macros != nullptr) out.clearance = lowered.macros->probing.clearance;
    checkHosts(cycle, diagnostics);
    if (diagnostics.hasErrors()) return;

    stdlib::Control control = *inputs.control;
    if (control.bracketDepth > 1) --control.bracketDepth; // a field may need brackets of its own
    fanuc::EmitOptions emit{control, macros, *inputs.sourceControl, 0, {}, {}, {}, {}};
    emit.plainMessages = options_.common.assume.contains("plain-messages");
    emit.foreignMacros = &macros != lowered.macros;
    emit.source = lowered.macros;
    emit.branch.emplace();
    emit.branch->firstNumber = kFirstNumber;
    emit.branch->modes = file != nullptr;
    emit.branch->variables = freeVariables(control, results);
    for (const gibbs::Field& field : out.fields)
      emit.branch->holes.emplace(field.variable, gibbs::hole(field.name));
    for (ir::VariableId id = 0; id < cycle.variables.size(); ++id)
      if (cycle.variable(id).role == ir::Role::Host && cycle.variable(id).name == "clearance")
        emit.branch->holes.emplace(id, gibbs::clearanceHole());
    const auto blocks = branchOf(cycle, emit);
    const auto text = gibbs::emit(cycle, out, names, diagnostics);
    if (!blocks || !text) return;
    std::vector<gibbs::Block> printed;
    for (const fanuc::BranchBlocks::Line& line : blocks->lines)
      printed.push_back({line.out, line.numbered, line.comment});
    const bool feeds = std::any_of(blocks->lines.begin(), blocks->lines.end(),
                                   [](const auto& line) { return line.out.text.starts_with("G1 "); });
    // A cycle of the language leaves the modes as it finds them, and a post positions with G0.
    if (file != nullptr && feeds) printed.push_back({{"G0", {}, ""}, false, false});
    std::vector<std::string> remarks = results.headings;
    if (!blocks->variables.empty()) {
      const std::string range = rangeText(blocks->variables);
      remarks.push_back("It keeps values in " + range + ".");
      diagnostics.report<diag::CamVariables>({}, out.name, range);
    }
    auto branch = gibbs::progBranch(out, printed, control.decimals, remarks);
    if (!branch) {
      diagnostics.report<diag::CamHostUnknown>(cycle.range, "clearance", "in a computed place", "clearance");
      return;
    }
    for (const gibbs::Field& field : out.fields)
      if (field.asked) fields_[cycle.variable(field.variable).name] = field;
    ConversionResult& result = context_.result;
    result.macros = macros.name;
    result.add(out.name + "/DefineData.txt", text->define);
    result.add(out.name + "/CycleData.dlg", text->dialog);
    result.add(out.name + "/CycleData.mac", text->checks);
    result.add(out.name + "/ToolPath.mac", text->path);
    result.add(out.name + "/branch.txt", *branch);
  }

  // Names that are not needed at the same time share a variable where there are too few.
  std::optional<fanuc::BranchBlocks> branchOf(const ir::Cycle& cycle, const fanuc::EmitOptions& emit) {
    Diagnostics said;
    auto blocks = fanuc::emitBranch(cycle, emit, session_.sources(), said);
    const bool few = !blocks && std::any_of(said.all().begin(), said.all().end(), [](const Diagnostic& one) {
      return one.code == diag::TooManyLocals::code || one.code == diag::ExpressionDepth::code;
    });
    if (few) {
      ir::Cycle shared = cycle;
      ir::shareVariables(shared);
      said = Diagnostics();
      blocks = fanuc::emitBranch(shared, emit, session_.sources(), said);
    }
    for (Diagnostic& one : said.all())
      session_.diagnostics().add(std::move(one));
    return blocks;
  }

  static std::string rangeText(const std::vector<std::uint32_t>& numbers) {
    std::string out;
    for (std::size_t i = 0; i < numbers.size();) {
      std::size_t last = i;
      while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1)
        ++last;
      out += (out.empty() ? "#" : ", #") + std::to_string(numbers[i]);
      if (last > i) out += " to #" + std::to_string(numbers[last]);
      i = last + 1;
    }
    return out;
  }

  // Common variables that no macro of a vendor works in, and no result is left in.
  std::vector<std::uint32_t> freeVariables(const stdlib::Control& control, const KeptResults& results) const {
    std::vector<std::uint32_t> out;
    for (const stdlib::VariableRange& bank : control.common) {
      if (bank.kept) continue;
      for (std::uint32_t number = bank.first; number <= bank.last; ++number) {
        bool taken = results.numbers.contains(number);
        for (const stdlib::MacroSet& set : session_.macroSets(&control))
          for (const auto& [first, last] : set.scratch)
            taken = taken || (number >= first && number <= last);
        if (!taken) out.push_back(number);
      }
    }
    return out;
  }

  std::map<std::string, gibbs::Field> fields_;
};

constexpr TargetFlag kFlags[] = {TargetFlag::ProbeMacros, TargetFlag::Result};

} // namespace

std::optional<WrittenFolder> writtenFolder(const VerificationSource& source) {
  const ConvertOptions options = convertOptionsOf(source.options);
  ConversionContext context{options,
                            source.compilation,
                            source.session,
                            source.compilation.folders(),
                            source.compilation.usedSets(),
                            &source.inputs};
  GibbsConversion conversion(context);
  if (!conversion.beginCycles() || !conversion.cycle(source.folder, 0)) return std::nullopt;
  conversion.finish();
  if (context.result.files.empty() || source.session.diagnostics().hasErrors()) return std::nullopt;
  const std::string& first = context.result.files.front().name;
  WrittenFolder out{first.substr(0, first.find('/')), context.result.files, conversion.fields()};
  source.session.diagnostics() = Diagnostics();
  return out;
}

namespace target {

DOTEK_TARGET(gibbs) = {
    .text = "folder of a custom drill cycle of GibbsCAM, with the branch of its post",
    .flags = kFlags,
    .takesCycleFiles = true,
    .writesFolder = true,
    .convert = conversionBy<GibbsConversion>,
    .verify = folderVerification,
};

} // namespace target

} // namespace dotek::targets
