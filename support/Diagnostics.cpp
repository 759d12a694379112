#include "support/Diagnostics.h"

#include "support/messages/Common.h"

#include <algorithm>
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

namespace {

std::size_t alikeKey(std::string_view code, FileId file) {
  return std::hash<std::string_view>{}(code) ^ (std::size_t{file} + 1) * 0x9E3779B97F4A7C15u;
}

bool same(const Diagnostic& a, const Diagnostic& b) {
  return a.code == b.code && a.range == b.range && a.message == b.message;
}

} // namespace

Diagnostic& Diagnostics::add(Diagnostic diagnostic) {
  const std::size_t hash = std::hash<std::string_view>{}(diagnostic.code) ^
                           std::hash<std::string>{}(diagnostic.message) * 31 ^
                           (std::size_t{diagnostic.range.begin} << 20) * 0x9E3779B97F4A7C15u;
  const auto [at, isNew] = seen_.try_emplace(hash, items_.size());
  if (!isNew) {
    if (at->second < items_.size() && same(items_[at->second], diagnostic)) return items_[at->second];
    // all() was sorted or thinned out, or two hashes are alike.
    const auto found = std::find_if(items_.begin(), items_.end(),
                                    [&](const Diagnostic& other) { return same(other, diagnostic); });
    if (found != items_.end()) return *found;
  }
  std::uint32_t& number = alike_[alikeKey(diagnostic.code, diagnostic.range.file)];
  if (number >= kMostAlike) {
    seen_.erase(hash);
    const bool error = diagnostic.severity == Severity::Error;
    dropped_ = std::move(diagnostic);
    if (number == kMostAlike) {
      items_.push_back(makeDiagnostic<diag::TooManyFindings>(dropped_.range, kMostAlike, dropped_.code));
      if (error) items_.back().severity = Severity::Error;
    }
    number = kMostAlike + 1;
    return dropped_;
  }
  ++number;
  items_.push_back(std::move(diagnostic));
  return items_.back();
}

bool Diagnostics::full(std::string_view code, FileId file) const {
  const auto at = alike_.find(alikeKey(code, file));
  return at != alike_.end() && at->second > kMostAlike;
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
