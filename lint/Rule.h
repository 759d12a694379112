// A rule of the linter: one file of lint/rules, whose name without suffix is the rule's id. The folder is the
// registry; docs/rules/<id>.md documents the rule and tests it.
#pragma once

#include "support/Diagnostics.h"

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace dotek::lint {

struct Project;

// What a rule looks at: characters, one language's tree, the IR, or files beside one another.
enum class Tier : std::uint8_t { Text, Syntax, Ir, Bundle };
std::string_view tierName(Tier tier);

enum class Maturity : std::uint8_t { Preview, Stable, Deprecated };

// Where a rule puts its findings.
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

private:
  std::string_view id_;
  Severity severity_;
  Diagnostics& diagnostics_;
};

struct Rule {
  // Error: what is certain; Warning: what is likely; Note: what is worth knowing.
  Severity severity = Severity::Warning;
  // false: taste, or too weak a sign; runs where it is selected.
  bool byDefault = true;
  Tier tier = Tier::Syntax;
  Maturity maturity = Maturity::Stable;
  std::string_view explanation; // what `explain` prints
  void (*check)(const Project& project, Report& report) = nullptr;
};

struct NamedRule {
  std::string_view id;
  const Rule* rule = nullptr;
};

// All rules, sorted by id. Generated from the folder.
std::span<const NamedRule> rules();
const NamedRule* findRule(std::string_view id); // nullptr: there is none

// Rules and the messages of the front ends as `list rules` and `explain` see them, sorted by code.
struct CodeInfo {
  std::string_view code;
  Severity severity = Severity::Warning;
  std::string_view explanation;
  bool byDefault = true;
  const Rule* rule = nullptr; // nullptr: a message
};
std::span<const CodeInfo> codeTable();

} // namespace dotek::lint

// Defines the rule of a file: the id with `_` for `-`.
#define DOTEK_LINT_RULE(name)                                                                                \
  extern const ::dotek::lint::Rule name;                                                                     \
  const ::dotek::lint::Rule name
