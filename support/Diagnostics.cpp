#include "support/Diagnostics.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace dotek {

std::string_view severityName(Severity severity) {
  switch (severity) {
  case Severity::Note: return "note";
  case Severity::Warning: return "warning";
  case Severity::Error: return "error";
  }
  return "";
}

std::span<const MessageInfo> messageTable() {
  static const auto kTable = [] {
    std::array table = {
#define DOTEK_DIAGNOSTIC(Id, codeText, severityId, formatText, explanationText)                              \
  MessageInfo{codeText, Severity::severityId, explanationText},
#include "support/Diagnostics.def"
#undef DOTEK_DIAGNOSTIC
    };
    std::sort(table.begin(), table.end(),
              [](const MessageInfo& a, const MessageInfo& b) { return a.code < b.code; });
    return table;
  }();
  return kTable;
}

Diagnostic& Diagnostics::add(Diagnostic diagnostic) {
  const std::size_t hash = std::hash<std::string_view>{}(diagnostic.code) ^
                           std::hash<std::string>{}(diagnostic.message) * 31 ^
                           (std::size_t{diagnostic.range.begin} << 20) * 0x9E3779B97F4A7C15u;
  if (seen_.insert(hash).second) {
    items_.push_back(std::move(diagnostic));
    return items_.back();
  }
  const auto same = std::find_if(items_.begin(), items_.end(), [&](const Diagnostic& other) {
    return other.code == diagnostic.code && other.range == diagnostic.range &&
           other.message == diagnostic.message;
  });
  if (same != items_.end()) return *same;
  items_.push_back(std::move(diagnostic));
  return items_.back();
}

bool Diagnostics::hasErrors() const {
  return std::any_of(items_.begin(), items_.end(),
                     [](const Diagnostic& d) { return d.severity == Severity::Error; });
}

void Diagnostics::sort() {
  std::stable_sort(items_.begin(), items_.end(), [](const Diagnostic& a, const Diagnostic& b) {
    // kNoFile sorts last; begin orders line and column alike.
    return std::tie(a.range.file, a.range.begin, a.code) < std::tie(b.range.file, b.range.begin, b.code);
  });
}

} // namespace dotek
