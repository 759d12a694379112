#include "sim/device/ErrorTable.h"

#include "support/Decimal.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <vector>

namespace dotek::sim {
namespace {

constexpr std::string_view kBlanks = " \t\r\"";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

std::vector<std::string_view> cellsOf(std::string_view line, char separator) {
  std::vector<std::string_view> out;
  for (std::size_t begin = 0;;) {
    const std::size_t end = line.find(separator, begin);
    out.push_back(trimmed(line.substr(begin, end - begin)));
    if (end == std::string_view::npos) return out;
    begin = end + 1;
  }
}

// The two points of a sorted map that enclose `at`, and the share of the second.
template <class Map> auto around(const Map& map, double at) {
  auto after = map.lower_bound(at);
  if (after == map.end()) --after;
  auto before = after;
  if (after->first > at && after != map.begin()) --before;
  const double width = after->first - before->first;
  const double share = width > 0 ? std::clamp((at - before->first) / width, 0.0, 1.0) : 0.0;
  return std::tuple(before, after, share);
}

double inRow(const std::map<double, double>& row, double value) {
  const auto [before, after, share] = around(row, value);
  return before->second + (after->second - before->second) * share;
}

} // namespace

std::optional<double> leadingNumber(std::string_view text) {
  std::size_t end = 0;
  while (end < text.size() &&
         (text[end] == '.' || text[end] == '-' || text[end] == '+' || (text[end] >= '0' && text[end] <= '9')))
    ++end;
  return parseNumber(text.substr(0, end));
}

std::string ErrorTable::addCsv(std::string_view text) {
  std::vector<std::string_view> header;
  std::vector<std::optional<double>> values; // of the columns, where the table has one for each value
  char separator = ',';
  std::size_t number = 0;
  bool some = false;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = trimmed(text.substr(begin, end - begin));
    begin = end + 1;
    ++number;
    if (line.empty() || line.front() == '#') continue;
    if (header.empty()) {
      if (line.find(',') == std::string_view::npos && line.find(';') != std::string_view::npos)
        separator = ';';
      header = cellsOf(line, separator);
      for (const std::string_view cell : header)
        values.push_back(leadingNumber(cell));
      if (header.size() < 2) return fmt::format("line {}: a position and an error are expected", number);
      const bool wide = std::all_of(values.begin() + 1, values.end(), [](const auto& v) { return v; });
      if (!wide) values.clear();
      if (!wide && header.size() > 3)
        return fmt::format("line {}: the columns are a position and one for each value, or position, value, "
                           "error; the header names neither",
                           number);
      if (wide && values.front())
        return fmt::format("line {}: the first line names the columns; this one holds numbers", number);
      continue;
    }
    const std::vector<std::string_view> cells = cellsOf(line, separator);
    if (cells.size() > header.size())
      return fmt::format("line {}: {} cells under {} columns", number, cells.size(), header.size());
    std::vector<std::optional<double>> numbers;
    for (const std::string_view cell : cells) {
      numbers.push_back(parseNumber(cell));
      if (!cell.empty() && !numbers.back())
        return fmt::format("line {}: `{}` is no number", number, std::string(cell));
    }
    if (!numbers.front()) return fmt::format("line {}: the position is missing", number);
    if (values.empty()) {
      if (numbers.size() != header.size() || !numbers.back() || !numbers[numbers.size() - 2])
        return fmt::format("line {}: a cell is missing", number);
      add(*numbers.front(), numbers.size() == 3 ? *numbers[1] : 0, *numbers.back());
      some = true;
      continue;
    }
    for (std::size_t i = 1; i < numbers.size(); ++i)
      if (numbers[i]) add(*numbers.front(), *values[i], *numbers[i]), some = true;
  }
  return some ? "" : "it holds no point";
}

double ErrorTable::at(double position, double value) const {
  if (rows_.empty()) return 0;
  const auto [before, after, share] = around(rows_, position);
  const double first = inRow(before->second, value);
  return first + (inRow(after->second, value) - first) * share;
}

bool ErrorTable::covers(double position, double value) const {
  if (rows_.empty() || position < rows_.begin()->first || position > rows_.rbegin()->first) return false;
  const auto [before, after, share] = around(rows_, position);
  const auto holds = [&](const std::map<double, double>& row) {
    return row.size() == 1 || (value >= row.begin()->first && value <= row.rbegin()->first);
  };
  return holds(before->second) && (share == 0 || holds(after->second));
}

} // namespace dotek::sim
