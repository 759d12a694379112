// `dotek flatten`: what a run of a macro program gives the control to do, as plain blocks.
#include "driver/Command.h"
#include "driver/ProgramTools.h"
#include "project/Inputs.h"
#include "project/Lowering.h"
#include "project/ProgramLibrary.h"
#include "project/Settings.h"
#include "project/VariableFlags.h"
#include "sim/machine/Arguments.h"
#include "sim/machine/Compile.h"
#include "sim/machine/Run.h"
#include "sim/machine/SafeMoves.h"
#include "sim/machine/Value.h"
#include "sim/run/Advice.h"
#include "sim/run/SimMacros.h"
#include "sim/run/SimReport.h"
#include "support/Decimal.h"
#include "support/messages/Commands.h"
#include "support/messages/Sim.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <set>

namespace dotek::driver {
namespace {

constexpr int kDecimals = 8; // of an inch, finer than the grid of the machine

// As in a block: with a point where `point`, and no more digits than a control reads.
std::string numberOf(double value, bool point) {
  std::string text = fixedText(value, kDecimals);
  if (const std::size_t at = text.find('.'); at != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  if (text == "-0") text = "0";
  if (point && text.find('.') == std::string::npos) text += '.';
  return text;
}

// Comments hold capital letters and no brackets.
std::string commentText(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const char upper = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    out += (upper >= 'A' && upper <= 'Z') || (upper >= '0' && upper <= '9') ||
                   std::string_view(" .,-+/_:").find(upper) != std::string_view::npos
               ? upper
               : '-';
  }
  return out;
}

class FlatProgram final : public sim::RunListener {
public:
  FlatProgram(const stdlib::Control& control, std::uint64_t mainProgram, FileId mainFile, Session& session)
      : control_(control), mainProgram_(mainProgram), mainFile_(mainFile), session_(session) {}

  void setRun(const sim::Run& run) { run_ = &run; }
  void given(std::uint32_t number) { written_.insert(number); } // by --var: known to who asks
  std::string take() { return std::move(text_); }

  void blockDone(const ir::NcWords& words, std::uint32_t points) override {
    std::string out;
    const ir::ProgramStatement& statement = run_->statement();
    if (statement.blockDelete != 0)
      out += statement.blockDelete == 1 ? "/" : fmt::format("/{}", statement.blockDelete);
    const auto add = [&](const std::string& word) {
      if (!out.empty() && out.back() != '/') out += ' ';
      out += word;
    };
    for (std::uint32_t i = 0; i < words.gCount; ++i) {
      checkCode('G', words.g[i] / 10.0);
      add(words.g[i] % 10 == 0 ? fmt::format("G{}", words.g[i] / 10)
                               : fmt::format("G{}.{}", words.g[i] / 10, words.g[i] % 10));
    }
    for (const char letter : std::string_view("XYZABCUVWIJKRQPLHDEFSTNO"))
      if (words.has(letter)) {
        if (letter == 'T') checkCode(letter, words.of(letter));
        const std::uint32_t bit = ir::addressBit(letter);
        const bool whole = ir::isAddressIn(ir::kWholeAddresses, letter);
        const bool point = (points & bit) != 0 || (!whole && (words.pointed & bit) != 0);
        add(letter + numberOf(words.of(letter), point));
      }
    for (std::uint32_t i = 0; i < words.mCount; ++i) {
      checkCode('M', words.m[i]);
      add(fmt::format("M{:02}", words.m[i]));
    }
    line(out);
  }

  void systemRead(std::uint32_t number, double value) override {
    if (written_.contains(number) || !read_.insert(number).second || read_.size() > kMostReads) return;
    session_.diagnostics().report<diag::FlattenReads>(
        run_->place(),
        sim::isNull(value) ? fmt::format("follows from `#{}` without a value", number)
                           : fmt::format("follows from `#{}` = {}", number, numberOf(value, false)),
        number);
  }
  void systemWritten(std::uint32_t number, double value) override {
    written_.insert(number);
    line(fmt::format("#{}={}", number, numberOf(value, true)));
  }
  void message(std::string_view text) override {
    line(fmt::format("#{}=1({})", control_.variables.message.value_or(3006), text), false);
  }
  void portSwitched(bool open) override { line(open ? "POPEN" : "PCLOS"); }
  void printed(bool binary, std::string_view printed) override {
    if (binary) {
      session_.diagnostics().report<diag::FlattenBinary>(run_->place());
      return;
    }
    std::string text(printed);
    const bool fits = std::all_of(text.begin(), text.end(), [](char c) {
      return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
             std::string_view(" +-*/.").find(c) != std::string_view::npos;
    });
    if (!fits) session_.diagnostics().report<diag::FlattenText>(run_->place(), text);
    std::replace(text.begin(), text.end(), ' ', '*');
    line("DPRNT[" + text + "]");
  }
  void named(const ir::NameVariables& names) override {
    std::string all;
    for (const std::string& name : names.names)
      all += (all.empty() ? "" : ",") + name;
    line(fmt::format("SETVN{}[{}]", names.first, all));
  }

private:
  static constexpr std::size_t kMostReads = 20;

  // A code that calls a program has been an ordinary one where the run came to it.
  void checkCode(char letter, double value) {
    const stdlib::CallCode* const call = sim::findCallCode(control_, letter, value);
    if (call == nullptr) return;
    session_.diagnostics().report<diag::FlattenCalls>(
        run_->place(), letter + numberOf(value, false),
        call->letter == 'T' ? call->program
                            : call->program + static_cast<std::uint32_t>(value) - call->first);
  }

