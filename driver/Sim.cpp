#include "support/messages/Sim.h"
#include "driver/Command.h"
#include "driver/Driver.h"
#include "driver/SimCycle.h"
#include "driver/SimDevice.h"
#include "driver/SimMikroprog.h"
#include "driver/WatchedRun.h"
#include "frontend/macrob/Check.h"
#include "frontend/nc/Scan.h"
#include "project/Inputs.h"
#include "project/Job.h"
#include "project/Lowering.h"
#include "project/ProgramLibrary.h"
#include "project/SufProgram.h"
#include "project/VariableFlags.h"
#include "sim/device/Device.h"
#include "sim/device/DeviceReport.h"
#include "sim/geometry/PartFile.h"
#include "sim/machine/Arguments.h"
#include "sim/machine/Compile.h"
#include "sim/machine/EndText.h"
#include "sim/machine/Machine.h"
#include "sim/machine/Refusals.h"
#include "sim/machine/Run.h"
#include "sim/machine/SafeMoves.h"
#include "sim/machine/Value.h"
#include "sim/mikroprog/Dialect.h"
#include "sim/run/Advice.h"
#include "sim/run/SetupRun.h"
#include "sim/run/SimMacros.h"
#include "sim/run/SimReport.h"
#include "sim/run/SimWorld.h"
#include "stdlib/Control.h"
#include "stdlib/Lathe.h"
#include "support/Ascii.h"
#include "support/Decimal.h"
#include "support/Files.h"
#include "support/LineChunks.h"
#include "support/WholeName.h"
#include "support/messages/Commands.h"
#include "support/messages/Common.h"
#include "support/messages/Device.h"

#include <set>
#include <span>
#include <utility>

namespace dotek::driver {
namespace {

constexpr std::string_view kFirstControl = "fanuc-0i-md";

std::string endingText(const sim::RunEnd& end) {
  switch (end.ending) {
  case sim::Ending::ProgramEnd:
  case sim::Ending::TextEnd: return "to the end of the program";
  case sim::Ending::Alarm: return fmt::format("{} in line {}: {}", sim::alarmName(end), end.line, end.text);
  case sim::Ending::Limit: return fmt::format("ended at a limit of Dotek: {}", end.text);
  default: return fmt::format("inconclusive in line {}: {}", end.line, end.text);
  }
}

bool holdsNoBlock(LineChunks& chunks) {
  frontend::nc::Scanner scanner(chunks);
  ir::NcWords words;
  using Result = frontend::nc::Scanner::Result;
  Result result = Result::Block;
  while ((result = scanner.next(words)) == Result::Block)
    if (words.present != 0 || words.marks != ir::NcWords::ProgramMark) return false;
  return result == Result::End;
}

class SimCommand {
public:
  SimCommand(const SimOptions& options, const sim::DeviceOptions& device, Session& session,
             WatchedRun* watched = nullptr)
      : options_(options), device_(device), session_(session), watched_(watched) {}

