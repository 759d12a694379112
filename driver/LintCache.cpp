#include "driver/LintCache.h"

#include "driver/Command.h"
#include "driver/LintSeen.h"
#include "lint/Rule.h"
#include "stdlib/DataFiles.h"
#include "support/Files.h"
#include "support/Output.h"
#include "support/Sha256.h"
#include "support/messages/Lint.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace dotek::driver {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::size_t kSum = 64;  // digits of a SHA-256 before a kept result: a torn file is none
constexpr int kLayout = 1;        // of a kept result
constexpr std::size_t kMost = 64; // results of a folder
constexpr std::size_t kMostBytes = 64U << 20U; // of one

// Bytes of any encoding: JSON as text has only UTF-8.
Json bytesOf(std::string_view text) {
  return Json::binary({text.begin(), text.end()});
}

std::string textOf(const Json& bytes) {
  const auto& binary = bytes.get_binary();
  return {binary.begin(), binary.end()};
}

Json placeOf(const SourceRange& range) {
  return Json::array({range.file, range.begin, range.end});
}

// A place that the sources have; throws std::exception for another.
SourceRange placeIn(const Json& json, const SourceMap& sources) {
  SourceRange out{json.at(0).get<FileId>(), json.at(1).get<std::uint32_t>(), json.at(2).get<std::uint32_t>()};
  if (out.hasPlace() &&
      (out.file >= sources.size() || out.begin > out.end || out.end > sources.file(out.file).bytes().size()))
    throw std::out_of_range("place");
  return out;
}

std::string_view knownCode(const std::string& code) {
  const auto table = lint::codeTable();
  const auto at =
      std::find_if(table.begin(), table.end(), [&](const lint::CodeInfo& one) { return one.code == code; });
  if (at == table.end()) throw std::out_of_range("code");
  return at->code;
}

Json keptFix(const Fix& fix) {
  Json edits = Json::array();
  for (const Edit& edit : fix.edits)
    edits.push_back({placeOf(edit.range), bytesOf(edit.text)});
  return {{"safe", fix.applicability == Fix::Applicability::Safe},
          {"title", bytesOf(fix.title)},
          {"edits", std::move(edits)}};
}

Fix fixOf(const Json& json, const SourceMap& sources) {
  Fix out;
  if (json.at("safe").get<bool>()) out.applicability = Fix::Applicability::Safe;
  out.title = textOf(json.at("title"));
  for (const Json& edit : json.at("edits"))
    out.edits.push_back({placeIn(edit.at(0), sources), textOf(edit.at(1))});
  return out;
}

Json keptFinding(const Diagnostic& one) {
  Json notes = Json::array();
  for (const DiagnosticNote& note : one.notes)
    notes.push_back({placeOf(note.range), bytesOf(note.message)});
  Json out = {{"code", one.code},
              {"severity", static_cast<int>(one.severity)},
              {"place", placeOf(one.range)},
              {"message", bytesOf(one.message)},
              {"notes", std::move(notes)}};
  if (one.fix) out["fix"] = keptFix(*one.fix);
  return out;
}

Diagnostic findingOf(const Json& json, const SourceMap& sources) {
  Diagnostic out;
  out.code = knownCode(json.at("code").get<std::string>());
  const int severity = json.at("severity").get<int>();
  if (severity < 0 || severity > static_cast<int>(Severity::Error)) throw std::out_of_range("severity");
  out.severity = static_cast<Severity>(severity);
  out.range = placeIn(json.at("place"), sources);
  out.message = textOf(json.at("message"));
  for (const Json& note : json.at("notes"))
    out.notes.push_back({placeIn(note.at(0), sources), textOf(note.at(1))});
  if (json.contains("fix")) out.fix = fixOf(json.at("fix"), sources);
  return out;
}

class Cache {
public:
  Cache(const LintOptions& options, const LintCache& cache) : options_(options), cache_(cache) {
    std::error_code error;
    const std::string key =
        sha256(cache.command + '\0' + cache.build + '\0' + fs::current_path(error).string());
    path_ = (fs::path(cache.folder) / ("." + key + ".lint")).string();
  }

  Outcome run() {
    std::error_code error;
    fs::create_directories(cache_.folder, error);
    if (error) return unkept(lint(options_), error.message());
    std::string why;
    const std::optional<LintSeen> seen = LintSeen::of(options_, why);
    if (!seen) return unkept(lint(options_), why);
    if (std::optional<Outcome> kept = find(*seen)) return std::move(*kept);
    Outcome outcome = lint(options_);
    if (outcome.status > 1) return outcome; // what was not done is tried again
    const std::optional<Json> sources = keptSources(outcome, *seen, why);
    if (!sources) return unkept(std::move(outcome), why);
    const std::optional<LintSeen> after = LintSeen::of(options_, why);
    if (!after || after->digest() != seen->digest()) return outcome; // somebody edits: the next run keeps it
    return keep(std::move(outcome), *sources, *seen);
  }

private:
  static Outcome unkept(Outcome outcome, const std::string& why) {
    outcome.diagnostics.report<diag::LintNotKept>({}, why);
    return outcome;
  }

