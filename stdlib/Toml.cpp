#include "stdlib/Toml.h"

#include "stdlib/DataFiles.h"
#include "support/Ascii.h"
#include "support/NearestName.h"
#include "support/messages/Commands.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
// toml++ asserts what it refuses a line later: in a debug build hostile text would end the program.
#define TOML_ASSERT(expression) static_cast<void>(0)
#include <toml++/toml.h>
#include <unordered_map>
#include <unordered_set>

namespace dotek::stdlib {
namespace {

constexpr std::int64_t kSchema = 1;
// toml++ nests a table for each dot of a name, without a bound.
constexpr int kDotsPerLine = 1000;

enum class Problem : std::uint8_t { Syntax, UnknownKey, Value };

std::string_view typeName(const toml::node& node) {
  switch (node.type()) {
  case toml::node_type::table: return "a table";
  case toml::node_type::array: return "a list";
  case toml::node_type::string: return "a text";
  case toml::node_type::integer: return "a whole number";
  case toml::node_type::floating_point: return "a number";
  case toml::node_type::boolean: return "true or false";
  default: return "a date or time";
  }
}

const toml::node& nodeOf(const void* node) {
  return *static_cast<const toml::node*>(node);
}

bool isBare(char c) {
  return isDigit(c) || isLetter(c) || c == '_' || c == '-';
}

// Offset of the first line that may hold a name with more than kDotsPerLine parts; npos for none.
std::size_t tooManyDots(std::string_view text) {
  std::size_t lineStart = 0;
  int dots = 0;
  bool chained = false; // only letters and digits since the last dot
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') {
      lineStart = i + 1;
      dots = 0;
      chained = false;
    } else if (c == '.') {
      const bool inNumber = i > 0 && i + 1 < text.size() && isDigit(text[i - 1]) && isDigit(text[i + 1]);
      if ((!inNumber || chained) && ++dots > kDotsPerLine) return lineStart;
      chained = true;
    } else if (!isBare(c)) {
      chained = false;
    }
  }
  return std::string_view::npos;
}

} // namespace

struct TomlState {
  std::string name;      // data file: what DataError says
  std::string_view text; // without byte order mark
  FileId file = kNoFile;
  Diagnostics* diagnostics = nullptr; // nullptr: defects are thrown
  bool trusted = false;               // built in: no guard against hostile text
  bool failed = false;
  toml::table root;
  std::unordered_set<const toml::node*> asked;                           // values that a reader took
  std::unordered_map<const toml::node*, std::vector<std::string>> known; // keys that readers know, by table

  std::vector<std::size_t> lineStarts;     // offsets
  std::vector<std::size_t> lineCharacters; // characters before each line
  std::vector<std::size_t> places;         // offset of each kStride-th character of the text
  static constexpr std::size_t kStride = 64;

  void countCharacters() {
    std::size_t characters = 0;
    bool lineStarted = true;
    for (std::size_t at = 0; at < text.size(); ++at) {
      if (lineStarted) {
        lineStarts.push_back(at);
        lineCharacters.push_back(characters);
      }
      if (lineStarted || !continues(at)) {
        if (characters % kStride == 0) places.push_back(at);
        ++characters;
      }
      lineStarted = text[at] == '\n';
    }
    if (lineStarted) {
      lineStarts.push_back(text.size());
      lineCharacters.push_back(characters);
    }
  }

