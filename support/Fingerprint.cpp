#include "support/Fingerprint.h"

#include <algorithm>

namespace dotek {
namespace {

// Text of the line that the finding begins on, blanks left out.
std::string lineOf(SourceRange range, const SourceMap& sources) {
  const std::string_view text = sources.file(range.file).bytes();
  const std::size_t at = std::min<std::size_t>(range.begin, text.size());
  const std::size_t before = at == 0 ? std::string_view::npos : text.rfind('\n', at - 1);
  const std::size_t begin = before == std::string_view::npos ? 0 : before + 1;
  std::string out;
  for (const char c : text.substr(begin, std::min(text.find('\n', at), text.size()) - begin))
    if (c != ' ' && c != '\t' && c != '\r') out += c;
  return out;
}

// FNV-1a, 64 bits: the same on every machine.
std::uint64_t hash(std::string_view text) {
  std::uint64_t out = 14695981039346656037U;
  for (const char c : text)
    out = (out ^ static_cast<unsigned char>(c)) * 1099511628211U;
  return out;
}

} // namespace

std::string fingerprintOf(std::string_view code, SourceRange place, const SourceMap& sources) {
  return fmt::format("{:016x}", hash(std::string(code) + '\n' + lineOf(place, sources)));
}

std::string Fingerprints::of(const Diagnostic& finding, const SourceMap& sources) {
  const std::string key = fingerprintOf(finding.code, finding.range, sources);
  const std::uint32_t order = seen_[{finding.range.file, key}]++;
  return fmt::format("{}:{}", key, order + 1);
}

} // namespace dotek
