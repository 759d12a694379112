#include "stdlib/StoredTables.h"

#include "stdlib/DataFiles.h"
#include "stdlib/GibbsTables.h"

#include <algorithm>
#include <charconv>
#include <type_traits>

namespace dotek::stdlib {
namespace {

// Both directions walk the same fields(): one field a line.
class Writer {
public:
  static constexpr bool reads = false;
  std::string out;

  template <class... Fields> void operator()(Fields&... each) { (write(each), ...); }

private:
  void write(const std::string& text) {
    if (text.find('\n') != std::string::npos) throw DataError("a text of a keyword table has several lines");
    out += text;
    out += '\n';
  }
  template <class Number>
  requires std::is_integral_v<Number>
  void write(Number number) {
    out += std::to_string(+number);
    out += '\n';
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void write(Enum value) { write(static_cast<int>(value)); }
  template <class T> void write(std::vector<T>& list) {
    write(list.size());
    for (T& each : list)
      write(each);
  }
  // Of a hash map, in the order of names.
  template <class T> void write(NameMap<T>& map) {
    std::vector<std::string_view> names;
    for (const auto& [name, unused] : map)
      names.push_back(name);
    std::sort(names.begin(), names.end());
    write(names.size());
    for (const std::string_view name : names) {
      write(std::string(name));
      write(map.find(name)->second);
    }
  }
  template <class T> void write(std::map<std::string, T, std::less<>>& map) {
    write(map.size());
    for (auto& [name, value] : map) {
      write(name);
      write(value);
    }
  }
  void write(std::set<std::string, std::less<>>& names) {
    write(names.size());
    for (const std::string& name : names)
      write(name);
  }
  template <class T>
  requires(std::is_class_v<T> && !std::is_same_v<T, std::string>) void write(T& value) {
    fields(*this, value);
  }
};

class Reader {
public:
  static constexpr bool reads = true;
  explicit Reader(std::string_view text) : rest_(text) {}

