#include "lint/Baseline.h"

#include "support/Fingerprint.h"
#include "support/Printable.h"
#include "support/WholeName.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace dotek::lint {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSchema = 1;

namespace fs = std::filesystem;

// Of the baseline.
fs::path folderOf(const std::string& path) {
  return fs::path(wholeName(path.empty() ? "baseline" : path)).parent_path();
}

// Equal lines count alike, whichever is the first of them.
std::string withoutNumber(const std::string& fingerprint) {
  return fingerprint.substr(0, fingerprint.find(':'));
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
    Held held;
    if (const auto places = one.find("places"); places != one.end()) {
      held.places.emplace();
      if (!places->is_array() ||
          !std::all_of(places->begin(), places->end(), [](const Json& place) { return place.is_string(); })) {
        reason = "`places` of a finding is no array of texts";
        return std::nullopt;
      }
      for (const Json& place : *places)
        held.places->push_back(place.get<std::string>());
    }
    // What is of no file has no name.
    const std::string name = file->empty() ? "" : wholeName((folder / *file).generic_string());
    if (held.places) ++out.places_[{name, *code, withoutNumber(*fingerprint)}];
    for (const std::string& place : held.places.value_or(std::vector<std::string>()))
      ++out.places_[{name, *code, place}];
    out.held_.emplace(Key{name, *code, *fingerprint}, std::move(held));
  }
  return out;
}

Baseline::Key Baseline::keyOf(const Diagnostic& one, const SourceMap& sources, std::string fingerprint) {
  if (!one.range.hasPlace()) return {"", std::string(one.code), asUtf8(one.message)};
  return {asUtf8(wholeName(sources.file(one.range.file).name())), std::string(one.code),
          std::move(fingerprint)};
}

// A finding may list further places as notes. Those of other files say where the other half of it is.
std::vector<std::string> Baseline::placesOf(const Diagnostic& one, const SourceMap& sources) {
  std::vector<std::string> out;
  for (const DiagnosticNote& note : one.notes)
    if (note.range.hasPlace() && note.range.file == one.range.file)
      out.push_back(fingerprintOf(one.code, note.range, sources));
  std::sort(out.begin(), out.end());
  return out;
}

std::string Baseline::render(const Diagnostics& findings, const SourceMap& sources, const std::string& path,
                             const Baseline& before, const Judged& judged) {
  const fs::path folder = folderOf(path);
  Json rows = Json::array();
  const auto add = [&](const Key& key, const std::optional<std::vector<std::string>>& places) {
    const auto& [file, code, fingerprint] = key;
    Json row;
    row["file"] = file.empty() ? file : fs::path(file).lexically_relative(folder).generic_string();
    row["code"] = code;
    row["fingerprint"] = fingerprint;
    if (places) row["places"] = *places;
    rows.push_back(std::move(row));
  };
  Fingerprints fingerprints;
  for (const Diagnostic& one : findings.all())
    add(keyOf(one, sources, one.range.hasPlace() ? fingerprints.of(one, sources) : ""),
        placesOf(one, sources));
  for (const auto& [key, held] : before.held_)
    if (!judged(std::get<0>(key), std::get<1>(key))) add(key, held.places);
  Json document;
  document["schema"] = kSchema;
  document["findings"] = std::move(rows);
  return escapeMarks(document.dump(1, ' ', false, Json::error_handler_t::replace)) + "\n";
}

void Baseline::passOver(Diagnostics& findings, const SourceMap& sources) {
  Fingerprints fingerprints;
  std::erase_if(findings.all(), [&](const Diagnostic& one) {
    if (!holds(keyOf(one, sources, one.range.hasPlace() ? fingerprints.of(one, sources) : ""),
               placesOf(one, sources)))
      return false;
    ++passedOver_;
    return true;
  });
}

bool Baseline::holds(const Key& key, const std::vector<std::string>& places) {
  const auto& [file, code, fingerprint] = key;
  const auto [begin, end] = held_.equal_range(key);
  const auto same = std::find_if(begin, end, [](const auto& one) { return !one.second.found; });
  // It is there still, even where it has a place more.
  if (same != end) {
    same->second.found = true;
    if (!same->second.places) {
      if (!places.empty()) ++passedBlindly_;
      return true;
    }
  }
  std::map<Key, std::size_t> needed;
  ++needed[{file, code, withoutNumber(fingerprint)}];
  for (const std::string& place : places)
    ++needed[{file, code, place}];
  const auto left = [&](const auto& one) {
    const auto at = places_.find(one.first);
    return at != places_.end() && at->second >= one.second;
  };
  if (!std::all_of(needed.begin(), needed.end(), left)) return false;
  for (const auto& [place, count] : needed)
    places_[place] -= count;
  return true;
}

std::size_t Baseline::gone(const Judged& judged) const {
  return static_cast<std::size_t>(std::count_if(held_.begin(), held_.end(), [&](const auto& one) {
    return !one.second.found && judged(std::get<0>(one.first), std::get<1>(one.first));
  }));
}

std::size_t Baseline::others(const Judged& judged) const {
  return static_cast<std::size_t>(std::count_if(held_.begin(), held_.end(), [&](const auto& one) {
    return !one.second.found && !judged(std::get<0>(one.first), std::get<1>(one.first));
  }));
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
