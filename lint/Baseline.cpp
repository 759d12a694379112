#include "lint/Baseline.h"

#include "support/Fingerprint.h"
#include "support/Printable.h"
#include "support/WholeName.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

namespace dotek::lint {
namespace {

using Json = nlohmann::ordered_json;
using Key = std::tuple<std::string, std::string, std::string>;

constexpr int kSchema = 1;

namespace fs = std::filesystem;

// Of the baseline.
fs::path folderOf(const std::string& path) {
  return fs::path(wholeName(path.empty() ? "baseline" : path)).parent_path();
}

// `fingerprints` has met the findings before it.
Key keyOf(const Diagnostic& one, const SourceMap& sources, Fingerprints& fingerprints) {
  if (!one.range.hasPlace()) return {"", std::string(one.code), asUtf8(one.message)};
  return {asUtf8(wholeName(sources.file(one.range.file).name())), std::string(one.code),
          fingerprints.of(one, sources)};
}

} // namespace

std::optional<Baseline> Baseline::read(std::string_view text, std::string& reason, const std::string& path) {
  const fs::path folder = folderOf(path);
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
    // What is of no file has no name.
    ++out.held_[{file->empty() ? std::string() : wholeName((folder / *file).generic_string()), *code,
                 *fingerprint}];
  }
  return out;
}

std::string Baseline::render(const Diagnostics& findings, const SourceMap& sources, const std::string& path,
                             const Baseline& before, const Judged& judged) {
  const fs::path folder = folderOf(path);
  std::vector<Key> keys;
  Fingerprints fingerprints;
  for (const Diagnostic& one : findings.all())
    keys.push_back(keyOf(one, sources, fingerprints));
  for (const auto& [key, count] : before.held_)
    if (!judged(std::get<0>(key), std::get<1>(key))) keys.insert(keys.end(), count, key);
  Json rows = Json::array();
  for (const auto& [file, code, fingerprint] : keys) {
    Json row;
    row["file"] = file.empty() ? file : fs::path(file).lexically_relative(folder).generic_string();
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

std::size_t Baseline::gone(const Judged& judged) const {
  std::size_t out = 0;
  for (const auto& [key, count] : held_)
    if (count > 0 && judged(std::get<0>(key), std::get<1>(key))) out += count;
  return out;
}

std::size_t Baseline::others(const Judged& judged) const {
  std::size_t out = 0;
  for (const auto& [key, count] : held_)
    if (count > 0 && !judged(std::get<0>(key), std::get<1>(key))) out += count;
  return out;
}

bool Baseline::isOfOthers(const SourceMap& sources) const {
  for (FileId id = 0; id < sources.size(); ++id) {
    const auto at = held_.lower_bound({asUtf8(wholeName(sources.file(id).name())), "", ""});
    if (at != held_.end() && std::get<0>(at->first) == asUtf8(wholeName(sources.file(id).name())))
      return false;
  }
  return !held_.empty();
}

} // namespace dotek::lint