  // The byte is not the first of its character.
  bool continues(std::size_t at) const { return (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80; }

  // toml++ counts lines by LF and columns in characters.
  std::uint32_t offset(toml::source_position position) {
    if (lineStarts.empty()) countCharacters();
    const std::size_t line = std::min<std::size_t>(std::max(position.line, 1U), lineStarts.size());
    const std::size_t character = lineCharacters[line - 1] + std::max(position.column, 1U) - 1;
    if (character / kStride >= places.size()) return static_cast<std::uint32_t>(text.size());
    std::size_t at = places[character / kStride];
    for (std::size_t rest = character % kStride; rest > 0 && at < text.size(); --rest) {
      ++at;
      while (at < text.size() && continues(at))
        ++at;
    }
    return static_cast<std::uint32_t>(at);
  }

  // Where the line of `at` ends.
  std::uint32_t lineEnd(std::size_t at) const {
    const auto next = std::upper_bound(lineStarts.begin(), lineStarts.end(), at);
    std::size_t end = next == lineStarts.end() ? text.size() : *next - 1;
    if (end > at && text[end - 1] == '\r') --end;
    return static_cast<std::uint32_t>(end);
  }

  // The first line of a region is enough: a table goes on for many.
  SourceRange range(const toml::source_region& region) {
    const std::uint32_t begin = offset(region.begin);
    const std::uint32_t line = lineEnd(begin);
    const std::uint32_t end = std::min(offset(region.end), line);
    return {file, begin, std::max(end, std::min(begin + 1, line))};
  }

  void fail(Problem problem, SourceRange where, const std::string& message) {
    failed = true;
    if (diagnostics == nullptr) {
      const SourceFile source("", std::string(text), Encoding::Utf8);
      const LineColumn place = source.place(where.begin);
      const std::string_view prefix = problem == Problem::Syntax ? "the file is no TOML: " : "";
      throw DataError(fmt::format("{}:{}:{}: {}{}", name, place.line, place.column, prefix, message));
    }
    where.file = file;
    if (problem == Problem::Syntax)
      diagnostics->report<diag::TomlSyntax>(where, message);
    else if (problem == Problem::UnknownKey)
      diagnostics->report<diag::TomlUnknownKey>(where, message);
    else
      diagnostics->report<diag::TomlValue>(where, message);
  }

  bool read() {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    if (const std::size_t at = trusted ? std::string_view::npos : tooManyDots(text);
        at != std::string_view::npos) {
      const auto begin = static_cast<std::uint32_t>(at);
      fail(Problem::Syntax, {file, begin, begin + 1},
           fmt::format("more than {} dots on one line", kDotsPerLine));
      return false;
    }
    try {
      root = toml::parse(text);
      return true;
    } catch (const toml::parse_error& error) {
      std::string_view reason = error.description();
      // "Error while parsing key-value pair: ..." says nothing that the place does not say.
      if (const std::size_t colon = reason.find(": ");
          reason.starts_with("Error while parsing") && colon != std::string_view::npos)
        reason.remove_prefix(colon + 2);
      fail(Problem::Syntax, range(error.source()), std::string(reason));
      return false;
    }
  }

  void reportUnknownKeys(const toml::table& table) {
    const auto keys = known.find(&table);
    if (keys == known.end()) return; // never opened: its defect is reported
    for (const auto& [key, node] : sorted(table)) {
      if (asked.contains(node))
        reportUnknownBelow(*node);
      else
        fail(Problem::UnknownKey, range(key->source()), unknownKey(std::string(key->str()), keys->second));
    }
  }

  void reportUnknownBelow(const toml::node& node) {
    if (const toml::table* table = node.as_table()) reportUnknownKeys(*table);
    if (const toml::array* array = node.as_array()) {
      for (const toml::node& item : *array)
        reportUnknownBelow(item);
    }
  }

  static std::string unknownKey(const std::string& key, std::vector<std::string> keys) {
    const std::string nearest = nearestName(key, keys);
    if (!nearest.empty()) return fmt::format("unknown key `{}`; the nearest known one is `{}`", key, nearest);
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    if (keys.empty()) return fmt::format("unknown key `{}`", key);
    return fmt::format("unknown key `{}`; known here: `{}`", key, fmt::join(keys, "`, `"));
  }

  // toml++ orders keys by name; readers and messages follow the file.
  static std::vector<std::pair<const toml::key*, const toml::node*>> sorted(const toml::table& table) {
    std::vector<std::pair<const toml::key*, const toml::node*>> keys;
    keys.reserve(table.size());
    for (auto it = table.begin(); it != table.end(); ++it)
      keys.emplace_back(&it->first, &it->second);
    std::stable_sort(keys.begin(), keys.end(), [](const auto& a, const auto& b) {
      return a.first->source().begin < b.first->source().begin;
    });
    return keys;
  }
};

SourceRange TomlValue::range() const {
  return node_ == nullptr ? SourceRange{} : state_->range(nodeOf(node_).source());
}
bool TomlValue::isText() const {
  return node_ != nullptr && nodeOf(node_).is_string();
}
bool TomlValue::isNumber() const {
  return node_ != nullptr && nodeOf(node_).is_number();
}
bool TomlValue::isFlag() const {
  return node_ != nullptr && nodeOf(node_).is_boolean();
}
bool TomlValue::isArray() const {
  return node_ != nullptr && nodeOf(node_).is_array();
}
bool TomlValue::isTable() const {
  return node_ != nullptr && nodeOf(node_).is_table();
}

void TomlValue::expect(std::string_view what) const {
  if (node_ == nullptr) return;
  state_->fail(Problem::Value, range(),
               fmt::format("`{}` holds {}; {} is expected", key_, typeName(nodeOf(node_)), what));
}

std::string TomlValue::text(std::string_view fallback) const {
  if (isText()) return nodeOf(node_).as_string()->get();
  expect("a text in quotes");
  return std::string(fallback);
}

std::string TomlValue::choice(const std::vector<std::string_view>& allowed, std::string_view fallback) const {
  if (!isText()) return text(fallback);
  const std::string& given = nodeOf(node_).as_string()->get();
  if (std::find(allowed.begin(), allowed.end(), given) != allowed.end()) return given;
  state_->fail(
      Problem::Value, range(),
      fmt::format("`{}` is \"{}\"; one of \"{}\" is expected", key_, given, fmt::join(allowed, "\", \"")));
  return std::string(fallback);
}

double TomlValue::number(double fallback) const {
  if (isNumber()) {
    const double value = *nodeOf(node_).value<double>();
    if (std::isfinite(value)) return value;
    state_->fail(Problem::Value, range(), fmt::format("`{}` is no finite number", key_));
    return fallback;
  }
  expect("a number");
  return fallback;
}

std::int64_t TomlValue::integer(std::int64_t fallback, std::int64_t least, std::int64_t most) const {
  if (node_ == nullptr || !nodeOf(node_).is_integer()) {
    expect("a whole number");
    return fallback;
  }
  const std::int64_t value = nodeOf(node_).as_integer()->get();
  if (value >= least && value <= most) return value;
  const std::string bounds = most == std::numeric_limits<std::int64_t>::max()
                                 ? fmt::format("{} or more", least)
                                 : fmt::format("{} to {}", least, most);
  state_->fail(Problem::Value, range(), fmt::format("`{}` is {}; {} is expected", key_, value, bounds));
  return fallback;
}

bool TomlValue::flag(bool fallback) const {
  if (isFlag()) return nodeOf(node_).as_boolean()->get();
  expect("true or false");
  return fallback;
}

std::vector<TomlValue> TomlValue::items() const {
  std::vector<TomlValue> out;
  if (!isArray()) {
    expect("a list [...]");
    return out;
  }
  const toml::array& array = *nodeOf(node_).as_array();
  out.reserve(array.size());
  for (const toml::node& item : array)
    out.push_back(TomlValue(state_, &item, key_));
  return out;
}

std::vector<std::string> TomlValue::texts() const {
  std::vector<std::string> out;
  for (const TomlValue& item : items())
    out.push_back(item.text());
  return out;
}

std::vector<double> TomlValue::numbers() const {
  std::vector<double> out;
  for (const TomlValue& item : items())
    out.push_back(item.number());
  return out;
}

TomlTable TomlValue::table() const {
  if (isTable()) return TomlTable(state_, node_);
  expect("a table");
  return {};
}

std::vector<TomlTable> TomlValue::tables() const {
  std::vector<TomlTable> out;
  if (!isArray()) {
    expect("a list of tables");
    return out;
  }
  for (const TomlValue& item : items()) {
    if (item.isTable())
      out.push_back(item.table());
    else
      item.expect("a list of tables");
  }
  return out;
}

TomlTable::TomlTable(std::shared_ptr<TomlState> state, const void* node)
    : state_(std::move(state)), node_(node) {
  state_->known[&nodeOf(node_)]; // an opened table answers for its keys
}

SourceRange TomlTable::range() const {
  return node_ == nullptr ? SourceRange{} : state_->range(nodeOf(node_).source());
}

TomlValue TomlTable::find(std::string_view key, bool ask) const {
  if (node_ == nullptr) return {};
  const toml::table& table = *nodeOf(node_).as_table();
  if (ask) state_->known[&table].emplace_back(key);
  const auto found = table.find(key);
  if (found == table.end()) return {};
  if (ask) state_->asked.insert(&found->second);
  return TomlValue(state_, &found->second, found->first.str());
}

TomlValue TomlTable::require(std::string_view key, std::string_view what) const {
  TomlValue value = this->value(key);
  if (!value && node_ != nullptr)
    state_->fail(Problem::Value, range(), fmt::format("`{}` is missing; {} is expected", key, what));
  return value;
}

std::vector<TomlEntry> TomlTable::entries() const {
  std::vector<TomlEntry> out;
  if (node_ == nullptr) return out;
  for (const auto& [key, node] : TomlState::sorted(*nodeOf(node_).as_table())) {
    state_->asked.insert(node);
    out.push_back(
        {std::string(key->str()), state_->range(key->source()), TomlValue(state_, node, key->str())});
  }
  return out;
}

void TomlDocument::checkSchema(const std::shared_ptr<TomlState>& state) {
  const auto keys = TomlState::sorted(state->root);
  const auto first =
      static_cast<std::uint32_t>(std::min(state->text.find_first_not_of(" \t\r\n"), state->text.size()));
  if (keys.empty() || !state->root.contains("schema")) {
    state->fail(Problem::Value, {state->file, first, first},
                fmt::format("`schema = {}` is missing; it is expected as the first key", kSchema));
  } else if (keys.front().first->str() != "schema") {
    state->fail(Problem::Value, state->range(keys.front().first->source()),
                fmt::format("`{}` is before `schema = {}`, which is expected as the first key",
                            keys.front().first->str(), kSchema));
  } else {
    const TomlValue schema = TomlTable(state, static_cast<const toml::node*>(&state->root)).value("schema");
    if (schema.integer(0) != kSchema && !state->failed)
      state->fail(Problem::Value, schema.range(),
                  fmt::format("`schema` is {}; this version of dotek reads {}", schema.integer(), kSchema));
  }
}

TomlDocument TomlDocument::parse(const DataFile& file) {
  auto state = std::make_shared<TomlState>();
  state->name = file.builtIn() ? fmt::format("{}/{}.toml", file.folder, file.name) : file.origin;
  state->text = file.text;
  state->trusted = file.builtIn();
  state->read();
  checkSchema(state);
  return TomlDocument(std::move(state));
}

std::optional<TomlDocument> TomlDocument::parse(FileId file, const SourceMap& sources,
                                                Diagnostics& diagnostics) {
  auto state = std::make_shared<TomlState>();
  state->text = sources.file(file).bytes();
  state->file = file;
  state->diagnostics = &diagnostics;
  if (!state->read()) return std::nullopt;
  checkSchema(state);
  if (state->failed) return std::nullopt;
  return TomlDocument(std::move(state));
}

TomlTable TomlDocument::root() const {
  return TomlTable(state_, static_cast<const toml::node*>(&state_->root));
}

void TomlDocument::fail(SourceRange range, const std::string& message) const {
  state_->fail(Problem::Value, range, message);
}

bool TomlDocument::finish() const {
  state_->reportUnknownKeys(state_->root);
  return ok();
}

bool TomlDocument::ok() const {
  return !state_->failed;
}

} // namespace dotek::stdlib
