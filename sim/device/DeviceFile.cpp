#include "sim/device/DeviceFile.h"

#include "sim/machine/Arguments.h"
#include "sim/machine/Trace.h"
#include "stdlib/Toml.h"
#include "support/Decimal.h"
#include "support/messages/Commands.h"
#include "support/messages/Common.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <utility>

namespace dotek::sim {

using stdlib::TomlDocument;
using stdlib::TomlTable;
using stdlib::TomlValue;

namespace {

constexpr std::int64_t kMostNumber = 999'999;

class Reader {
public:
  using ReadFile = std::function<std::optional<std::string>(const std::string& name, SourceRange where)>;
  Reader(const TomlDocument& document, ReadFile readFile)
      : document_(document), readFile_(std::move(readFile)) {}

  DeviceFile file() {
    const TomlTable root = document_.root();
    out_.title = root.value("title").text();
    out_.seed = static_cast<std::uint64_t>(root.value("seed").integer(1, 0));
    if (root.has("window")) window(root.value("window").table());
    for (const TomlTable& table : root.value("value").tables())
      value(table);
    for (const TomlTable& table : root.value("call").tables())
      call(table);
    for (const TomlTable& table : root.value("table").tables())
      rows(table);
    for (const TomlTable& table : root.value("rule").tables())
      rule(table);
    for (const TomlTable& table : root.value("error").tables())
      error(table);
    for (const TomlTable& table : root.value("signal").tables()) {
      DeviceSignal one;
      one.cell = cell(table.require("cell", "where the program reads it"));
      table.require("is", "\"touching\"").choice({"touching"}, "touching");
      out_.signals.push_back(one);
    }
    if (root.has("report")) report(root.value("report").table());
    return std::move(out_);
  }

private:
  void fail(SourceRange range, const std::string& what) { document_.fail(range, what); }

  std::uint32_t number(const TomlTable& table, std::string_view key, std::string_view what,
                       std::int64_t least = 0) {
    return static_cast<std::uint32_t>(table.require(key, what).integer(least, least, kMostNumber));
  }