  Outcome run() {
    if (options_.program.empty())
      diagnostics().report<diag::MissingOption>({}, command(), "PROGRAM", "an NC program");
    else if (const auto kind = kindAmong(options_.program, {InputKind::Nc, InputKind::Suf, InputKind::Cycle},
                                         "an NC program", session_);
             kind == InputKind::Cycle)
      return device_.device || device_.report || options_.stock ? refuseCycle()
                                                                : simCycle(options_, session_);
    else if (kind == InputKind::Suf)
      return runSuf();
    if (stdlib::datumOf(options_.setup)) {
      diagnostics().report<diag::SetupFlag>({}, "--datum",
                                            "it is for programs of Mikroprog; `--work-offset G54=X,Y,Z` sets "
                                            "a work system");
      return outcomeOf(session_, "");
    }
    if (!options_.common.set.empty()) diagnostics().report<diag::OptionOfCycles>({}, "--set");
    if (!options_.common.host.empty()) diagnostics().report<diag::OptionOfCycles>({}, "--host");
    if (diagnostics().hasErrors()) return outcomeOf(session_, "");
    std::string control = options_.control;
    const Settings settings = settingsOf(options_.program, session_);
    if (control.empty()) control = settings.control;
    if (options_.common.job)
      static_cast<void>(project::loadJob(*options_.common.job, session_)); // its probe codes
    session_.takeProbeCodes(settings.probe);
    if (diagnostics().hasErrors()) return outcomeOf(session_, "");
    if (options_.probeMacros && session_.macroSet(*options_.probeMacros) == nullptr)
      reportUnknownMacroSet(*options_.probeMacros, session_);
    control_ = loadControl(control.empty() ? std::string(kFirstControl) : control, session_);
    if (control_) checkProbeCodes(*control_, session_);
    if (diagnostics().hasErrors()) return outcomeOf(session_, "");
    world_ = sim::SimWorld::load(options_, session_, command());
    if (!world_ || !loadDevice()) return outcomeOf(session_, "");
    shown_ = project::shownVariablesOf(options_.shown, *control_, diagnostics());
    if (!shown_.empty()) world_->keepOffsets();
    // What cannot be read twice, a pipe, is kept, and what an editor holds; so its size is bounded.
    std::optional<std::string> kept;
    const auto& held = options_.common.buffers;
    if (isStream(options_.program) || (held && held->contains(wholeName(options_.program))))
      kept = session_.bytes(options_.program, diagnostics());
    std::unique_ptr<LineChunks> chunks =
        kept ? std::make_unique<LineChunks>(*kept) : LineChunks::open(options_.program, diagnostics());
    if (!chunks || diagnostics().hasErrors()) return outcomeOf(session_, "");
    sim::Machine machine(*control_);
    // Flags that set a variable go before what the setup says of it, and it may ask for one of them.
    if (!setVariables(machine) || !world_->prepare(machine) || !setVariables(machine) ||
        !world_->startsWithinTravel(machine))
      return outcomeOf(session_, "");
    if (watched_ != nullptr || !options_.programs.empty() || running_ || !world_->setup().call.empty() ||
        control_->turning || frontend::nc::mayHoldMacros(*chunks))
      return runLoaded(kept, machine);
    chunks->rewind();
    // What has no block at all is read as a text: it may hold no program.
    if (holdsNoBlock(*chunks)) return runLoaded(kept, machine);
    chunks->rewind();
    const std::string lathe = latheOf(*chunks);
    chunks->rewind();
    return runStreamed(*chunks, machine, lathe);
  }

private:
  Diagnostics& diagnostics() { return session_.diagnostics(); }
  std::string_view command() const { return watched_ == nullptr ? "sim" : watched_->command(); }

  Outcome refuseCycle() {
    if (options_.stock)
      diagnostics().report<diag::OptionOfPrograms>({}, "--stock");
    else
      diagnostics().report<diag::OptionOfMacroB>({}, device_.device ? "--device" : "--report");
    return outcomeOf(session_, "");
  }

  // The device of --device, and what it adds to the control. false: reported.
  bool loadDevice() {
    if (device_.report && !device_.device)
      diagnostics().report<diag::NoDevice>({}, "--report",
                                           "whose run it shows; a run of the probe is shown by `--svg OUT` "
                                           "(to print) and `--html OUT`");
    if (!device_.device) return !diagnostics().hasErrors();
    deviceFile_ =
        sim::loadDevice(*device_.device, session_.limits(), session_.bounds(sim::folderOf(*device_.device)),
                        session_.sources(), diagnostics());
    if (!deviceFile_) return false;
    deviceFile_->extend(*control_);
    if (deviceFile_->usesWindow() && !control_->window) {
      diagnostics().report<diag::DeviceNeedsWindow>({}, control_->name);
      return false;
    }
    world_->setDevice(&running_.emplace(*deviceFile_, *control_));
    return true;
  }

  static std::string placeOf(SourceRange range, const SourceMap& sources) {
    if (!range.hasPlace()) return "";
    return fmt::format("`{}` line {}: ", sources.file(range.file).name(), sources.line(range));
  }

