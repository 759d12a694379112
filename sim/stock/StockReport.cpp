#include "sim/picture/PictureText.h"
#include "sim/stock/StockRun.h"
#include "support/Decimal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace dotek::sim {
namespace {

std::string pointText(const Point3& p) {
  return fmt::format("X{} Y{} Z{}", fixedText(p.x, 3), fixedText(p.y, 3), fixedText(p.z, 3));
}

std::string pointJson(const Point3& p) {
  return fmt::format("{{\"X\": {}, \"Y\": {}, \"Z\": {}}}", fixedText(p.x, 6), fixedText(p.y, 6),
                     fixedText(p.z, 6));
}

std::string cellsText(std::size_t cells) {
  return fmt::format("{} cell{}", cells, cells == 1 ? "" : "s");
}

// A colour of the map, and what it means; the first that a value is below.
struct Band {
  double below;
  std::string_view colour;
  std::string name;
};

std::vector<Band> marginBands(const StockMargin& margin, double tolerance) {
  std::vector<Band> out;
  const auto add = [&](double below, std::string_view colour, std::string name) {
    out.push_back({below, colour, std::move(name)});
  };
  const auto mm = [](double value) { return shortNumber(value, 4); };
  const double deep = -margin.least, high = margin.most;
  if (deep > tolerance) {
    add(-tolerance - (deep - tolerance) / 2, "#7b1fa2", fmt::format("cut into the part, to {} mm", mm(deep)));
    add(-tolerance, "#1e62c8",
        fmt::format("cut into the part, to {} mm", mm(tolerance + (deep - tolerance) / 2)));
  }
  add(std::nextafter(tolerance, 1e9), "#3f9b4f", fmt::format("within {} mm", mm(tolerance)));
  if (high > tolerance) {
    constexpr std::array<std::string_view, 4> kColours = {"#d9d36b", "#e8b04a", "#dd7a33", "#b8321f"};
    const double step = (high - tolerance) / 4;
    for (std::size_t i = 0; i < kColours.size(); ++i)
      add(tolerance + step * static_cast<double>(i + 1), kColours[i],
          fmt::format("left over, to {} mm", mm(tolerance + step * static_cast<double>(i + 1))));
  }
  return out;
}

std::vector<Band> heightBands(const StockBlock& block) {
  constexpr std::array<std::string_view, 6> kColours = {"#23445c", "#2f6b80", "#4c9494",
                                                        "#86b893", "#c6d79c", "#efe9c9"};
  std::vector<Band> out;
  const double step = (block.most.z - block.least.z) / static_cast<double>(kColours.size());
  for (std::size_t i = 0; i < kColours.size(); ++i) {
    const double below = block.least.z + step * static_cast<double>(i + 1);
    out.push_back({below, kColours[i], fmt::format("to Z{}", shortNumber(below, 3))});
  }
  return out;
}

std::size_t bandOf(const std::vector<Band>& bands, double value) {
  for (std::size_t i = 0; i + 1 < bands.size(); ++i)
    if (value <= bands[i].below) return i;
  return bands.size() - 1;
}

// Squares of the picture, each of so many cells in a row that no more are drawn than can be seen: it has what
// is farthest from 0 in it, or no number.
class Raster {
public:
  static constexpr std::size_t kMost = 240; // along a side

  Raster(const StockRun& stock, const std::optional<StockMargin>& margin)
      : stock_(stock), margin_(margin),
        each_((std::max(stock.map().columns(), stock.map().rows()) + kMost - 1) / kMost) {}

  std::size_t columns() const { return (stock_.map().columns() + each_ - 1) / each_; }
  std::size_t rows() const { return (stock_.map().rows() + each_ - 1) / each_; }
  double side() const { return stock_.map().block().cell * static_cast<double>(each_); }

  double at(std::size_t column, std::size_t row) const {
    const StockMap& map = stock_.map();
    double out = std::nan("");
    for (std::size_t y = row * each_; y < std::min(map.rows(), (row + 1) * each_); ++y)
      for (std::size_t x = column * each_; x < std::min(map.columns(), (column + 1) * each_); ++x) {
        const double value = margin_ ? margin_->cells[y * map.columns() + x] : map.height(x, y);
        const bool farther = margin_ ? std::abs(value) > std::abs(out) : value < out;
        if (std::isfinite(value) && (!std::isfinite(out) || farther)) out = value;
      }
    return out;
  }

private:
  const StockRun& stock_;
  const std::optional<StockMargin>& margin_;
  std::size_t each_;
};

} // namespace