  void window(const TomlTable& table) {
    stdlib::PmcWindow out;
    out.area = table.value("area").text("R");
    out.bytes = static_cast<std::uint32_t>(table.value("bytes").integer(10'000, 1, 1'000'000));
    out.address = number(table, "address", "the variable that chooses the address", 1);
    out.byte = static_cast<std::uint32_t>(table.value("byte").integer(0, 0, kMostNumber));
    out.word = static_cast<std::uint32_t>(table.value("word").integer(0, 0, kMostNumber));
    out.doubleWord = static_cast<std::uint32_t>(table.value("double_word").integer(0, 0, kMostNumber));
    out_.window = out;
  }

  DeviceCell cell(const TomlValue& at) {
    DeviceCell out;
    const TomlTable table = at.table();
    if (table.has("variable") == table.has("address")) {
      fail(at.range(), "either `variable` (a system variable) or `address` (beyond the window) is expected");
      return out;
    }
    out.variable = static_cast<std::uint32_t>(table.value("variable").integer(0, 1000, kMostNumber));
    if (table.has("variable")) return out;
    out.address = static_cast<std::uint32_t>(table.value("address").integer(0, 0, kMostNumber));
    const std::string size = table.value("size").choice({"byte", "word", "double"}, "byte");
    out.bytes = size == "byte" ? 1 : size == "word" ? 2 : 4;
    if (table.has("bit"))
      out.bit = static_cast<std::uint32_t>(table.value("bit").integer(0, 0, 8 * out.bytes - 1));
    return out;
  }

  void value(const TomlTable& table) {
    DeviceValue out;
    out.name = table.require("name", "how the other tables call it").text();
    out.title = table.value("title").text(out.name);
    out.unit = table.value("unit").text();
    out.initial = table.value("initial").number(0);
    out.perUnit = table.value("counts_per_unit").number(0);
    if (table.value("counts_per_unit") && !(out.perUnit > 0))
      fail(table.value("counts_per_unit").range(), "more than 0 counts for a unit are expected");
    if (const TomlValue range = table.value(out.perUnit > 0 ? "counts" : "range")) {
      const std::vector<double> ends = range.numbers();
      if (ends.size() == 2 && ends[0] < ends[1])
        out.range = {ends[0], ends[1]};
      else
        fail(range.range(), "two numbers [least, most] are expected");
    }
    if (std::any_of(out_.values.begin(), out_.values.end(),
                    [&](const auto& v) { return v.name == out.name; }))
      fail(table.range(), fmt::format("two values are called `{}`", out.name));
    out_.values.push_back(out);
  }

  template <class List> std::size_t named(const List& list, const TomlValue& name, std::string_view what) {
    const std::string text = name.text();
    for (std::size_t i = 0; i < list.size(); ++i)
      if (list[i].name == text) return i;
    if (name) fail(name.range(), fmt::format("no {} is called `{}`", what, text));
    return 0;
  }

  static std::uint32_t localOf(std::string_view letter) {
    return letter.size() == 1 ? ArgumentLetters().next(letter[0]) : 0;
  }

  void call(const TomlTable& table) {
    DeviceCall out;
    const TomlValue code = table.require("code", "\"G5101\", \"M160\"");
    out.name = code.text();
    const std::optional<double> number =
        out.name.empty() ? std::nullopt : parseNumber(std::string_view(out.name).substr(1));
    if (!number || (out.name[0] != 'G' && out.name[0] != 'M') || *number < 0 || *number > 9999 ||
        *number != std::floor(*number)) {
      if (code) fail(code.range(), "G or M and a number are expected");
      return;
    }
    out.code.letter = out.name[0];
    out.code.first = static_cast<std::uint32_t>(*number);
    out.code.program = static_cast<std::uint32_t>(table.value("program").integer(0, 1, 9999));
    out.settle = table.value("settle").number(0);
    for (const auto& entry : table.value("sets").table().entries()) {
      const std::string letter = entry.value.text();
      if (localOf(letter) == 0) fail(entry.value.range(), "the letter of an argument is expected");
      std::size_t at = 0;
      while (at < out_.values.size() && out_.values[at].name != entry.key)
        ++at;
      if (at == out_.values.size()) fail(entry.keyRange, fmt::format("no value is called `{}`", entry.key));
      out.sets.emplace_back(localOf(letter), at);
    }
    for (const auto& entry : table.value("when").table().entries()) {
      if (localOf(entry.key) == 0) fail(entry.keyRange, "the letter of an argument is expected");
      out.when.emplace_back(localOf(entry.key), entry.value.number());
    }
    out_.calls.push_back(out);
  }

  void rows(const TomlTable& table) {
    DeviceTable out;
    out.name = table.require("name", "how the other tables call it").text();
    out.strobe = cell(table.require("strobe", "the cell that tells the device to take a row"));
    out.strobeValue = table.value("strobe_value").number(1);
    out.index = cell(table.require("index", "the cell with the number of the row"));
    out.first = static_cast<std::uint32_t>(table.value("first").integer(1, 0, 9999));
    out.last = static_cast<std::uint32_t>(
        table.require("last", "the number of the last row").integer(out.first, out.first, 9999));
    out.hold = table.value("hold").number(0);
    for (const TomlTable& one : table.require("column", "what a row holds").tables())
      out.columns.push_back({one.require("name", "how a rule calls it").text(),
                             cell(one.require("cell", "where the program writes it")),
                             one.value("scale").number(1)});
    out_.tables.push_back(out);
  }

  std::size_t axis(const TomlValue& letter) {
    const std::size_t found = std::string("XYZ").find(letter.text("Z"));
    if (found < 3 && letter.text("Z").size() == 1) return found;
    fail(letter.range(), "X, Y or Z is expected");
    return 0;
  }

  DeviceAxis along(const TomlTable& table) {
    DeviceAxis out;
    const TomlTable at = table.require("along", "{ axis = \"Z\", zero = 0.0 }").table();
    out.axis = axis(at.require("axis", "X, Y or Z"));
    out.zero = at.value("zero").number(0);
    return out;
  }

  DeviceMoving moving(const TomlTable& table) {
    const std::string text = table.value("moving").choice({"any", "plus", "minus"}, "any");
    return text == "plus" ? DeviceMoving::Plus : text == "minus" ? DeviceMoving::Minus : DeviceMoving::Any;
  }

  double nonZero(const TomlTable& table, std::string_view key, std::string_view what) {
    const TomlValue value = table.require(key, what);
    const double out = value.number(1);
    if (value && out == 0) fail(value.range(), "a number other than 0 is expected");
    return out == 0 ? 1 : out;
  }

  void rule(const TomlTable& table) {
    DeviceRule out;
    out.value = named(out_.values, table.require("sets", "the value that it sets"), "value");
    out.table = named(out_.tables, table.require("table", "the table that it reads"), "table");
    if (!out_.tables.empty()) {
      const auto& columns = out_.tables[out.table].columns;
      out.start = named(columns, table.require("start", "the column with the value of a row"), "column");
      out.slope = named(columns, table.require("slope", "the column with what it grows by in a mm of path"),
                        "column");
    }
    out.along = along(table);
    out.from = table.require("from", "the position of the first row").number();
    out.step = nonZero(table, "step", "from one row to the next");
    out.moving = moving(table);
    if (!out_.values.empty() && !out_.tables.empty() && !out_.tables[out.table].columns.empty())
      out_.rules.push_back(out);
  }

  void error(const TomlTable& table) {
    DeviceError out;
    out.axis = axis(table.require("axis", "the axis whose reading is wrong"));
    out.along = along(table);
    out.moving = moving(table);
    if (const TomlValue value = table.value("value")) out.value = named(out_.values, value, "value");
    if (out_.values.empty()) out.value.reset();
    out.noise = table.value("noise").number(0);
    for (const TomlValue& name : table.value("files").items()) {
      const std::optional<std::string> text = readFile_(name.text(), name.range());
      if (!text) continue;
      if (const std::string wrong = out.table.addCsv(*text); !wrong.empty())
        fail(name.range(), fmt::format("`{}`: {}", name.text(), wrong));
    }
    for (const TomlValue& point : table.value("points").items()) {
      const std::vector<double> n = point.numbers();
      if (n.size() == 3 || (n.size() == 2 && !out.value))
        out.table.add(n[0], n.size() == 3 ? n[1] : 0, n.back());
      else
        fail(point.range(),
             "[position, value, error] is expected, or [position, error] where no value corrects it");
    }
    if (out.table.isEmpty()) fail(table.range(), "the error has no points: `files` or `points` gives them");
    out_.errors.push_back(std::move(out));
  }

  // One column of a CSV text, by its header or as the last.
  std::vector<double> expected(const TomlValue& name, const std::string& text) {
    std::vector<double> out;
    const std::string header = text.substr(0, text.find('\n'));
    std::size_t column = 0;
    const std::size_t wanted = header.find(name.table().require("column", "the header of a column").text());
    if (wanted == std::string::npos)
      fail(name.range(), "the file has no such column");
    else
      column = static_cast<std::size_t>(
          std::count(header.begin(), header.begin() + static_cast<long>(wanted), ','));
    for (std::size_t begin = text.find('\n'); begin != std::string::npos && begin + 1 < text.size();) {
      std::size_t end = std::min(text.find('\n', begin + 1), text.size());
      std::string line = text.substr(begin + 1, end - begin - 1);
      while (!line.empty() && line.back() == '\r')
        line.pop_back();
      begin = end;
      if (line.empty()) continue;
      std::size_t cellBegin = 0;
      for (std::size_t i = 0; i < column && cellBegin != std::string::npos; ++i)
        cellBegin = line.find(',', cellBegin) == std::string::npos ? std::string::npos
                                                                   : line.find(',', cellBegin) + 1;
      const std::optional<double> value =
          cellBegin == std::string::npos
              ? std::nullopt
              : parseNumber(line.substr(cellBegin, line.find(',', cellBegin) - cellBegin));
      if (!value) fail(name.range(), fmt::format("`{}` holds no number there", line));
      out.push_back(value.value_or(0));
    }
    return out;
  }

  void report(const TomlTable& table) {
    DeviceReportPlan& out = out_.report;
    out.notes = table.value("notes").texts();
    if (const TomlValue compare = table.value("compare")) {
      const TomlTable one = compare.table();
      out.from = one.require("from", "the first position").number();
      out.to = one.require("to", "the last position").number();
      out.step = nonZero(one, "step", "from one position to the next");
      out.limit = one.value("limit").number(0);
      out.tolerance = one.value("tolerance").number(0);
      if ((out.to - out.from) / out.step < 0 || (out.to - out.from) / out.step > 10'000)
        fail(compare.range(), "0 to 10000 steps lead from `from` to `to`");
    }
    for (const TomlTable& one : table.value("table").tables()) {
      DeviceReportPlan::Table made;
      made.title = one.value("title").text();
      made.note = one.value("note").text();
      made.rows = static_cast<std::uint32_t>(one.require("rows", "how many rows").integer(1, 1, 1000));
      made.from = one.value("from").number(1);
      made.each = one.value("step").number(1);
      for (const TomlTable& column : one.require("column", "its columns").tables()) {
        DeviceReportPlan::Column c;
        c.title = column.require("title", "its head").text();
        c.first = number(column, "first", "the variable of the first row", 1);
        c.step = static_cast<std::uint32_t>(column.value("each").integer(1, 1, 1000));
        if (const TomlValue wanted = column.value("expected")) {
          const TomlValue name = wanted.table().require("file", "a CSV file");
          c.source = name.text();
          if (const auto text = readFile_(c.source, name.range())) c.expected = expected(wanted, *text);
        }
        made.columns.push_back(std::move(c));
      }
      out.tables.push_back(std::move(made));
    }
  }

  const TomlDocument& document_;
  ReadFile readFile_;
  DeviceFile out_;
};

} // namespace

void DeviceFile::extend(stdlib::Control& control) {
  if (window) control.window = window;
  std::uint32_t free = 9990; // of codes that the control does not list and the file gives no program for
  for (DeviceCall& call : calls) {
    if (const stdlib::CallCode* known =
            findCallCode(control, call.code.letter, static_cast<double>(call.code.first))) {
      call.code.program = known->program + call.code.first - known->first;
      continue;
    }
    if (call.code.program == 0) call.code.program = free++;
    control.callCodes.push_back(call.code);
  }
}

bool DeviceFile::usesWindow() const {
  const auto beyond = [](const DeviceCell& cell) { return cell.variable == 0; };
  return std::any_of(signals.begin(), signals.end(), [&](const auto& one) { return beyond(one.cell); }) ||
         std::any_of(tables.begin(), tables.end(), [&](const DeviceTable& one) {
           return beyond(one.strobe) || beyond(one.index) ||
                  std::any_of(one.columns.begin(), one.columns.end(),
                              [&](const auto& column) { return beyond(column.cell); });
         });
}

std::optional<DeviceFile> loadDevice(const std::string& path, const Limits& limits, const ReadBounds& bounds,
                                     SourceMap& sources, Diagnostics& diagnostics) {
  const std::optional<FileId> id = readText(path, Encoding::Utf8, std::nullopt, limits, sources, diagnostics);
  if (!id) return std::nullopt;
  const std::optional<TomlDocument> document = TomlDocument::parse(*id, sources, diagnostics);
  if (!document) return std::nullopt;
  const std::size_t slash = path.rfind('/');
  const std::string folder = slash == std::string::npos ? "" : path.substr(0, slash + 1);
  const auto readFile = [&](const std::string& name, SourceRange where) -> std::optional<std::string> {
    const std::string file = name.starts_with('/') ? name : folder + name;
    if (!bounds.allow(file)) {
      diagnostics.report<diag::IncludeOutside>(where, file, bounds.text(), folderName(file));
      return std::nullopt;
    }
    if (isStream(file)) { // a FIFO would block, and nobody named it on the command line
      diagnostics.report<diag::FileNotReadable>(where, file, "it is no regular file");
      return std::nullopt;
    }
    sources.add(SourceFile(file, "", Encoding::Utf8)); // no text, but a file that was read
    return readBytes(file, limits, diagnostics);
  };
  DeviceFile out = Reader(*document, readFile).file();
  if (!document->finish()) return std::nullopt;
  return out;
}

} // namespace dotek::sim