  void addReport(const sim::Machine& machine, Outcome& out) const {
    if (!device_.report || !running_) return;
    sim::DeviceReportHead head;
    head.program = options_.program;
    head.control = control_->title.empty() ? control_->name : control_->title;
    head.device = *device_.device;
    head.ending = endingText(machine.end());
    head.complete =
        machine.end().ending == sim::Ending::ProgramEnd || machine.end().ending == sim::Ending::TextEnd;
    head.date = options_.date;
    for (const Diagnostic& one : out.diagnostics.all())
      if (one.severity != Severity::Note)
        head.findings.push_back(fmt::format("{}{}: {} [{}]", placeOf(one.range, out.sources),
                                            severityName(one.severity), one.message, one.code));
    std::string picture = sim::devicePicture(*running_);
    if (!picture.empty()) head.picture = device_.picture;
    out.files.push_back({"report", sim::deviceReport(head, *running_, machine)});
    if (!head.picture.empty()) out.files.push_back({"report-picture", std::move(picture)});
  }

  Outcome finish(sim::Machine& machine, const sim::Run* run) {
    addShown(machine);
    if (!machine.dialect().firstParameter) sim::addLists(machine, run, shown_.empty(), *world_);
    world_->reportRest();
    Outcome out = outcomeOf(session_,
                            options_.json    ? sim::summary(machine, run, *world_, session_)
                            : options_.trace ? world_->measuredTable()
                                             : "",
                            true);
    out.files = world_->pictures();
    addReport(machine, out);
    return out;
  }

  // The variables of --show, as the run has left them: a row of the table.
  void addShown(const sim::Machine& machine) {
    if (shown_.empty()) return;
    // Whether a variable holds a length is not known.
    const bool inches = machine.mode(sim::kUnits) != 0;
    sim::Measurement found{
        0, inches ? "results as the program has them, a length in inches (G20)" : "results", {}};
    for (const project::ShownVariable& one : shown_)
      found.values.push_back({fmt::format("{} (#{})", one.name, one.number), one.nominal,
                              machine.common(one.number), ir::Kind::Number});
    world_->addFound(found);
  }

  bool setVariables(sim::Machine& machine) {
    for (const auto& [number, value] : variablesOf(options_.variables, diagnostics())) {
      if (machine.preset(number, value)) continue;
      diagnostics().report<diag::VariableFlag>(
          {}, fmt::format("{}={}", number, numberText(value)),
          fmt::format("`{}` has no such variable that a program could set", control_->name));
      return false;
    }
    return !diagnostics().hasErrors();
  }

  // A program with macro statements, calls or jumps: it and all that it may call are kept.
  Outcome runLoaded(std::optional<std::string>& kept, sim::Machine& machine) {
    const std::optional<FileId> id =
        kept ? addText(inputName(options_.program), std::move(*kept), Encoding::Cp1250,
                       session_.options().encoding, session_.sources(), diagnostics())
             : session_.read(options_.program, Encoding::Cp1250);
    if (!id || !sim::isCall(world_->setup(), diagnostics())) return outcomeOf(session_, "");
    std::optional<ProgramLibrary> library =
        world_->setup().call.empty()
            ? ProgramLibrary::load(*id, options_.programs, *control_, session_)
            : ProgramLibrary::loadCalled(
                  *id,
                  [&](std::uint64_t number) {
                    return sim::callingProgram(world_->setup(), number, machine, world_->startOf(machine));
                  },
                  options_.programs, *control_, session_);
    if (!library) return outcomeOf(session_, "");
    const std::unique_ptr<sim::SimMacros> macros =
        sim::SimMacros::load(options_.probeMacros, world_->hasPicture(), *control_, *library, session_);
    if (!macros) return outcomeOf(session_, "");
    if (const auto radius = world_->calibratedRadius()) macros->setStylusRadius(*radius);
    world_->setCallKind([&macros](std::uint32_t program, std::span<const double> locals) {
      return macros->kindOf(program, locals);
    });
    world_->setReader([&](std::uint32_t program, std::span<const double> locals) {
      return macros->foundBy(program, locals, machine);
    });
    notePoints(library->programs());
    unreadable_ = library->unreadable();
    safe_ = sim::safeMoves(library->programs(), *control_);
    asking_ = sim::askingBlocks(library->programs());
    unset_ = sim::neverSet(library->programs());
    if (sim::mayWriteOffsets(library->programs(), *control_)) world_->keepOffsets();
    const std::string advice = world_->setup().call.empty()
                                   ? sim::callAdvice(*library->programs().front(), options_.part.has_value())
                                   : "";
    sim::MacroMeaning* meaning = macros.get();
    if (running_) {
      running_->setNext(meaning);
      meaning = &*running_;
    }
    if (watched_ != nullptr) watched_->read(*control_, library->programs(), *id);
    const std::size_t made = world_->setup().call.empty() ? 0 : 1;
    return runCode(sim::compile(library->programs(), *control_, session_.sources(), made), machine, meaning,
                   advice);
  }