  // nullopt: there is none of these files, or it cannot be read.
  std::optional<Outcome> find(const LintSeen& seen) const {
    std::error_code error;
    if (!fs::is_regular_file(path_, error)) return std::nullopt;
    Diagnostics ignored;
    const std::optional<std::string> bytes = readBeginning(path_, kMostBytes, ignored);
    if (!bytes) return std::nullopt;
    if (bytes->size() < kSum || sha256(bytes->substr(kSum)) != bytes->substr(0, kSum)) return std::nullopt;
    const Json json =
        Json::from_cbor(bytes->begin() + static_cast<std::ptrdiff_t>(kSum), bytes->end(), true, false);
    if (json.is_discarded()) return std::nullopt;
    try {
      if (json.at("layout") != kLayout || json.at("seen") != seen.digest()) return std::nullopt;
      Outcome out;
      out.status = json.at("status").get<int>();
      out.summary = textOf(json.at("summary"));
      for (const Json& one : json.at("sources"))
        if (!addSource(one, out.sources)) return std::nullopt;
      for (const Json& one : json.at("findings"))
        out.diagnostics.all().push_back(findingOf(one, out.sources));
      return out;
    } catch (const std::exception&) { // written by something else
      return std::nullopt;
    }
  }

  // false: it is another text than it was.
  static bool addSource(const Json& one, SourceMap& sources) {
    const std::string name = textOf(one.at("name"));
    const std::optional<Encoding> encoding = encodingByName(one.at("encoding").get<std::string>());
    if (!encoding) return false;
    std::optional<std::string> bytes;
    Diagnostics ignored;
    if (one.contains("text"))
      bytes = textOf(one.at("text"));
    else
      bytes = readBeginning(name, UINT32_MAX, ignored);
    if (!bytes) return false;
    SourceFile file(name, std::move(*bytes), *encoding);
    if (!one.contains("text") && sha256(file.bytes()) != one.at("sha256").get<std::string>()) return false;
    sources.add(std::move(file));
    return true;
  }

  // nullopt: one was read that the next run would not look at.
  std::optional<Json> keptSources(const Outcome& outcome, const LintSeen& seen, std::string& why) const {
    Json out = Json::array();
    for (FileId id = 0; id < outcome.sources.size(); ++id) {
      const SourceFile& file = outcome.sources.file(id);
      Json one = {{"name", bytesOf(file.name())}, {"encoding", encodingName(file.encoding())}};
      std::error_code error;
      if (!fs::exists(file.name(), error))
        one["text"] = bytesOf(file.bytes()); // of the program itself
      else if (!seen.contains(file.name()))
        return outside(file.name(), why);
      else
        one["sha256"] = sha256(file.bytes());
      out.push_back(std::move(one));
    }
    stdlib::DataFiles data;
    Diagnostics ignored;
    for (const std::string& path : options_.common.data)
      data.addFolder(path, options_.common.limits, ignored);
    for (const stdlib::DataFile* file : data.list("controls"))
      if (!file->builtIn() && !seen.contains(file->origin)) return outside(file->origin, why);
    return out;
  }

  static std::optional<Json> outside(const std::string& path, std::string& why) {
    why = fmt::format("`{}` was read, which is in none of the folders that are looked at for changes", path);
    return std::nullopt;
  }

  Outcome keep(Outcome outcome, const Json& sources, const LintSeen& seen) const {
    Json findings = Json::array();
    for (const Diagnostic& one : outcome.diagnostics.all())
      findings.push_back(keptFinding(one));
    const Json all = {{"layout", kLayout},        {"seen", seen.digest()},
                      {"status", outcome.status}, {"summary", bytesOf(outcome.summary)},
                      {"sources", sources},       {"findings", std::move(findings)}};
    std::string body;
    Json::to_cbor(all, body);
    const std::string text = sha256(body) + body;
    if (text.size() > kMostBytes) return unkept(std::move(outcome), "there are too many findings");
    Diagnostics writing;
    dropOldest();
    if (!writeAll({{path_, &text}}, "", {}, writing))
      return unkept(std::move(outcome), writing.empty() ? path_ : writing.all().front().message);
    return outcome;
  }

  // Of command lines that nobody types any more.
  void dropOldest() const {
    std::vector<std::pair<fs::file_time_type, fs::path>> kept;
    std::error_code error;
    for (fs::directory_iterator at(cache_.folder, error), end; !error && at != end; at.increment(error)) {
      std::error_code one;
      if (LintSeen::isKept(at->path().filename().string()) && at->is_regular_file(one))
        kept.emplace_back(at->last_write_time(one), at->path());
    }
    if (kept.size() < kMost) return;
    std::sort(kept.begin(), kept.end());
    for (std::size_t i = 0; i + kMost <= kept.size(); ++i)
      fs::remove(kept[i].second, error);
  }

  const LintOptions& options_;
  const LintCache& cache_;
  std::string path_; // of the result
};

} // namespace

Outcome lint(const LintOptions& options, const LintCache& cache) {
  return caught([&] { return Cache(options, cache).run(); });
}

} // namespace dotek::driver
