// Diagnostics: what Dotek says of an input. Front ends and commands report; cli prints.
#pragma once

#include "support/Source.h"

#include <cstdint>
#include <fmt/format.h>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace dotek {

enum class Severity : std::uint8_t { Note, Warning, Error };

std::string_view severityName(Severity severity);

struct Edit {
  SourceRange range; // empty range: insertion
  std::string text;
};

// `Safe` may be applied by --fix; `Display` touches motion, coordinates or meaning and is only shown.
// A repair may also be accepted by --recover.
struct Fix {
  enum class Applicability : std::uint8_t { Safe, Display };
  Applicability applicability = Applicability::Display;
  std::string title;
  std::vector<Edit> edits;
};

struct DiagnosticNote {
  SourceRange range;
  std::string message;
};

struct Diagnostic {
  std::string_view code; // points into a static table
  Severity severity = Severity::Error;
  SourceRange range;
  std::string message; // UTF-8
  std::vector<DiagnosticNote> notes;
  std::optional<Fix> fix;

  Diagnostic& note(SourceRange where, std::string text) {
    notes.push_back({where, std::move(text)});
    return *this;
  }
};

// One line of support/messages/*.def: a message that is no lint rule.
struct MessageInfo {
  std::string_view code;
  Severity severity;
  std::string_view explanation; // what `explain` prints
};

// All messages, sorted by code.
std::span<const MessageInfo> messageTable();

// Each message is a type of the namespace diag (support/messages/<Group>.h), so that its format string is
// checked against its arguments at compile time.
#define DOTEK_MESSAGE_TYPE(Id, codeText, severityId, formatText, explanationText)                            \
  struct Id {                                                                                                \
    static constexpr std::string_view code = codeText;                                                       \
    static constexpr Severity severity = Severity::severityId;                                               \
    static constexpr const char* format = formatText;                                                        \
  };

// Makes the diagnostic `Id` of the namespace diag; text arguments are UTF-8.
template <class Id, class... Args> Diagnostic makeDiagnostic(SourceRange range, const Args&... args) {
  constexpr fmt::format_string<const Args&...> format = Id::format;
  return Diagnostic{Id::code, Id::severity, range, fmt::format(format, args...), {}, std::nullopt};
}

// Collects the diagnostics of one command. Equal ones (code, place, message) are kept once. Of one code in
// one file kMostAlike are kept; `too-many-findings` stands for the rest, as an error if an error is among
// them.
class Diagnostics {
public:
  static constexpr std::uint32_t kMostAlike = 1000;

  template <class Id, class... Args> Diagnostic& report(SourceRange range, const Args&... args) {
    return add(makeDiagnostic<Id>(range, args...));
  }
  // The reference is good until the next call.
  Diagnostic& add(Diagnostic diagnostic);

  // Nothing more of `code` is kept for this file: a caller may spare the work.
  bool full(std::string_view code, FileId file) const;

  const std::vector<Diagnostic>& all() const { return items_; }
  std::vector<Diagnostic>& all() { return items_; }
  bool hasErrors() const;
  bool empty() const { return items_.empty(); }
  // Order of printing: file as added to the map, line, column, code.
  void sort();

private:
  std::vector<Diagnostic> items_;
  std::unordered_map<std::size_t, std::size_t> seen_;    // hash of what was added, to its index
  std::unordered_map<std::size_t, std::uint32_t> alike_; // number by code and file
  Diagnostic dropped_;                                   // what add() gives for one that is not kept
};

// Text form: `file:line:column: severity: message [code]`, the line, a caret. At most `maxErrors` errors
// are printed (0: all); a last line says how many were left out.
std::string renderText(const Diagnostics& diagnostics, const SourceMap& sources, std::uint32_t maxErrors);
// JSON form: one array, as docs/diagnostics.md states it.
std::string renderJson(const Diagnostics& diagnostics, const SourceMap& sources);

} // namespace dotek
