// A rule of the linter: one file of lint/rules, whose name without suffix is the rule's id. The folder is the
// registry; docs/rules/<id>.md explains the rule and tests it (lint/Page.h).
#pragma once

#include "support/Check.h"

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace dotek::frontend::macrob {
class CheckedProgram;
}

namespace dotek::lint {

struct Project;
class NcProgram;

// What a rule looks at: characters, one language's tree, the IR, or files beside one another.
enum class Tier : std::uint8_t { Text, Syntax, Ir, Bundle };
std::string_view tierName(Tier tier);

enum class Maturity : std::uint8_t { Preview, Stable, Deprecated };

struct Rule {
  // Error: what is certain; Warning: what is likely; Note: what is worth knowing.
  Severity severity = Severity::Warning;
  // false: taste, or too weak a sign; runs where it is selected.
  bool byDefault = true;
  Tier tier = Tier::Syntax;
  Maturity maturity = Maturity::Stable;
  // The check of a front end that other commands run, too (lint/Shared.h). Of such findings and of messages
  // that begin at one place only the most severe are kept.
  bool shared = false;
  // What looks at all inputs together; nullptr: none.
  void (*check)(const Project& project, Report& report) = nullptr;
  // What looks at one NC program by itself, lowered or as it was parsed; nullptr: none. All such checks look
  // at a program before the next one comes: it is in the processor's cache then (lint/Run.h).
  void (*program)(const NcProgram& program, Report& report) = nullptr;
  void (*parsed)(const frontend::macrob::CheckedProgram& program, Report& report) = nullptr;
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
  bool byDefault = true;
  const Rule* rule = nullptr;   // nullptr: a message
  std::string_view explanation; // of a message; "" for a rule, whose page explains it
};
// One sentence for tables: the first one of the page or of the explanation.
std::string summaryOf(const CodeInfo& info);
std::span<const CodeInfo> codeTable();

} // namespace dotek::lint

// Defines the rule of a file: the id with `_` for `-`.
#define DOTEK_LINT_RULE(name)                                                                                \
  extern const ::dotek::lint::Rule name;                                                                     \
  const ::dotek::lint::Rule name