  // Once: a length without a point is a thousandth of what it looks like, and the run follows it.
  void notePoints(const std::vector<const ir::Program*>& programs) {
    std::size_t more = 0;
    SourceRange first;
    for (const ir::Program* program : programs)
      for (const ir::ProgramStatement& statement : program->body) {
        const auto* block = std::get_if<ir::NcBlock>(&statement.node);
        if (block == nullptr) continue;
        for (const ir::Word& word : block->words) {
          if (!control_->isLength(word.address) || !control_->countsIncrements(word.address)) continue;
          const ir::Constant* bare = ir::numberWithoutPoint(word.value);
          if (bare == nullptr || bare->value == 0) continue;
          if (first.hasPlace())
            ++more;
          else
            first = statement.origin.range();
        }
      }
    if (!first.hasPlace()) return;
    const auto& check = frontend::macrob::wordWithoutPointCheck;
    Report report(check.code, Severity::Note, diagnostics());
    report.at(
        first,
        "a length here has no point, and `{}` counts least increments: `X10` is {} mm; so it is with {} "
        "more in the programs",
        control_->name, fixedText(10 * control_->increment, control_->decimals), more);
  }

  void noSetup(const std::string& what) {
    diagnostics().report<diag::OptionOfMacroB>({}, what).note(
        {},
        "`--datum`, or `datum` of [setup], says where the zero of its active system is, `--at` or `at` where "
        "the run begins in it, and `length = 0` of [probe] counts positions at the tip");
  }

  // What of a setup a program of Mikroprog does not know: all but its datum and where the run begins. "":
  // none.
  static std::string_view setupOfMacroB(sim::Setup setup) {
    setup.at.reset();
    std::erase_if(setup.zeros, [](const sim::Setup::Zero& one) { return one.system == stdlib::kDatum; });
    return setup.firstFlag();
  }

  // A program of Mikroprog; what lint finds an error in is not run.
  Outcome runSuf() {
    if (!options_.shown.empty()) diagnostics().report<diag::OptionOfMacroB>({}, "--show");
    if (!options_.programs.empty()) diagnostics().report<diag::OptionOfMacroB>({}, "--programs");
    if (options_.probeMacros) diagnostics().report<diag::OptionOfMacroB>({}, "--probe-macros");
    if (device_.device) diagnostics().report<diag::OptionOfMacroB>({}, "--device");
    if (device_.report) diagnostics().report<diag::OptionOfMacroB>({}, "--report");
    if (!options_.common.set.empty()) diagnostics().report<diag::OptionOfCycles>({}, "--set");
    if (!options_.common.host.empty()) diagnostics().report<diag::OptionOfCycles>({}, "--host");
    if (const std::string_view flag = setupOfMacroB(options_.setup); !flag.empty())
      noSetup(std::string(flag));
    if (options_.activeSystem != 0) noSetup("--active-system");
    if (diagnostics().hasErrors()) return outcomeOf(session_, "");
    const std::optional<SufProgram> suf = loadSuf(options_.program, options_.control, session_);
    if (suf) world_ = sim::SimWorld::load(options_, session_);
    if (world_ && !setupOfMacroB(world_->setup()).empty())
      noSetup("[setup] of " + options_.common.job.value_or(options_.machine.value_or("")));
    if (!world_ || diagnostics().hasErrors()) return outcomeOf(session_, "");
    const auto datum = stdlib::datumOf(world_->setup());
    const std::string_view datumBy = stdlib::datumOf(options_.setup) ? "--datum" : "datum` of `[setup]";
    const sim::mikroprog::Profile profile(suf->control);
    sim::Machine machine(profile.machine, profile.dialect);
    if (!setParameters(options_.variables, profile, machine, diagnostics()) ||
        (datum && !placeDatum(*datum, datumBy, suf->control, world_->partZero(), machine, diagnostics())) ||
        !world_->prepare(machine) || !world_->startsWithinTravel(machine))
      return outcomeOf(session_, "");
    const auto others = loadOthers(options_.program, suf->program, suf->control, session_);
    if (!others) return outcomeOf(session_, "");
    return runCode(sim::mikroprog::compile(suf->program, profile, session_.sources(), others->byName),
                   machine, nullptr, "");
  }

