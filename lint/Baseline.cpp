#include "lint/Baseline.h"

#include "support/Fingerprint.h"
#include "support/Printable.h"

#include <nlohmann/json.hpp>

namespace dotek::lint {
namespace {

using Json = nlohmann::ordered_json;
using Key = std::tuple<std::string, std::string, std::string>;

constexpr int kSchema = 1;

// `fingerprints` has met the findings before it.
Key keyOf(const Diagnostic& one, const SourceMap& sources, Fingerprints& fingerprints) {
  if (!one.range.hasPlace()) return {"", std::string(one.code), asUtf8(one.message)};
  return {asUtf8(sources.file(one.range.file).name()), std::string(one.code), fingerprints.of(one, sources)};
}

} // namespace

std::optional<Baseline> Baseline::read(std::string_view text, std::string& reason) {
  const Json document = Json::parse(text, nullptr, false);
  if (document.is_discarded() || !document.is_object()) {
    reason = "it is no JSON object";
    return std::nullopt;
  }
  const auto schema = document.find("schema"), findings = document.find("findings");
  if (schema == document.end() || *schema != kSchema || findings == document.end() || !findings->is_array()) {
    reason = "`schema` is not 1, or `findings` is no array";
    return std::nullopt;
  }
  Baseline out;
  for (const Json& one : *findings) {
    const auto textAt = [&](const char* name) -> std::optional<std::string> {
      const auto at = one.is_object() ? one.find(name) : one.end();
      if (!one.is_object() || at == one.end() || !at->is_string()) return std::nullopt;
      return at->get<std::string>();
    };
    const auto file = textAt("file"), code = textAt("code"), fingerprint = textAt("fingerprint");
    if (!file || !code || !fingerprint) {
      reason = "a finding of it has no `file`, `code` or `fingerprint`";
      return std::nullopt;
    }
    ++out.held_[{*file, *code, *fingerprint}];
  }
  return out;
}

std::string Baseline::render(const Diagnostics& findings, const SourceMap& sources) {
  Json rows = Json::array();
  Fingerprints fingerprints;
  for (const Diagnostic& one : findings.all()) {
    const auto [file, code, fingerprint] = keyOf(one, sources, fingerprints);
    Json row;
    row["file"] = file;
    row["code"] = code;
    row["fingerprint"] = fingerprint;
    rows.push_back(std::move(row));
  }
  Json document;
  document["schema"] = kSchema;
  document["findings"] = std::move(rows);
  return escapeMarks(document.dump(1, ' ', false, Json::error_handler_t::replace)) + "\n";
}

void Baseline::passOver(Diagnostics& findings, const SourceMap& sources) {
  Fingerprints fingerprints;
  std::erase_if(findings.all(), [&](const Diagnostic& one) {
    const auto at = held_.find(keyOf(one, sources, fingerprints));
    if (at == held_.end() || at->second == 0) return false;
    --at->second;
    ++passedOver_;
    return true;
  });
}

std::size_t Baseline::gone() const {
  std::size_t out = 0;
  for (const auto& [key, count] : held_)
    out += count;
  return out;
}

} // namespace dotek::lint
