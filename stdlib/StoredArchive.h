// How stored tables are written and read: text of one field a line. Private to Stored*.cpp.
#pragma once

#include "stdlib/DataFiles.h"
#include "stdlib/GibbsTables.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace dotek::stdlib {

// Both directions walk the same fields(): one field a line.
class StoredWriter {
public:
  static constexpr bool reads = false;
  std::string out;

  template <class... Fields> void operator()(Fields&... each) { (write(each), ...); }

private:
  void write(const std::string& text) {
    if (text.find('\n') != std::string::npos) throw DataError("a text of a stored table has several lines");
    out += text;
    out += '\n';
  }
  template <class Number>
  requires std::is_integral_v<Number>
  void write(Number number) {
    out += std::to_string(+number);
    out += '\n';
  }
  // The shortest text that reads back as the same number.
  void write(double number) {
    char digits[32];
    out.append(digits, std::to_chars(std::begin(digits), std::end(digits), number).ptr);
    out += '\n';
  }
  template <class T> void write(std::optional<T>& value) {
    write(value.has_value());
    if (value) write(*value);
  }
  template <class A, class B> void write(std::pair<A, B>& pair) {
    write(pair.first);
    write(pair.second);
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
  template <class Less> void write(std::set<std::string, Less>& names) {
    write(names.size());
    for (const std::string& name : names)
      write(name);
  }
  template <class T>
  requires(std::is_class_v<T> && !std::is_same_v<T, std::string>) void write(T& value) {
    fields(*this, value);
  }
};

class StoredReader {
public:
  static constexpr bool reads = true;
  explicit StoredReader(std::string_view text) : rest_(text) {}

  template <class... Fields> void operator()(Fields&... each) { (read(each), ...); }
  void end() const {
    if (!rest_.empty()) throw DataError("stored tables hold too much");
  }

private:
  std::string_view line() {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) throw DataError("stored tables end too early");
    const std::string_view found = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return found;
  }
  void read(std::string& text) { text = line(); }
  void read(bool& flag) { flag = line() == "1"; }
  template <class Number>
  requires(std::is_integral_v<Number> || std::is_floating_point_v<Number>) void read(Number& number) {
    const std::string_view digits = line();
    if (std::from_chars(digits.data(), digits.data() + digits.size(), number).ec != std::errc())
      throw DataError("stored tables hold a word where a number belongs");
  }
  void read(char& letter) {
    int number = 0;
    read(number);
    letter = static_cast<char>(number);
  }
  template <class T> void read(std::optional<T>& value) {
    bool given = false;
    read(given);
    if (given)
      read(value.emplace());
    else
      value.reset();
  }
  template <class A, class B> void read(std::pair<A, B>& pair) {
    read(pair.first);
    read(pair.second);
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
  template <class Less> void read(std::set<std::string, Less>& names) {
    for (std::size_t left = count(); left > 0; --left)
      names.emplace_hint(names.end(), line());
  }
  template <class T>
  requires(std::is_class_v<T> && !std::is_same_v<T, std::string>) void read(T& value) {
    fields(*this, value);
  }

  std::string_view rest_;
};

} // namespace dotek::stdlib
