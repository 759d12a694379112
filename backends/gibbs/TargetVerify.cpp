// Cases of verify --to gibbs: the folder that was written runs as the CAM would run it. Its dialog takes or
// rejects the values, its branch prints a program, and that program is compared with what the source does.
#include "backends/gibbs/TargetVerify.h"

#include "backends/gibbs/Emit.h"
#include "backends/gibbs/TargetDialog.h"
#include "frontend/gibbs/Ast.h"
#include "frontend/gibbs/Cycle.h"
#include "project/CycleChecks.h"
#include "support/Decimal.h"
#include "support/Temporary.h"
#include "support/messages/Verify.h"
#include "targets/CycleCases.h"
#include "targets/DialogChoices.h"
#include "targets/OffParts.h"
#include "targets/ReadBack.h"
#include "targets/Stage.h"
#include "targets/Target.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace dotek::targets {

namespace fs = std::filesystem;

namespace {

constexpr double kSameValue = 1e-6;

// What a message of the dialog says, out of what Dotek says of it.
std::string_view messageIn(std::string_view rejection) {
  const std::size_t end = rejection.rfind('`');
  const std::size_t begin = end == 0 || end == std::string_view::npos ? end : rejection.rfind(": `", end - 1);
  return begin == std::string_view::npos || begin == end ? rejection
                                                         : rejection.substr(begin + 3, end - begin - 3);
}

// Of an alarm, which a control shows in capitals, cut and without marks.
std::string lettersOf(std::string_view text) {
  std::string out;
  for (const char c : text)
    if ((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'))
      out += c;
    else if (c >= 'a' && c <= 'z')
      out += static_cast<char>(c - 'a' + 'A');
  return out;
}

class FolderVerification final : public Verification {
public:
  explicit FolderVerification(const VerificationSource& source)
      : from_(source),
        sourceSet_(source.session.macroSet(source.plan.sourceMacros, &*source.inputs.sourceControl)),
        set_(source.session.macroSet(source.plan.targetMacros, &*source.inputs.control)) {}

  bool prepare() override {
    Session& session = from_.session;
    const auto written = writtenFolder(from_);
    if (!written) return false;
    fields_ = written->fields;
    fs::path folder;
    if (from_.options.translation) {
      // An edited one lies where its branch is.
      folder = fs::path(*from_.options.translation).parent_path();
      if (folder.empty()) folder = ".";
    } else {
      bool good = scratch_.create();
      for (const OutputFile& file : written->files)
        good = good && scratch_.write(file.name, file.text);
      folder = fs::path(scratch_.path()) / written->name;
      if (!good) {
        session.diagnostics().report<diag::TranslationNotRead>({}, written->name,
                                                               "no temporary folder can be written");
        return false;
      }
    }
    options_.common = from_.options.common;
    options_.common.job.reset();
    options_.common.set.clear();
    options_.common.field.clear();
    options_.common.projectField.clear();
    options_.common.host.clear();
    options_.common.assume.insert("probe-on");
    options_.common.from.reset();
    options_.inputs = {folder.string()};
    options_.source.prog = from_.options.translation
                               ? *from_.options.translation
                               : (folder / fs::path(written->files.back().name).filename()).string();
    options_.source.form =
        from_.inputs.form ? std::optional(from_.inputs.form->name) : from_.options.source.form;
    options_.source.cycle = written->name;
    options_.control = from_.inputs.control->name;
    plan_.sourceMacros = plan_.targetMacros = from_.plan.targetMacros;
    runner_ = std::make_unique<CaseRunner>(options_, plan_);
    if (runner_->load() && runner_->prepare()) {
      const ChoiceLists lists = from_.plan.cycleFile
                                    ? listsOfCycle(from_.options.inputs.front(), from_.options.common)
                                    : dialogChoices(from_.folder, session.sources());
      ofDialog_ = dialogDifferences(runner_->folder(), runner_->session().sources(), fields_, lists);
      return true;
    }
    session.diagnostics().report<diag::TranslationNotRead>({}, folder.string(),
                                                           firstError(runner_->session().diagnostics()));
    return false;
  }

  // A field of a dialog always has a value, and what no field asks for is left out always.
  Given given(const std::string& parameter) const override {
    return fields_.contains(parameter) ? Given::Always : Given::Never;
  }

  TargetRun run(const TargetCase& now) override {
    TargetRun out;
    verify::Case values = now.drawn;
    values.values.clear();
    for (const auto& [name, value] : now.drawn.values)
      if (const auto field = fields_.find(name); field != fields_.end())
        values.values[field->second.name] = value;
    for (const auto& [name, field] : fields_)
      if (const auto host = now.drawn.hosts.find(name);
          host != now.drawn.hosts.end() && !now.drawn.values.contains(name))
        values.values[field.name] = host->second;
    for (const char* host : {"retract", "clearance"})
      values.hosts.try_emplace(host, now.drawn.hosts.at("start_z"));
    const CaseRunner::Performed ran =
        runner_->perform(values, now.world, now.entry, now.stores, verify::Stand::Way::Run);
    if (runner_->stopped()) out.stopped = runner_->stopped()->why.message;
    if (!out.stopped.empty()) return out;
    if (now.rejected)
      compareRejection(ran, now, out);
    else if (ran.rejected && namesNoSystem(now.drawn)) {
      out.refused = true;
      out.why = ran.text;
    } else if (ran.rejected)
      out.differsAt(verify::Aspect::Ending,
                    fmt::format("the source takes the values, and the dialog that is written says `{}`",
                                messageIn(ran.text)),
                    0);
    else if (!ran.record)
      out.differsAt(verify::Aspect::Ending, "the branch that is written prints no program: " + ran.text, 0);
    else if (now.source != nullptr) {
      compareRecords(ran, now, out);
      if (now.questions != nullptr && out.differences.empty() &&
          now.source->ending == verify::Ending::Finished) {
        comparePath(values, now, out);
        if (out.differences.empty()) compareOff(values, now, out);
        compareFirstValues(out);
        for (const std::string& text : ofDialog_)
          out.differs(verify::Aspect::Variable, text);
      }
    }
    if (now.shown != nullptr && ran.record)
      *now.shown = {
          runner_->perform(values, now.world, now.entry, now.stores, verify::Stand::Way::KeepMoves).record,
          ""};
    return out;
  }

private:
  // The dialog that is written lets nothing but a work offset through, whatever the source does with it.
  bool namesNoSystem(const verify::Case& drawn) const {
    return std::any_of(from_.plan.fields.begin(), from_.plan.fields.end(), [&](const verify::DrawField& one) {
      const auto value = drawn.values.find(one.name);
      return one.kind == ir::Kind::WorkOffset && value != drawn.values.end() &&
             (one.systemOf(value->second) == 0 || value->second != std::floor(value->second));
    });
  }

  std::uint32_t lineOf(SourceRange posted, const CaseRunner::Performed& ran) const {
    const SourceRange printed = CaseRunner::progPlace(posted, ran.lines);
    return printed.hasPlace() ? runner_->session().sources().line(printed) : 0;
  }

  void compareRejection(const CaseRunner::Performed& ran, const TargetCase& now, TargetRun& out) const {
    const std::string_view wanted = from_.plan.cycleFile ? now.rejection : messageIn(now.rejection);
    if (ran.rejected) {
      const std::string_view own = messageIn(ran.text);
      Diagnostics ignored;
      out.refused = isWithoutMessage(wanted) || own == backends::gibbs::plain(wanted, {}, ignored);
      if (!out.refused)
        out.differsAt(
            verify::Aspect::Ending,
            fmt::format("the source rejects the values, `{}`, and the dialog that is written says `{}`",
                        wanted, own),
            0);
      return;
    }
    // What a list does not offer nobody chooses in the one that is written, either.
    if (!whyNotOffered(from_.plan.fields, now.drawn).empty()) {
      out.refused = true;
      return;
    }
    // What no dialog knows, such as the place of the probe, the branch asks before anything moves.
    if (ran.record && ran.record->ending == verify::Ending::Alarm && ran.record->pieces.empty() &&
        ran.record->measures.empty())
      out.refused = true;
    else
      out.differsAt(
          verify::Aspect::Ending,
          fmt::format("the source rejects the values, `{}`, and the dialog that is written takes them",
                      wanted),
          0);
  }

  // How far another set searches is its own business.
  void compareOff(const verify::Case& values, const TargetCase& now, TargetRun& out) {
    const bool same = sourceSet_ == set_ && !from_.plan.cycleFile;
    const auto run = [&](const verify::Record& meant, sim::World& world) {
      TargetRun off;
      TargetCase there{.drawn = now.drawn, .entry = now.entry, .stores = now.stores, .world = world};
      there.source = &meant;
      const CaseRunner::Performed ran =
          runner_->perform(values, world, now.entry, now.stores, verify::Stand::Way::Run);
      if (ran.record) compareRecords(ran, there, off);
      return off;
    };
    addOffParts(now, {same ? std::nullopt : std::optional(0.0), false, true}, run, out);
  }

  void compareRecords(const CaseRunner::Performed& ran, const TargetCase& now, TargetRun& out) const {
    const verify::Record& source = *now.source;
    verify::Record record = *ran.record;
    // What macros do inside is their own business.
    std::erase_if(record.early, [&](const verify::EarlyUse& use) { return lineOf(use.range, ran) == 0; });
    const stdlib::Control& control = *from_.inputs.control;
    verify::CompareRules rules = programRules(from_, control, sourceSet_, set_);
    // Fields are printed to the control's least increment.
    const double rounded = kRoundedWord * std::pow(10, -control.decimals);
    rules.results = std::max(rules.results, rounded);
    rules.tolerance = std::max(rules.tolerance, rounded);
    rules.relative = rules.results > from_.options.tolerance ? 2e-7 : 0;
    rules.mayRestoreModes = true;
    rules.switchesProbe = from_.options.switchProbe;
    rules.sameAlarmNumbers = rules.sameAlarmNumbers && !from_.plan.cycleFile;
    // An alarm of the branch before anything moves: it asks what no dialog knows.
    if (record.ending == verify::Ending::Alarm && record.pieces.empty() && record.measures.empty() &&
        source.ending != verify::Ending::Alarm) {
      out.refused = true;
      out.why = record.text;
      return;
    }
    const bool own = source.ending == verify::Ending::Alarm && source.alarmKind.empty() &&
                     record.ending == verify::Ending::Alarm && record.alarmKind.empty();
    if (own && !lettersOf(source.text).starts_with(lettersOf(record.text)))
      out.differsAt(verify::Aspect::Ending,
                    fmt::format("an alarm (`{}`) against `{}`", source.text, record.text),
                    lineOf(record.endedAt, ran));
    const bool searches = source.ending == verify::Ending::Alarm &&
                          source.alarmKind == stdlib::macroAlarmName(stdlib::MacroAlarm::ProbeFail);
    if ((sourceSet_ != set_ || from_.plan.cycleFile) && searches && verify::findsAll(record)) {
      out.undecided = true;
      return;
    }
    for (verify::Difference& one : verify::compare(source, record, rules)) {
      const std::uint32_t line = lineOf(one.target, ran);
      out.differences.push_back({std::move(one), line, ""});
    }
  }

  // What the CAM shows is what the branch does. Words of the branch are rounded.
  void comparePath(const verify::Case& values, const TargetCase& now, TargetRun& out) const {
    const double rounded = kRoundedWord * std::pow(10, -from_.inputs.control->decimals);
    for (verify::Difference& one :
         runner_->drawnBeside(values, now.entry, std::max(rounded, from_.options.tolerance))) {
      const SourceRange drawn = one.source;
      const std::string line =
          drawn.hasPlace() ? fmt::format(", line {}", runner_->session().sources().line(drawn)) : "";
      one.text = fmt::format("ToolPath.mac{} draws something else than the branch does: {}", line, one.text);
      one.source = {};
      out.differences.push_back({std::move(one), 0, ""});
    }
  }

  // What the dialog begins with.
  void compareFirstValues(TargetRun& out) const {
    const std::vector<frontend::gibbs::Field> declared =
        frontend::gibbs::declaredFields(*runner_->folder().cycle);
    for (const verify::DrawField& field : from_.plan.fields) {
      const auto name = fields_.find(field.name);
      std::optional<double> first = field.initial;
      for (const auto& [given, text] : from_.options.defaults)
        if (frontend::gibbs::foldCase(given) == frontend::gibbs::foldCase(field.name))
          first = parseNumber(text);
      if (name == fields_.end() || !first || field.fixed) continue;
      const auto found = std::find_if(declared.begin(), declared.end(), [&](const auto& one) {
        return frontend::gibbs::foldCase(one.name.text) == frontend::gibbs::foldCase(name->second.name);
      });
      if (found != declared.end() && found->value && std::abs(*found->value - *first) <= kSameValue) continue;
      const bool stated = found != declared.end() && found->value;
      out.differs(
          verify::Aspect::Variable,
          fmt::format(
              "DefineData.txt{} gives {} the first value {} against {}, that of the source",
              stated ? fmt::format(", line {}", runner_->session().sources().line(found->name.range)) : "",
              name->second.name, stated ? numberText(*found->value) : "of no number", numberText(*first)));
    }
  }

  const VerificationSource from_;
  const stdlib::MacroSet *sourceSet_, *set_;
  TemporaryFolder scratch_;
  VerifyOptions options_; // of the written folder
  VerifyPlan plan_;
  std::map<std::string, backends::gibbs::Field> fields_; // of the written folder, by the source's name
  std::vector<std::string> ofDialog_;                    // differences
  std::unique_ptr<CaseRunner> runner_;
};

} // namespace

std::unique_ptr<Verification> folderVerification(const VerificationSource& source) {
  return std::make_unique<FolderVerification>(source);
}

} // namespace dotek::targets
