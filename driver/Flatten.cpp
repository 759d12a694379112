// `dotek flatten`: what a run of a macro program gives the control to do, as plain blocks.
#include "driver/Command.h"
#include "driver/ProgramTools.h"
#include "driver/WatchedRun.h"
#include "project/Inputs.h"
#include "project/VariableFlags.h"
#include "sim/machine/Arguments.h"
#include "sim/machine/Value.h"
#include "stdlib/MacroSet.h"
#include "support/Decimal.h"
#include "support/messages/Sim.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <set>
#include <span>

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

class FlatProgram final : public WatchedRun, public sim::RunListener {
public:
  FlatProgram(const SimOptions& options, Session& session) : options_(options), session_(session) {}

  std::string_view command() const override { return "flatten"; }
  // After a run that came to its end.
  std::string take() const { return "%\n" + header_ + text_ + "%\n"; }

  void read(const stdlib::Control& control, const std::vector<const ir::Program*>& programs,
            FileId file) override {
    control_ = &control;
    mainProgram_ = programs.front()->number;
    mainFile_ = file;
    header_ = headerOf(*programs.front());
    for (const ir::Program* program : programs)
      for (const ir::ProgramStatement& statement : program->body)
        if (statement.blockDelete != 0 && !std::holds_alternative<ir::NcBlock>(statement.node))
          session_.diagnostics().report<diag::FlattenSwitch>(statement.origin.range());
    // By --var: known to who asks.
    for (const auto& [number, value] : variablesOf(options_.variables, session_.diagnostics()))
      written_.insert(number);
  }
  sim::RunListener& begins(const sim::Run& run, const sim::Machine& machine) override {
    run_ = &run;
    machine_ = &machine;
    return *this;
  }

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
    if (measured_.contains(number)) return measuredRead(number, value);
    if (written_.contains(number) || !read_.insert(number).second) return;
    if (canBePreset(number))
      session_.diagnostics().report<diag::FlattenReads>(run_->place(), "follows from " + held(number, value),
                                                        number);
    else
      session_.diagnostics().report<diag::FlattenPosition>(run_->place(), held(number, value));
  }
  void systemWritten(std::uint32_t number, double value) override {
    written_.insert(number);
    measured_.erase(number);
    line(fmt::format("#{}={}", number, numberOf(value, true)));
  }
  void message(std::string_view text) override {
    line(fmt::format("#{}=1({})", control_->variables.message.value_or(3006), text), false);
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
  // What calls it stays, with its values: a run of the flat program gives the macro the same meaning.
  void meaningRan(std::uint32_t program, std::span<const double> locals) override {
    std::string block = fmt::format("G65 P{}", program);
    for (std::uint32_t local = 1; local < locals.size(); ++local) {
      if (sim::isNull(locals[local])) continue;
      const char letter = stdlib::letterOfLocal(local);
      if (letter == 0) {
        session_.diagnostics().report<diag::RunInconclusive>(
            run_->place(), fmt::format("G65 P{}", program),
            fmt::format("its argument #{} has no letter, so no block says the same", local));
        return;
      }
      block += fmt::format(" {}{}", letter, numberOf(locals[local], true));
    }
    line(block);
  }
  void measuredWritten(std::uint32_t number) override { measured_.insert(number); }
  void measuredRead(std::uint32_t number, double value) override {
    if (measuredReads_.insert(number).second)
      session_.diagnostics().report<diag::FlattenPosition>(run_->place(), held(number, value));
  }
  void named(const ir::NameVariables& names) override {
    std::string all;
    for (const std::string& name : names.names)
      all += (all.empty() ? "" : ",") + name;
    line(fmt::format("SETVN{}[{}]", names.first, all));
  }

private:
  static std::string held(std::uint32_t number, double value) {
    return sim::isNull(value) ? fmt::format("`#{}` without a value", number)
                              : fmt::format("`#{}` = {}", number, numberOf(value, false));
  }

  // --var sets it; else it is what the run itself comes to, as positions and modal values are.
  bool canBePreset(std::uint32_t number) const {
    sim::Machine other(*machine_);
    other.setTrace(nullptr);
    other.setWatcher(nullptr);
    return other.preset(number, 0);
  }

  // A code that calls a program has been an ordinary one where the run came to it.
  void checkCode(char letter, double value) {
    const stdlib::CallCode* const call = sim::findCallCode(*control_, letter, value);
    if (call == nullptr) return;
    session_.diagnostics().report<diag::FlattenCalls>(
        run_->place(), letter + numberOf(value, false),
        call->letter == 'T' ? call->program
                            : call->program + static_cast<std::uint32_t>(value) - call->first);
  }

  // Its source as a comment: the line, of another program than the main one with its number.
  void line(std::string block, bool comment = true) {
    const std::uint64_t most = session_.limits().outputBytes;
    if (text_.size() > most) return;
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
    if (text_.size() > most) session_.diagnostics().report<diag::FlattenLong>({}, most);
  }

  std::string headerOf(const ir::Program& main) const {
    const std::string comment =
        "(FLAT: " + commentText(std::filesystem::path(options_.program).filename().string()) + ")\n";
    switch (main.nameKind) {
    case ir::Program::NameKind::None: return comment;
    case ir::Program::NameKind::Number: return "O" + main.name + " " + comment;
    case ir::Program::NameKind::Colon: return ":" + main.name + " " + comment;
    case ir::Program::NameKind::Name: return "<" + main.name + "> " + comment;
    }
    return comment;
  }

  const SimOptions& options_;
  Session& session_;
  const stdlib::Control* control_ = nullptr;
  std::uint64_t mainProgram_ = 0;
  FileId mainFile_{};
  const sim::Run* run_ = nullptr;
  const sim::Machine* machine_ = nullptr;
  std::set<std::uint32_t> read_, written_;           // system variables; written, or given
  std::set<std::uint32_t> measured_, measuredReads_; // left by macros without text
  std::string header_, text_;
};

} // namespace

Outcome flatten(const SimOptions& options) {
  return guarded(options.common, {options.program}, [&](Session& session) {
    if (!options.program.empty())
      static_cast<void>(kindAmong(options.program, {InputKind::Nc}, "an NC program", session));
    if (session.diagnostics().hasErrors()) return outcomeOf(session, "");
    FlatProgram flat(options, session);
    Outcome out = runWatched(options, flat, session);
    out.output = out.status == 0 ? flat.take() : "";
    return out;
  });
}

} // namespace dotek::driver
