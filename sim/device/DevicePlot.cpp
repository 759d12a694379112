// Curves of a device's report as SVG.
#include "sim/device/DeviceReport.h"

#include "support/Decimal.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace dotek::sim {
namespace {

constexpr double kWidth = 760, kHeight = 260, kLeft = 70, kRight = 20, kTop = 34, kBottom = 42;

struct Curve {
  std::string name, colour;
  std::vector<std::pair<double, double>> points;
  std::string title = {}; // the name and the direction
};

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text)
    out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

// A step of 1, 2 or 5 that gives five to ten parts.
double stepOf(double width) {
  const double base = std::pow(10.0, std::floor(std::log10(width / 5)));
  for (const double factor : {1.0, 2.0, 5.0, 10.0})
    if (width / (base * factor) <= 10) return base * factor;
  return base * 10;
}

void plot(std::string& out, double top, std::string_view title, std::string_view unit,
          const std::vector<Curve>& curves, const std::vector<double>& marks) {
  double left = 0, right = 0, low = 0, high = 0;
  bool first = true;
  for (const Curve& curve : curves)
    for (const auto& [x, y] : curve.points) {
      left = first ? x : std::min(left, x), right = first ? x : std::max(right, x);
      low = std::min(low, y), high = std::max(high, y);
      first = false;
    }
  for (const double mark : marks)
    low = std::min(low, mark), high = std::max(high, mark);
  if (right <= left) right = left + 1;
  if (high <= low) high = low + 1;
  const double pad = (high - low) * 0.06;
  low -= pad, high += pad;
  const double wide = kWidth - kLeft - kRight, tall = kHeight - kTop - kBottom;
  const auto px = [&](double x) { return fixedText(kLeft + (x - left) / (right - left) * wide, 2); };
  const auto py = [&](double y) { return fixedText(top + kTop + (high - y) / (high - low) * tall, 2); };
  out += fmt::format("<text x=\"{}\" y=\"{}\" class=\"t\">{}</text>\n", kLeft, top + 18, escaped(title));
  const double xStep = stepOf(right - left), yStep = stepOf(high - low);
  for (double y = std::ceil(low / yStep) * yStep; y <= high + 1e-12; y += yStep)
    out += fmt::format(
        "<line x1=\"{0}\" x2=\"{1}\" y1=\"{2}\" y2=\"{2}\" class=\"g\"/><text x=\"{3}\" y=\"{2}\" "
        "class=\"n\" text-anchor=\"end\" dy=\"4\">{4}</text>\n",
        kLeft, kWidth - kRight, py(y), kLeft - 6,
        numberText(std::round(y / yStep) * yStep + 0.0 == 0
                       ? 0
                       : std::round(std::round(y / yStep) * yStep * 1e9) / 1e9));
  for (double x = std::ceil(left / xStep) * xStep; x <= right + 1e-9; x += xStep)
    out += fmt::format(
        "<line x1=\"{0}\" x2=\"{0}\" y1=\"{1}\" y2=\"{2}\" class=\"g\"/><text x=\"{0}\" y=\"{3}\" "
        "class=\"n\" text-anchor=\"middle\">{4}</text>\n",
        px(x), fixedText(top + kTop, 2), fixedText(top + kHeight - kBottom, 2),
        fixedText(top + kHeight - kBottom + 15, 2), numberText(std::round(x / xStep) * xStep));
  for (const double mark : marks)
    out += fmt::format("<line x1=\"{}\" x2=\"{}\" y1=\"{}\" y2=\"{}\" class=\"m\"/>\n", kLeft,
                       kWidth - kRight, py(mark), py(mark));
  double legend = kWidth - kRight;
  for (auto curve = curves.rbegin(); curve != curves.rend(); ++curve) {
    std::string points;
    for (const auto& [x, y] : curve->points)
      points += (points.empty() ? "" : " ") + px(x) + "," + py(y);
    out += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"/>\n", points,
                       curve->colour);
    out += fmt::format("<text x=\"{}\" y=\"{}\" class=\"l\" text-anchor=\"end\" fill=\"{}\">{}</text>\n",
                       legend, top + 18, curve->colour, escaped(curve->title));
    legend -= 7.0 * static_cast<double>(curve->title.size()) + 18;
  }
  out += fmt::format("<text x=\"{}\" y=\"{}\" class=\"n\">{}</text><text x=\"{}\" y=\"{}\" class=\"n\" "
                     "text-anchor=\"end\">position, mm</text>\n",
                     8, top + kTop - 8, escaped(unit), kWidth - kRight, top + kHeight - kBottom + 32);
}

// A curve that lies on one of another direction would hide it: that one is for both.
void add(std::vector<Curve>& curves, Curve curve, const std::string& way) {
  const auto same = std::find_if(curves.begin(), curves.end(), [&](const Curve& one) {
    return one.name == curve.name && one.points == curve.points;
  });
  if (same != curves.end()) {
    same->title = curve.name + ", both ways";
    return;
  }
  curve.title = curve.name + way;
  curves.push_back(std::move(curve));
}

} // namespace

std::string devicePicture(const Device& device) {
  static constexpr std::string_view kBefore[] = {"#b03a2e", "#d68910"}, kAfter[] = {"#1e6b3a", "#1f618d"};
  const DeviceFile& file = device.file();
  std::vector<Curve> errors, values;
  std::size_t at = 0;
  for (const DeviceRule& rule : file.rules) {
    const std::vector<Compared> all = compare(device, rule);
    if (all.empty()) continue;
    const std::string way = rule.moving == DeviceMoving::Plus    ? " +"
                            : rule.moving == DeviceMoving::Minus ? " -"
                                                                 : "";
    Curve before{"before", std::string(kBefore[at % 2]), {}}, after{"after", std::string(kAfter[at % 2]), {}};
    Curve value{file.values[rule.value].title, std::string(kAfter[at % 2]), {}};
    for (const Compared& one : all) {
      before.points.emplace_back(one.position, one.before);
      after.points.emplace_back(one.position, one.after);
      value.points.emplace_back(one.position, one.value);
    }
    add(errors, std::move(before), way);
    add(errors, std::move(after), way);
    add(values, std::move(value), way);
    ++at;
  }
  if (errors.empty()) return "";
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "font-family=\"sans-serif\">\n<style>.t{{font-size:14px;font-weight:bold}}.n{{font-size:11px;fill:#444}"
      "}"
      ".l{{font-size:12px}}.g{{stroke:#ddd}}.m{{stroke:#999;stroke-dasharray:5 4}}</style>\n<rect "
      "width=\"100%\" "
      "height=\"100%\" fill=\"white\"/>\n",
      kWidth, 2 * kHeight + 10);
  std::vector<double> marks = {0};
  if (file.report.limit > 0) marks.insert(marks.end(), {file.report.limit, -file.report.limit});
  if (file.report.tolerance > 0) marks.insert(marks.end(), {file.report.tolerance, -file.report.tolerance});
  plot(out, 0, "Deviation", "mm", errors, marks);
  plot(out, kHeight + 10, "Set by the device", file.values[file.rules.front().value].unit, values, {});
  return out + "</svg>\n";
}

} // namespace dotek::sim
