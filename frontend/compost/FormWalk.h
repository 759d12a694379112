// Private to Post*.cpp, Lower*.cpp: the walk of a routine by a Form, which says what each word prints. The
// order of words, literals and conditions is read here, once; numbers or variables for the values are the
// sink's.
#pragma once

#include "frontend/compost/Conditions.h"
#include "frontend/compost/ProgTables.h"
#include "frontend/compost/Walk.h"
#include "support/Limits.h"

#include <functional>
#include <map>
#include <set>
#include <string>

namespace dotek::frontend::compost {

// A value that a word prints.
struct PrintedValue {
  enum class From : std::uint8_t { Field, Host };
  From from = From::Field;
  std::string_view name; // of the field or of the host input
  const Word& word;
};

class FormWalk : public Walk {
protected:
  FormWalk(const Program& program, const stdlib::Form& form, const std::set<std::string>& assumptions,
           const Limits& limits, Diagnostics& diagnostics);

  // ---- the sink
  // What the form prints for a command.
  virtual void text(std::string_view bytes, SourceRange range) = 0;
  virtual void sequenceNumber(const std::string& address, SourceRange range) = 0;
  // `picture` is asked once the value is known, and gives nullptr where it has reported why there is none; it
  // lives as long as this object.
  virtual void value(const PrintedValue& value, const std::function<const Picture*()>& picture) = 0;
  // An error was reported.
  virtual void failed() {}

  // Counts bytes of output; false once there are too many: reported, and the walk is over.
  bool grow(std::size_t bytes, SourceRange where);
  bool stopped() const { return stopped_; }

  template <class Id, class... Args> Diagnostic& refuse(SourceRange range, const Args&... args) {
    failed();
    return diagnostics_->report<Id>(range, args...);
  }
  // The first time for this cause, such as a word that many lines use: report it.
  bool isNew(std::string_view code, std::string_view cause) {
    return told_.insert(std::string(code) + ' ' + std::string(cause)).second;
  }

  // ---- Walk
  bool step(SourceRange where) override;
  const Routine* routineOf(const Word& word) const override;
  bool enter(const Routine& routine, SourceRange where) override;
  void leave(const Routine&) override { --depth_; }
  void word(const Word& word) override;

  const stdlib::Form& form_;
  const Limits& limits_;
  Diagnostics* diagnostics_; // never null; a side that is only looked at reports elsewhere
  ProgTables tables_;
  Conditions conditions_;
  bool stopped_ = false; // a limit was hit

private:
  void command(const Word& word);
  void numeric(const Word& word);
  std::string meantCommand(const std::string& name) const;
  std::string meantNumeric(const std::string& name) const;
  const Picture* commandPicture(const std::string& name, const std::string& text); // nullptr: it is none

  const Program& program_;
  std::map<std::string, Picture, std::less<>> commandPictures_; // callers keep pointers to them
  std::set<std::string, std::less<>> told_;
  std::uint64_t steps_ = 0;
  std::uint64_t bytes_ = 0;
  std::uint32_t depth_ = 0;
};

} // namespace dotek::frontend::compost