  // Of an alarm over the tool length while none is in force and the machine's file has a probe; "": not so.
  std::string lengthAdvice(const sim::Machine& machine) const {
    const sim::RunEnd& end = machine.end();
    const bool ofLength = end.ending == sim::Ending::Alarm && machine.toolLength() == 0 &&
                          lowerCase(end.text).find("tool length") != std::string::npos;
    if (!ofLength || !world_->hasMachineFile() || world_->setup().tool) return "";
    return "the run began without a tool offset; `--tool N` puts the probe of the machine's file into the "
           "spindle "
           "with G43 HN in force, or the program writes G43 H before the call";
  }

  // `advice`: what a run lacks that does not come to its end.
  Outcome runCode(const sim::Bytecode& code, sim::Machine& machine, sim::MacroMeaning* macros,
                  const std::string& advice) {
    std::optional<sim::Trace> trace;
    if (options_.trace) machine.setTrace(&trace.emplace(options_.trace));
    sim::Run run(machine, code, session_.limits(), macros);
    run.setUnreadable(unreadable_);
    world_->setPlace([&run] { return sim::RunPlace{run.place(), run.openCalls(), run.program()}; });
    world_->setSafeMove([this, &run] {
      const SourceRange range = run.place();
      return safe_.contains({range.file, range.begin});
    });
    world_->setRange([&run] { return run.place(); });
    // Blocks of Mikroprog ask by a code of their own.
    if (!machine.dialect().firstParameter) {
      world_->setAsks([this, &run] {
        const SourceRange range = run.place();
        return asking_.contains({range.file, range.begin});
      });
      world_->setMissInHand([&run] { return run.missInHand(); });
      run.watchMisses(world_.get());
    }
    world_->attach(machine);
    for (auto number = unset_.begin(); number != unset_.end();)
      number = sim::isFresh(machine.common(*number)) ? std::next(number) : unset_.erase(number);
    run.watchUnset(unset_);
    if (watched_ != nullptr) run.setListener(&watched_->begins(run, machine));
    run.run();
    machine.setTrace(nullptr);
    if (trace) sim::traceVariables(machine, *trace);
    trace.reset();
    std::string lacking = lengthAdvice(machine);
    if (lacking.empty()) lacking = world_->startAdvice();
    sim::reportRun(run, machine, lacking.empty() ? advice : lacking, options_.programs,
                   world_->endedOutside(), session_);
    for (const sim::UnsetRead& one : run.unsetReads())
      world_->unsetRead(one.number, one.range);
    // A datum by G92 is what a program of Mikroprog is for, and a macro that is called leaves what it sets to
    // its caller.
    if (!machine.dialect().firstParameter && world_->setup().call.empty())
      sim::reportShifts(machine, run.place(), session_);
    return finish(machine, &run);
  }

  // Why the text counts as one for a lathe; "": it does not.
  static std::string latheOf(LineChunks& chunks) {
    constexpr std::size_t kMostWithout = 5000; // blocks: what shows it is among the first ones
    stdlib::LatheSigns signs;
    frontend::nc::Scanner scanner(chunks);
    scanner.skipsLeader();
    ir::NcWords words;
    for (std::size_t n = 0; scanner.next(words) == frontend::nc::Scanner::Result::Block; ++n) {
      signs.look(words, scanner.line());
      if (signs.isOfMill() || (n >= kMostWithout && !signs.sign())) return "";
    }
    const auto sign = signs.sign();
    return sign ? sim::latheText(sign->at, sign->what) : "";
  }

