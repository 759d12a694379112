// Runs macro programs on a machine, for tests.
#pragma once

#include "frontend/macrob/Lower.h"
#include "sim/machine/Compile.h"
#include "sim/machine/Run.h"
#include "sim/machine/Value.h"
#include "stdlib/DataFiles.h"
#include "support/Decimal.h"
#include "tests/unit/MacroBHelper.h"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>

namespace dotek::tests {

inline stdlib::Control controlOf(const std::string& name) {
  return *stdlib::Control::load(stdlib::DataFiles(), name);
}

struct MacroRun {
  // The blocks of O1, with M30 after them; or whole programs, where the text begins with O. nullptr: none.
  explicit MacroRun(const std::string& text, stdlib::Control control = controlOf("fanuc-31i-b"),
                    sim::SkipSignal* signal = nullptr, sim::MacroMeaning* meaning = nullptr,
                    const Limits& limits = Limits())
      : profile(std::move(control)),
        parsed("%\n" + (text.starts_with('O') ? text : "O1\n" + text + "M30\n") + "%\n"),
        machine(std::make_unique<sim::Machine>(profile)) {
    file = frontend::macrob::lower(parsed.file, profile, parsed.sources, parsed.diagnostics);
    CAPTURE(text);
    CAPTURE(parsed.told());
    REQUIRE(file);
    std::vector<const ir::Program*> programs;
    for (const ir::Program& program : file->programs)
      programs.push_back(&program);
    code = sim::compile(programs, profile, parsed.sources);
    machine->setSkipSignal(signal);
    sim::Trace lines([&](std::string_view piece) { trace += piece; });
    machine->setTrace(&lines);
    run = std::make_unique<sim::Run>(*machine, code, limits, meaning);
    run->run();
    machine->setTrace(nullptr);
    lines.flush();
  }

  // "end", "text end", "alarm 112 ZERO DIVIDE", "inconclusive: why", "limit: which".
  std::string end() const {
    const sim::RunEnd& end = machine->end();
    switch (end.ending) {
    case sim::Ending::ProgramEnd: return "end";
    case sim::Ending::TextEnd: return "text end";
    case sim::Ending::Alarm: return fmt::format("alarm {}", end.number);
    case sim::Ending::Inconclusive: return "inconclusive: " + end.text;
    case sim::Ending::Limit: return "limit: " + end.text;
    default: return "none";
    }
  }
  // "null", a number, or "" where it was never written.
  std::string at(std::uint32_t number) const {
    for (const auto& [variable, value] : machine->written())
      if (variable == number) return sim::isNull(value) ? "null" : numberText(value);
    return "";
  }
  // Where the run ended.
  std::string text() const { return parsed.sources.textUtf8(run->place()); }

  stdlib::Control profile;
  MacroFile parsed;
  std::unique_ptr<sim::Machine> machine;
  std::optional<ir::ProgramFile> file;
  sim::Bytecode code;
  std::unique_ptr<sim::Run> run;
  std::string trace;
};

// The value of #2 after the blocks, or how the run ended where it did not come to M30.
inline std::string value(const std::string& blocks, const std::string& control = "fanuc-31i-b") {
  const MacroRun run(blocks, controlOf(control));
  return run.end() == "end" ? run.at(2) : run.end();
}

} // namespace dotek::tests
