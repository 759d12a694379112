// Strict reading of TOML: data files of stdlib/ and files of the user (jobs, parts, machines).
//
//   std::optional<TomlDocument> job = TomlDocument::parse(file, sources, diagnostics);
//   if (!job) return;
//   const TomlTable root = job->root();
//   const std::int64_t number = root.value("program").table().value("number").integer(0, 1, 9999);
//   for (const TomlTable& operation : root.value("operation").tables()) ...
//   if (!job->finish()) return;
//
// Every key that was never asked for is an error of finish(); so are its tables. Values, tables and
// documents are cheap handles that share one parsed file.
#pragma once

#include "support/Diagnostics.h"
#include "support/Source.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::stdlib {

struct DataFile;
class TomlTable;

// Shared state of one document; its definition, and all of toml++, stays in Toml.cpp.
struct TomlState;

// A value, or the absence of one. The getters give `fallback` where the value is absent, and where it is of
// another type, which is reported ("`clearance` is a text; a number is expected").
class TomlValue {
public:
  TomlValue() = default;

  explicit operator bool() const { return node_ != nullptr; }
  SourceRange range() const; // without a place where absent
  bool isText() const;
  bool isNumber() const; // whole or not
  bool isFlag() const;
  bool isArray() const;
  bool isTable() const;

  std::string text(std::string_view fallback = "") const;
  // A text of a fixed set; another one is reported with the set.
  std::string choice(const std::vector<std::string_view>& allowed, std::string_view fallback = "") const;
  // Finite; whole numbers count.
  double number(double fallback = 0) const;
  std::int64_t integer(std::int64_t fallback = 0,
                       std::int64_t least = std::numeric_limits<std::int64_t>::min(),
                       std::int64_t most = std::numeric_limits<std::int64_t>::max()) const;
  bool flag(bool fallback = false) const;
  // Elements of an array, of any type.
  std::vector<TomlValue> items() const;
  std::vector<std::string> texts() const;
  std::vector<double> numbers() const;
  // Empty table where absent.
  TomlTable table() const;
  // An array of tables: [[name]] or name = [{...}].
  std::vector<TomlTable> tables() const;

private:
  friend class TomlTable;
  friend class TomlDocument;
  TomlValue(std::shared_ptr<TomlState> state, const void* node, std::string_view key)
      : state_(std::move(state)), node_(node), key_(key) {}
  void expect(std::string_view what) const;

  std::shared_ptr<TomlState> state_;
  const void* node_ = nullptr; // toml::node
  std::string_view key_;       // the key it is under
};

struct TomlEntry {
  std::string key;
  SourceRange keyRange;
  TomlValue value;
};

class TomlTable {
public:
  TomlTable() = default;

  SourceRange range() const; // its header or opening brace
  bool has(std::string_view key) const { return static_cast<bool>(find(key, false)); }
  // Absent value where the table has no such key.
  TomlValue value(std::string_view key) const { return find(key, true); }
  // A missing key is reported: "`cycle` is missing: the name of a cycle is expected".
  TomlValue require(std::string_view key, std::string_view what) const;
  // All keys, in the order of the file; for tables whose keys are names. Counts as asking for each.
  std::vector<TomlEntry> entries() const;

private:
  friend class TomlValue;
  friend class TomlDocument;
  TomlTable(std::shared_ptr<TomlState> state, const void* node);
  TomlValue find(std::string_view key, bool ask) const;

  std::shared_ptr<TomlState> state_;
  const void* node_ = nullptr; // toml::table
};

class TomlDocument {
public:
  // Data file: every defect throws DataError, "forms/x.toml:3:1: unknown key `y`". `file.text` outlives it.
  static TomlDocument parse(const DataFile& file);
  // File of the user: every defect is reported at its place. nullopt where the text is no TOML or lacks
  // `schema = 1`. `sources` and `diagnostics` outlive the document.
  static std::optional<TomlDocument> parse(FileId file, const SourceMap& sources, Diagnostics& diagnostics);

  TomlTable root() const;
  // Reports a defect of meaning at a place of this file.
  void fail(SourceRange range, const std::string& message) const;
  // Reports the keys that nobody asked for. False where anything was reported since parse().
  bool finish() const;
  bool ok() const;

private:
  explicit TomlDocument(std::shared_ptr<TomlState> state) : state_(std::move(state)) {}
  static void checkSchema(const std::shared_ptr<TomlState>& state);
  std::shared_ptr<TomlState> state_;
};

} // namespace dotek::stdlib