  // A program of plain blocks: block by block, in constant memory.
  Outcome runStreamed(LineChunks& chunks, sim::Machine& machine, const std::string& lathe) {
    std::optional<sim::Trace> trace;
    if (options_.trace) machine.setTrace(&trace.emplace(options_.trace));
    frontend::nc::Scanner scanner(chunks);
    scanner.skipsLeader();
    setPlace(scanner, machine);
    world_->attach(machine);
    ir::NcWords words;
    using Result = frontend::nc::Scanner::Result;
    Result result = Result::Block;
    while ((result = scanner.next(words)) == Result::Block) {
      if (callsProgram(words, machine)) break;
      if (const auto meaning = lathe.empty() ? std::string_view() : stdlib::meaningOnLathe(words);
          !meaning.empty()) {
        machine.inconclusive(sim::onLatheText(lathe, meaning));
        break;
      }
      if (!machine.execute(words)) break;
    }
    if (result == Result::End && machine.running()) machine.finish();
    machine.setTrace(nullptr);
    sim::reportLeader(options_.program, scanner, session_);
    trace.reset();
    if (result == Result::Error)
      sim::reportScanError(options_.program, scanner, chunks, session_);
    else
      sim::reportEnd(options_.program, scanner, machine, world_->endedOutside(), session_);
    sim::reportShifts(machine, sim::placeOfLine(options_.program, scanner, session_), session_);
    return finish(machine, nullptr);
  }

  // The lines at which something happens are kept as files of their own.
  void setPlace(const frontend::nc::Scanner& scanner, sim::Machine& machine) {
    world_->setPlace(
        [this, &scanner, line = std::uint64_t(0), range = SourceRange()]() mutable {
          if (line != scanner.line()) range = sim::placeOfLine(options_.program, scanner, session_);
          line = scanner.line();
          return sim::RunPlace{range, {}, 0};
        },
        [this, &scanner, &machine] {
          const std::uint32_t program = machine.frame().program;
          return sim::PictureBlock{sim::toUtf8Text(std::string(scanner.lineText())),
                                   fmt::format("{}:{}", options_.program, scanner.line()),
                                   program == 0 ? "" : fmt::format("O{:04}", program)};
        });
  }

  // A code that calls a program on this control: the run ends, as no programs are given.
  bool callsProgram(const ir::NcWords& words, sim::Machine& machine) const {
    if (control_->callCodes.empty() || (words.present & ir::addressBits("GMT")) == 0) return false;
    const auto calls = [&](char letter, double value, std::uint32_t which) {
      const stdlib::CallCode* const call = sim::findCallCode(*control_, letter, value);
      if (call != nullptr)
        machine.inconclusive("it calls a program; `--programs DIR` gives those that it may call", letter,
                             which);
      return call != nullptr;
    };
    for (std::uint32_t i = 0; i < words.gCount; ++i)
      if (calls('G', words.g[i] / 10.0, i)) return true;
    for (std::uint32_t i = 0; i < words.mCount; ++i)
      if (calls('M', words.m[i], i)) return true;
    return words.has('T') && calls('T', words.of('T'), 0);
  }

  const SimOptions& options_;
  const sim::DeviceOptions& device_;
  Session& session_;
  WatchedRun* watched_; // nullptr: nobody listens
  std::optional<stdlib::Control> control_;
  std::unique_ptr<sim::SimWorld> world_;
  std::optional<sim::DeviceFile> deviceFile_;
  std::optional<sim::Device> running_;
  std::vector<project::ShownVariable> shown_;
  sim::BlockSet safe_;                              // skip moves to a position
  std::set<std::uint32_t> unset_;                   // common variables that no program sets
  sim::BlockSet asking_;                            // blocks that ask what a skip move came to
  std::map<std::uint64_t, std::string> unreadable_; // programs that have errors, with their files
};

} // namespace

Outcome sim(const SimOptions& options) {
  return sim(options, {});
}

Outcome sim(const SimOptions& options, const sim::DeviceOptions& device) {
  Outcome out = guarded(options.common, {options.program},
                        [&](Session& session) { return SimCommand(options, device, session).run(); });
  if (options.json && out.output.empty()) out.output = sim::notRunSummary(out.diagnostics, out.sources);
  if ((options.svg || options.html) && out.files.empty()) out.diagnostics.report<diag::PictureNotWritten>({});
  return out;
}

Outcome runWatched(const SimOptions& options, WatchedRun& watched, Session& session) {
  const sim::DeviceOptions none;
  return SimCommand(options, none, session, &watched).run();
}

} // namespace dotek::driver
