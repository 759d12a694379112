// Checks: functions that judge what is written. `lint` runs each as a rule with a page (docs/rules); commands
// that write or run the same input call them, too.
#pragma once

#include "support/Diagnostics.h"

#include <span>
#include <string_view>
#include <utility>

namespace dotek {

// Where a check puts its findings, all of one code.
class Report {
public:
  Report(std::string_view id, Severity severity, Diagnostics& diagnostics)
      : id_(id), severity_(severity), diagnostics_(diagnostics) {}

  // Worded as docs/diagnostics.md says. The reference is good until the next finding.
  template <class... Args>
  Diagnostic& at(SourceRange range, fmt::format_string<Args...> format, Args&&... args) {
    return diagnostics_.add(
        {id_, severity_, range, fmt::format(format, std::forward<Args>(args)...), {}, {}});
  }

  // No more findings are kept for this file: a check may spare the work.
  bool full(FileId file) const { return diagnostics_.full(id_, file); }

private:
  std::string_view id_;
  Severity severity_;
  Diagnostics& diagnostics_;
};

// One kind of finding of a front end. `Input` is what it looks at, with what several checks need of it.
template <class Input> struct Check {
  std::string_view code; // id of the rule
  Severity severity = Severity::Warning;
  void (*run)(const Input& input, Report& report) = nullptr;
};

// Runs the checks in their order.
template <class Input>
void runChecks(std::span<const Check<Input>* const> checks, const Input& input, Diagnostics& diagnostics) {
  for (const Check<Input>* check : checks) {
    Report report(check->code, check->severity, diagnostics);
    check->run(input, report);
  }
}

} // namespace dotek

// Declares the check `name`, a function, and `nameCheck`, which describes it. `severityId`: Note, Warning,
// Error.
#define DOTEK_CHECK(Input, name, codeText, severityId)                                                       \
  void name(const Input& input, ::dotek::Report& report);                                                    \
  inline constexpr ::dotek::Check<Input> name##Check {                                                       \
    codeText, ::dotek::Severity::severityId, name                                                            \
  }