std::string stockText(const StockRun& stock, const std::optional<StockMargin>& margin) {
  const StockMap& map = stock.map();
  std::string out =
      fmt::format("stock: {} by {} cells of {} mm, {} cm3 cut away\n", map.columns(), map.rows(),
                  shortNumber(map.block().cell, 4), fixedText(map.removed() / 1000, 3));
  if (stock.lost() > 0)
    out += fmt::format("  {} move{} from or to a place that is not known cut nothing here\n", stock.lost(),
                       stock.lost() == 1 ? "" : "s");
  if (!margin) return out;
  const std::string tolerance = shortNumber(stock.file().tolerance, 4);
  out += margin->most > 0 ? fmt::format("  left over: {} mm at most, at {}; more than {} mm in {}\n",
                                        fixedText(margin->most, 4), pointText(margin->mostAt), tolerance,
                                        cellsText(margin->over))
                          : "  left over: nothing\n";
  out += margin->least < 0 ? fmt::format("  cut into the part: {} mm at most, at {}; more than {} mm in {}\n",
                                         fixedText(-margin->least, 4), pointText(margin->leastAt), tolerance,
                                         cellsText(margin->under))
                           : "  cut into the part: nowhere\n";
  if (margin->unknown > 0)
    out += fmt::format("  {} beside a wall along Z {} not compared\n", cellsText(margin->unknown),
                       margin->unknown == 1 ? "is" : "are");
  return out;
}

std::string stockJson(const StockRun& stock, const std::optional<StockMargin>& margin) {
  const StockMap& map = stock.map();
  std::string out = fmt::format(
      "{{\"columns\": {}, \"rows\": {}, \"cell\": {}, \"removed\": {}, \"lostMoves\": {}", map.columns(),
      map.rows(), fixedText(map.block().cell, 6), fixedText(map.removed(), 3), stock.lost());
  if (margin)
    out += fmt::format(", \"tolerance\": {}, \"leftOver\": {{\"most\": {}, \"at\": {}, \"cells\": {}}}, "
                       "\"cutInto\": {{\"most\": {}, \"at\": {}, \"cells\": {}}}, \"notCompared\": {}",
                       fixedText(stock.file().tolerance, 6), fixedText(margin->most, 6),
                       pointJson(margin->mostAt), margin->over, fixedText(-margin->least, 6),
                       pointJson(margin->leastAt), margin->under, margin->unknown);
  return out + "}";
}

std::string stockSvg(const StockRun& stock, const std::optional<StockMargin>& margin,
                     const std::string& title) {
  const Raster raster(stock, margin);
  const StockBlock& block = stock.map().block();
  const std::vector<Band> bands = margin ? marginBands(*margin, stock.file().tolerance) : heightBands(block);
  constexpr double kSide = 640, kMargin = 48, kLegend = 300;
  const double scale =
      kSide / (raster.side() * static_cast<double>(std::max(raster.columns(), raster.rows())));
  const double step = raster.side() * scale;
  const double width = step * static_cast<double>(raster.columns());
  const double height = step * static_cast<double>(raster.rows());
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "font-family=\"sans-serif\" font-size=\"14\" fill=\"#20262d\">\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"#ffffff\"/>\n<text x=\"{2}\" y=\"28\" font-size=\"18\">{3}</text>\n",
      fixedText(width + 2 * kMargin + kLegend, 0), fixedText(std::max(height, 300.0) + 2 * kMargin, 0),
      kMargin, xmlText(title));
  out += fmt::format("<g transform=\"translate({} {})\" shape-rendering=\"crispEdges\">\n", kMargin, kMargin);
  for (std::size_t row = 0; row < raster.rows(); ++row) {
    const double y = height - step * static_cast<double>(row + 1);
    std::size_t begin = 0;
    std::string_view colour;
    const auto close = [&](std::size_t end) {
      if (end > begin)
        out += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n",
                           shortNumber(step * static_cast<double>(begin), 3), shortNumber(y, 3),
                           shortNumber(step * static_cast<double>(end - begin), 3), shortNumber(step, 3),
                           colour);
      begin = end;
    };
    for (std::size_t column = 0; column < raster.columns(); ++column) {
      const double value = raster.at(column, row);
      const std::string_view here = std::isfinite(value) ? bands[bandOf(bands, value)].colour : "#c9c9c9";
      if (here != colour) close(column);
      colour = here;
    }
    close(raster.columns());
  }
  out += "</g>\n";
  out += fmt::format("<rect x=\"{0}\" y=\"{0}\" width=\"{1}\" height=\"{2}\" fill=\"none\" "
                     "stroke=\"#20262d\"/>\n",
                     kMargin, fixedText(width, 2), fixedText(height, 2));
  const double left = kMargin + width + 24;
  double at = kMargin + 14;
  const auto line = [&](const std::string& text) {
    out += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", fixedText(left, 1), fixedText(at, 1),
                       xmlText(text));
    at += 22;
  };
  line(margin ? "square to the part" : "height of what is left");
  for (const Band& band : bands) {
    out += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"16\" height=\"14\" fill=\"{}\"/>\n",
                       fixedText(left, 1), fixedText(at - 12, 1), band.colour);
    out += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", fixedText(left + 24, 1), fixedText(at, 1),
                       xmlText(band.name));
    at += 22;
  }
  at += 8;
  line(fmt::format("X{} to X{}", shortNumber(block.least.x, 3), shortNumber(block.most.x, 3)));
  line(fmt::format("Y{} to Y{}", shortNumber(block.least.y, 3), shortNumber(block.most.y, 3)));
  line(fmt::format("{} cm3 cut away", fixedText(stock.map().removed() / 1000, 3)));
  return out + "</svg>\n";
}

} // namespace dotek::sim