  // Its source as a comment: the line, of another program than the main one with its number.
  void line(std::string block, bool comment = true) {
    if (text_.size() > session_.limits().outputBytes) return;
    const SourceRange range = run_->place();
    if (comment && range.hasPlace()) {
      const std::uint64_t program = run_->program();
      const std::string who = program != mainProgram_ ? fmt::format("O{:04} ", program)
                              : range.file == mainFile_
                                  ? ""
                                  : commentText(session_.sources().file(range.file).name()) + " ";
      block += fmt::format(" ({}LINE {})", who, session_.sources().line(range));
    }
    text_ += block;
    text_ += '\n';
  }

  const stdlib::Control& control_;
  std::uint64_t mainProgram_;
  FileId mainFile_;
  Session& session_;
  const sim::Run* run_ = nullptr;
  std::set<std::uint32_t> read_, written_; // system variables; written, or given
  std::string text_;
};

class FlattenCommand {
public:
  FlattenCommand(const FlattenOptions& options, Session& session) : options_(options), session_(session) {}

  Outcome run() {
    if (options_.input.empty())
      diagnostics().report<diag::MissingOption>({}, "flatten", "PROGRAM", "an NC program");
    else
      static_cast<void>(kindAmong(options_.input, {InputKind::Nc}, "an NC program", session_));
    if (diagnostics().hasErrors()) return outcomeOf(session_, "");
    const Settings settings = settingsOf(options_.input, session_);
    const std::string name = !options_.control.empty() ? options_.control : settings.control;
    const auto control = loadControl(name.empty() ? std::string(project::kDefaultControl) : name, session_);
    if (!control || diagnostics().hasErrors()) return outcomeOf(session_, "");
    const std::optional<FileId> id = session_.read(options_.input, Encoding::Cp1250);
    if (!id) return outcomeOf(session_, "");
    std::optional<ProgramLibrary> library = ProgramLibrary::load(*id, options_.programs, *control, session_);
    if (!library) return outcomeOf(session_, "");
    const auto macros = sim::SimMacros::load(std::nullopt, false, *control, *library, session_);
    sim::Machine machine(*control);
    if (!macros || !setVariables(machine, *control)) return outcomeOf(session_, "");
    return outcomeOf(session_, flat(*control, *library, machine, *macros, *id));
  }

private:
  Diagnostics& diagnostics() { return session_.diagnostics(); }

  bool setVariables(sim::Machine& machine, const stdlib::Control& control) {
    for (const auto& [number, value] : variablesOf(options_.variables, diagnostics()))
      if (!machine.preset(number, value))
        diagnostics().report<diag::VariableFlag>(
            {}, fmt::format("{}={}", number, numberText(value)),
            fmt::format("`{}` has no such variable that a program could set", control.name));
    return !diagnostics().hasErrors();
  }

  std::string flat(const stdlib::Control& control, ProgramLibrary& library, sim::Machine& machine,
                   sim::SimMacros& macros, FileId id) {
    const std::vector<const ir::Program*> programs = library.programs();
    const ir::Program& main = *programs.front();
    const sim::Bytecode code = sim::compile(programs, control, session_.sources());
    sim::Run run(machine, code, session_.limits(), &macros);
    run.setUnreadable(library.unreadable());
    FlatProgram flat(control, main.number, id, session_);
    flat.setRun(run);
    for (const auto& [number, value] : variablesOf(options_.variables, diagnostics()))
      flat.given(number);
    run.setListener(&flat);
    std::set<std::uint32_t> unset = sim::neverSet(programs);
    std::erase_if(unset, [&](std::uint32_t number) { return !sim::isFresh(machine.common(number)); });
    run.watchUnset(unset);
    run.run();
    sim::reportRun(run, machine, sim::callAdvice(main, false), options_.programs, false, session_);
    for (const sim::UnsetRead& one : run.unsetReads())
      diagnostics().report<diag::VariableNotSet>(one.range, one.number, one.number);
    for (const ir::Program* program : programs)
      for (const ir::ProgramStatement& statement : program->body)
        if (statement.blockDelete != 0 && !std::holds_alternative<ir::NcBlock>(statement.node))
          diagnostics().report<diag::FlattenSwitch>(statement.origin.range());
    std::string body = flat.take();
    if (body.size() > session_.limits().outputBytes)
      diagnostics().report<diag::FlattenLong>({}, session_.limits().outputBytes);
    if (diagnostics().hasErrors()) return "";
    return "%\n" + header(main) + body + "%\n";
  }

  std::string header(const ir::Program& main) const {
    const std::string comment =
        "(FLAT: " + commentText(std::filesystem::path(options_.input).filename().string()) + ")\n";
    switch (main.nameKind) {
    case ir::Program::NameKind::None: return comment;
    case ir::Program::NameKind::Number: return "O" + main.name + " " + comment;
    case ir::Program::NameKind::Colon: return ":" + main.name + " " + comment;
    case ir::Program::NameKind::Name: return "<" + main.name + "> " + comment;
    }
    return comment;
  }

  const FlattenOptions& options_;
  Session& session_;
};

} // namespace

Outcome flatten(const FlattenOptions& options) {
  return guarded(options.common, [&](Session& session) { return FlattenCommand(options, session).run(); });
}

} // namespace dotek::driver
