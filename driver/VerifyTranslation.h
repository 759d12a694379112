// Private to Verify*.cpp: the translation as text that runs, and the stage on which both sides run.
#pragma once

#include "driver/VerifySubject.h"
#include "ir/Program.h"
#include "sim/machine/Bytecode.h"
#include "stdlib/Control.h"
#include "stdlib/MacroSet.h"

#include <deque>
#include <string>

namespace dotek::driver {

// Programs that were read back by the target's own front end, in a map of sources of their own.
class TargetPrograms {
public:
  // false: it cannot be read back, reported. The first program that is read is the main one.
  bool read(const std::string& name, std::string text, const stdlib::Control& control, Session& session);
  // The same; its lines are those that line() knows.
  bool readTranslation(const Translation& translation, const stdlib::Control& control, Session& session);
  // The first program of the translation can be called by this number.
  void numberFirst(std::uint32_t number) {
    ir::Program& first = files_.back().programs.front();
    first.nameKind = ir::Program::NameKind::Number;
    first.number = number;
  }
  // The text of macros of which Dotek has it.
  bool readMacros(const stdlib::MacroSet& set, const stdlib::Control& control, Session& session);
  bool compile(const stdlib::Control& control); // true

  const sim::Bytecode& code() const { return code_; }
  // Of the translation, from 1; 0: the place lies elsewhere.
  std::uint32_t line(SourceRange range) const {
    return range.file == translation_ ? sources_.line(range) : 0;
  }

private:
  SourceMap sources_;
  std::deque<ir::ProgramFile> files_;
  FileId translation_ = 0;
  sim::Bytecode code_;
};

// What convert wrote, with its one result.
Translation translationOf(const Outcome& converted);
// The text of `path` instead; lines that stood before keep what they come from. false: reported.
bool takeEdited(const std::string& path, Translation& translation, Session& session);

// ---- the stage
// ---------------------------------------------------------------------------------------------------

// The files of --machine and --part into the plan. false: reported.
bool loadWorld(const VerifyOptions& options, VerifyPlan& plan, Session& session);
// A calibrated probe with the ball of the case, as exact as its signal; off.
sim::Probe probeFor(const VerifyPlan& plan, const verify::Case& drawn);
verify::Entry entryFor(const VerifyPlan& plan, const verify::Case& drawn, bool probeOn);
// Nothing that a probe could meet.
sim::Part emptyPart(const sim::Point3& middle);
// What results may differ by where one of the controls computes with eight digits, mm.
double resultTolerance(const stdlib::Control& one, const stdlib::Control& other);

} // namespace dotek::driver
