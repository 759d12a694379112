// The table of what was measured, of both pictures.
#include "sim/machine/Value.h"
#include "sim/picture/PictureReport.h"
#include "sim/picture/PictureText.h"
#include "support/Decimal.h"
#include "support/Printable.h"

#include <cmath>
#include <fmt/format.h>

namespace dotek::sim {
namespace {

constexpr std::size_t kMostSvg = 60, kMostHtml = 1000; // rows
constexpr std::size_t kMostSvgLines = 40;              // of a list

struct Row {
  std::string name, nominal, measured, deviation;
};

class Table {
public:
  explicit Table(int decimals) : decimals_(decimals) {}

  std::string number(double value) const {
    return std::isfinite(value) ? fixedText(value, decimals_) : std::string("?");
  }
  std::string signedNumber(double value) const {
    const std::string out = number(value);
    return value > 0 && out.find_first_of("123456789") != std::string::npos ? "+" + out : out;
  }
  Row row(const MeasuredValue& value) const {
    const char* const unit = value.kind == ir::Kind::Angle ? "\xC2\xB0" : "";
    const auto nominal = [&] { return value.nominal ? number(*value.nominal) + unit : std::string("-"); };
    if (isNull(value.measured)) return {value.name, nominal(), "empty", "-"};
    if (value.kind == ir::Kind::Flag) return {value.name, "-", value.measured == 0 ? "no" : "yes", "-"};
    Row out{value.name, nominal(), number(value.measured) + unit, "-"};
    if (value.nominal) out.deviation = signedNumber(value.measured - *value.nominal) + unit;
    return out;
  }
  std::string offset(const OffsetWrite& write, const PictureMeasured& of) const {
    return fmt::format("{} set from {} to {} ({}){}", write.name, number(write.before), number(write.after),
                       signedNumber(write.after - write.before), of.afterMiss ? ", after a miss" : "");
  }
  static std::string title(const PictureMeasured& one) {
    if (one.found.title.empty()) return "offsets written";
    // Where the machine stopped: the surface is a radius farther on.
    if (one.missed) return one.found.title + ": end of the move, no surface";
    return one.found.title.starts_with("touch ") ? one.found.title + ", skip position" : one.found.title;
  }
  static std::string place(const PictureMeasured& one) {
    std::string out = one.found.program == 0 ? "" : fmt::format("O{:04}", one.found.program);
    for (const std::string& part : {one.block.place, one.system.empty() ? "" : "in " + one.system})
      if (!part.empty()) out += (out.empty() ? "" : ", ") + part;
    return out;
  }

private:
  int decimals_;
};

} // namespace

std::string measuredText(const std::vector<PictureMeasured>& measured, std::size_t leftOut, int decimals,
                         const std::string& control) {
  if (measured.empty()) return "";
  const Table table(decimals);
  std::string out = control.empty() ? "" : "run on " + control + "\n";
  out += fmt::format("{:<30} {:>12} {:>12} {:>12}\n", "measured, mm", "nominal", "measured", "deviation");
  for (const PictureMeasured& one : measured) {
    out += fmt::format("{} ({})\n", printable(Table::title(one)), printable(Table::place(one)));
    for (const MeasuredValue& value : one.found.values) {
      const Row row = table.row(value);
      out += fmt::format("  {:<28} {:>12} {:>12} {:>12}\n", printable(row.name), row.nominal, row.measured,
                         row.deviation);
    }
    for (const OffsetWrite& write : one.offsets)
      out += "  " + table.offset(write, one) + "\n";
  }
  if (leftOut > 0) out += fmt::format("and {} more\n", leftOut);
  return out;
}

std::string measuredSvg(const Picture& picture, double left, double& at) {
  if (picture.measured.empty()) return "";
  const Table table(picture.decimals);
  constexpr double kRow = 18;
  constexpr const char* kNumber = "text-anchor=\"end\" font-family=\"Consolas, DejaVu Sans Mono, monospace\"";
  std::string out = "<g id=\"measured\" fill=\"#20262d\">\n";
  const auto text = [&](double x, const std::string& what, const char* style) {
    out += fmt::format("<text x=\"{}\" y=\"{}\" {}>{}</text>", shortNumber(left + x, 2), shortNumber(at, 2),
                       style, xmlText(what, 90));
  };
  const auto cells = [&](const Row& row, const char* style) {
    text(18, row.name, "");
    text(250, row.nominal, style);
    text(370, row.measured, style);
    text(490, row.deviation, style);
    out += '\n';
    at += kRow;
  };
  at += 16;
  text(0, "Measured", "font-size=\"14\" font-weight=\"bold\"");
  constexpr const char* kHead = "text-anchor=\"end\" fill=\"#4a525c\"";
  text(250, "nominal", kHead);
  text(370, "measured", kHead);
  text(490, "deviation", kHead);
  out += '\n';
  at += kRow + 3;
  std::size_t rows = 0, shown = 0;
  for (const PictureMeasured& one : picture.measured) {
    if (rows > kMostSvg) break;
    text(0, fmt::format("{}  ", Table::title(one)),
         one.missed ? "font-weight=\"bold\" fill=\"#a80b22\"" : "font-weight=\"bold\"");
    text(one.missed ? 370 : 250, Table::place(one), "fill=\"#4a525c\"");
    out += '\n';
    at += kRow;
    for (const MeasuredValue& value : one.found.values)
      cells(table.row(value), kNumber);
    for (const OffsetWrite& write : one.offsets) {
      text(18, table.offset(write, one), one.afterMiss ? "fill=\"#a80b22\"" : "fill=\"#0a529a\"");
      out += '\n';
      at += kRow;
    }
    rows += 1 + one.found.values.size() + one.offsets.size();
    ++shown;
    at += 3;
  }
  if (shown < picture.measured.size()) {
    text(0, fmt::format("and {} more; the page lists them", picture.measured.size() - shown), "");
    at += kRow;
  }
  return out + "</g>\n";
}

std::string listsSvg(const Picture& picture, double left, double& at) {
  std::string out;
  const auto text = [&](double x, const std::string& what, const char* style) {
    out += fmt::format("<text x=\"{}\" y=\"{}\" {}>{}</text>\n", shortNumber(left + x, 2), shortNumber(at, 2),
                       style, xmlText(what, 120));
    at += 17;
  };
  for (const PictureList& list : picture.lists) {
    out += fmt::format("<g id=\"{}\" fill=\"#20262d\">\n", list.id);
    at += 18;
    text(0, list.title, "font-size=\"14\" font-weight=\"bold\"");
    at += 3;
    for (std::size_t i = 0; i < list.lines.size() && i < kMostSvgLines; ++i)
      text(18, list.lines[i], "xml:space=\"preserve\" font-family=\"Consolas, DejaVu Sans Mono, monospace\"");
    if (list.lines.size() > kMostSvgLines)
      text(18, fmt::format("and {} lines more; the page lists them", list.lines.size() - kMostSvgLines), "");
    out += "</g>\n";
  }
  return out;
}

std::string listsHtml(const Picture& picture) {
  std::string out;
  for (const PictureList& list : picture.lists) {
    out += fmt::format("<section id=\"{}\" class=\"list\">\n<h2>{}</h2>\n<pre>", list.id,
                       xmlText(list.title, 100));
    for (std::size_t i = 0; i < list.lines.size() && i < kMostHtml; ++i)
      out += xmlText(list.lines[i], 400) + "\n";
    out += "</pre>\n";
    if (list.lines.size() > kMostHtml)
      out += fmt::format("<p>and {} lines more</p>\n", list.lines.size() - kMostHtml);
    out += "</section>\n";
  }
  return out;
}

std::string measuredHtml(const Picture& picture, const std::function<std::size_t(std::size_t)>& place) {
  if (picture.measured.empty()) return "";
  const Table table(picture.decimals);
  std::string out =
      "<section id=\"measured\">\n<h2>Measured</h2>\n<table>\n<thead><tr><th>mm</th><th>nominal</th>"
      "<th>measured</th><th>deviation</th></tr></thead>\n<tbody>\n";
  std::size_t shown = 0;
  for (const PictureMeasured& one : picture.measured) {
    if (shown == kMostHtml) break;
    ++shown;
    out += fmt::format("<tr class=\"feature{}\"><th colspan=\"4\"><button data-move=\"{}\">{}</button> "
                       "<small>{}</small></th></tr>\n",
                       one.missed ? " missed" : "", place(one.move), xmlText(Table::title(one), 200),
                       xmlText(Table::place(one), 300));
    for (const MeasuredValue& value : one.found.values) {
      const Row row = table.row(value);
      out += fmt::format("<tr><th>{}</th><td>{}</td><td>{}</td><td>{}</td></tr>\n", xmlText(row.name),
                         row.nominal, row.measured, row.deviation);
    }
    for (const OffsetWrite& write : one.offsets)
      out += fmt::format("<tr class=\"offset{}\"><td colspan=\"4\">{}</td></tr>\n",
                         one.afterMiss ? " missed" : "", xmlText(table.offset(write, one)));
  }
  if (shown < picture.measured.size())
    out += fmt::format("<tr><th colspan=\"4\">and {} more</th></tr>\n", picture.measured.size() - shown);
  return out + "</tbody></table>\n</section>\n";
}

} // namespace dotek::sim