  template <class... Fields> void operator()(Fields&... each) { (read(each), ...); }
  void end() const {
    if (!rest_.empty()) throw DataError("stored keyword tables hold too much");
  }

private:
  std::string_view line() {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) throw DataError("stored keyword tables end too early");
    const std::string_view found = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return found;
  }
  void read(std::string& text) { text = line(); }
  void read(bool& flag) { flag = line() == "1"; }
  template <class Number>
  requires std::is_integral_v<Number>
  void read(Number& number) {
    const std::string_view digits = line();
    if (std::from_chars(digits.data(), digits.data() + digits.size(), number).ec != std::errc())
      throw DataError("stored keyword tables hold a word where a number belongs");
  }
  void read(char& letter) {
    int number = 0;
    read(number);
    letter = static_cast<char>(number);
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void read(Enum& value) {
    int number = 0;
    read(number);
    value = static_cast<Enum>(number);
  }
  // At most what the text can hold.
  std::size_t count() {
    std::size_t number = 0;
    read(number);
    return std::min(number, rest_.size());
  }
  template <class T> void read(std::vector<T>& list) {
    list.resize(count());
    for (T& each : list)
      read(each);
  }
  template <class T> void read(NameMap<T>& map) {
    const std::size_t size = count();
    map.reserve(size);
    for (std::size_t i = 0; i < size; ++i)
      read(map[std::string(line())]);
  }
  template <class T> void read(std::map<std::string, T, std::less<>>& map) {
    for (std::size_t left = count(); left > 0; --left)
      read(map.emplace_hint(map.end(), std::string(line()), T())->second);
  }
  void read(std::set<std::string, std::less<>>& names) {
    for (std::size_t left = count(); left > 0; --left)
      names.emplace_hint(names.end(), line());
  }
  template <class T>
  requires(std::is_class_v<T> && !std::is_same_v<T, std::string>) void read(T& value) {
    fields(*this, value);
  }

  std::string_view rest_;
};

template <class Archive> void fields(Archive& archive, ArgumentSpec& it) {
  // Nearly all arguments are plain: what is usual costs one field.
  unsigned bits = 0;
  if constexpr (!Archive::reads)
    bits = static_cast<unsigned>(it.kind) | static_cast<unsigned>(it.type) << 3U |
           (it.array ? 1U << 5U : 0U) | (it.optional ? 1U << 6U : 0U) | (it.geometry ? 1U << 7U : 0U) |
           (it.repeat != 1 ? 1U << 8U : 0U);
  archive(bits);
  if constexpr (Archive::reads) {
    it.kind = static_cast<ArgumentSpec::Kind>(bits & 7U);
    it.type = static_cast<ArgumentSpec::Type>(bits >> 3U & 3U);
    it.array = (bits & 1U << 5U) != 0;
    it.optional = (bits & 1U << 6U) != 0;
    it.geometry = (bits & 1U << 7U) != 0;
  }
  if ((bits & 1U << 8U) != 0) archive(it.repeat);
  archive(it.name);
  if (it.kind == ArgumentSpec::Kind::Choice) archive(it.keywords);
  if (it.kind == ArgumentSpec::Kind::Parameter) archive(it.family);
}

template <class Archive> void fields(Archive& archive, CommandSignature& it) {
  archive(it.name, it.arguments, it.grade, it.source, it.unsure, it.openKeywords);
}
template <class Archive> void fields(Archive& archive, GibbsKeywords::Tables::Command& it) {
  archive(it.signatures, it.core, it.notes);
}
template <class Archive> void fields(Archive& archive, GibbsKeywords::Tables::Control& it) {
  archive(it.signatures, it.unproved, it.notes);
}
template <class Archive> void fields(Archive& archive, FunctionSpec& it) {
  archive(it.name, it.types, it.result, it.grade, it.source, it.open, it.note);
}
template <class Archive> void fields(Archive& archive, ParameterFamily& it) {
  archive(it.open, it.parameters);
}
template <class Archive> void fields(Archive& archive, CallbackVariable& it) {
  archive(it.name, it.read, it.write, it.where, it.note, it.grade);
}
template <class Archive> void fields(Archive& archive, CursorNames& it) {
  archive(it.snapshot, it.after, it.names, it.advances);
}
template <class Archive> void fields(Archive& archive, SystemMacro& it) {
  archive(it.event, it.when, it.file);
}
template <class Archive> void fields(Archive& archive, GibbsKeywords::Tables& it) {
  archive(it.commands, it.coreWords, it.renamed, it.commandPrefixes, it.controls, it.requiredControls,
          it.firstControl, it.imageSuffix, it.functions, it.families, it.hosts, it.variables, it.constants,
          it.variablePrefixes, it.callbacks, it.cursors, it.cursorOf, it.advances, it.removed, it.reserved,
          it.systemMacros);
}
template <class Archive> void fields(Archive& archive, ComPostKeyword& it) {
  archive(it.name, it.kind, it.argument, it.prints, it.grade, it.source, it.summary);
}

} // namespace

std::string TableStore::store(GibbsKeywords& keywords) {
  Writer writer;
  writer(*keywords.tables_);
  return std::move(writer.out);
}

std::string TableStore::store(ComPostKeywords& keywords) {
  Writer writer;
  writer(keywords.keywords_, keywords.entryPoints_);
  return std::move(writer.out);
}

GibbsKeywords TableStore::restoreGibbs(std::string_view text) {
  GibbsKeywords keywords;
  keywords.tables_ = std::make_unique<GibbsKeywords::Tables>();
  Reader reader(text);
  reader(*keywords.tables_);
  reader.end();
  return keywords;
}

ComPostKeywords TableStore::restoreComPost(std::string_view text) {
  ComPostKeywords keywords;
  Reader reader(text);
  reader(keywords.keywords_, keywords.entryPoints_);
  reader.end();
  return keywords;
}

GibbsKeywords GibbsKeywords::load(const DataFiles& files) {
  const std::vector<const DataFile*> keywords = files.list("keywords");
  const bool own = std::any_of(keywords.begin(), keywords.end(), [](const DataFile* file) {
    return file->name.starts_with("gibbs-") && !file->builtIn();
  });
  const std::string_view stored = embeddedTables().gibbs;
  return own || stored.empty() ? TableStore::readGibbs(files) : TableStore::restoreGibbs(stored);
}

ComPostKeywords ComPostKeywords::load(const DataFiles& files) {
  const DataFile* file = files.find("keywords", "compost");
  const std::string_view stored = embeddedTables().compost;
  return file == nullptr || !file->builtIn() || stored.empty() ? TableStore::readComPost(files)
                                                               : TableStore::restoreComPost(stored);
}

} // namespace dotek::stdlib
