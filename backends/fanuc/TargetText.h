// Private to Target*.cpp: the text of a translation, ready to run.
#pragma once

#include "ir/Program.h"
#include "project/Session.h"
#include "sim/machine/Bytecode.h"
#include "sim/machine/SafeMoves.h"
#include "stdlib/Control.h"
#include "stdlib/MacroSet.h"
#include "targets/Subject.h"

#include <cstdint>
#include <deque>
#include <map>
#include <string>

namespace dotek::targets {

// Programs that were read back by the front end of macro B, in a map of sources of their own.
class FanucText {
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
  void compile(const stdlib::Control& control);

  const sim::Bytecode& code() const { return code_; }
  const sim::BlockSet& safeMoves() const { return safe_; } // of compile()
  // Common variables that the translation writes by their numbers, and in which line first.
  std::map<std::uint32_t, std::uint32_t> storesOfTranslation() const;
  // Of the translation, from 1; 0: the place lies elsewhere.
  std::uint32_t line(SourceRange range) const {
    return range.file == translation_ ? sources_.line(range) : 0;
  }

private:
  SourceMap sources_;
  std::deque<ir::ProgramFile> files_;
  FileId translation_ = 0;
  sim::Bytecode code_;
  sim::BlockSet safe_;
};

} // namespace dotek::targets
