#include "sim/picture/Lattice.h"
#include "sim/picture/Picture.h"
#include "sim/picture/PicturePlanes.h"
#include "sim/picture/PictureReport.h"
#include "sim/picture/PictureResult.h"
#include "sim/picture/PictureText.h"
#include "sim/picture/PictureView.h"
#include "sim/picture/Sections.h"
#include "support/Decimal.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <vector>

namespace dotek::sim {
namespace {

// Of the sheet, px.
constexpr double kLeft = 64, kTop = 92, kRight = 62, kBottom = 26;
constexpr double kGap = 104;    // between views: room for numbers and letters
constexpr double kViews = 1000; // width of two views
constexpr double kHeight = 720; // height of two views
constexpr double kLegend = 380; // width of the legend
constexpr double kLine = 19;    // of the legend

std::string px(double value) {
  return shortNumber(value, 2);
}

double finite(double value) {
  return std::isfinite(value) ? value : 0;
}

class Legend {
public:
  Legend(double left, double top) : left_(left), at_(top) {}

  void sample(PathKind kind) {
    const PathStyle& style = pathStyle(kind);
    out_ += fmt::format("<path d=\"M{} {}h44\" stroke=\"{}\" stroke-width=\"{}\"{} fill=\"none\"/>",
                        px(left_), px(at_ - 4), style.colour, style.width,
                        *style.dashes == '\0' ? "" : fmt::format(" stroke-dasharray=\"{}\"", style.dashes));
    text(fmt::format("{} move", pathKindName(kind)), 56);
  }
  void mark(const std::string& shape, const std::string& what) {
    out_ += fmt::format("<g transform=\"translate({} {})\">{}</g>", px(left_ + 22), px(at_ - 4), shape);
    text(what, 56);
  }
  void text(const std::string& line, double indent = 0, const char* colour = "#20262d") {
    out_ += fmt::format("<text x=\"{}\" y=\"{}\" fill=\"{}\">{}</text>\n", px(left_ + indent), px(at_),
                        colour, xmlText(line));
    at_ += kLine;
  }
  void gap(double height) { at_ += height; }
  void raw(const std::string& svg) { out_ += svg; }
  double left() const { return left_; }
  double at() const { return at_; }
  std::string take() { return std::move(out_); }

private:
  double left_, at_; // base line of the next text
  std::string out_;
};

void addScale(Legend& legend, double scale) {
  const double length = roundLength(std::min(170 / scale, 1e6));
  const double width = length * scale;
  const double y = legend.at() - 3;
  legend.raw(fmt::format("<g id=\"scale\"><path d=\"M{0} {1}v8h{2}v-8\" fill=\"none\" stroke=\"#20262d\" "
                         "stroke-width=\"1.4\"/><path d=\"M{0} {3}h{4}v4h-{4}z\" fill=\"#20262d\"/>"
                         "<text x=\"{5}\" y=\"{6}\" fill=\"#20262d\">{7} mm</text></g>\n",
                         px(legend.left()), px(y), px(width), px(y + 4), px(width / 2),
                         px(legend.left() + width + 8), px(y + 9), shortNumber(length, 6)));
  legend.gap(kLine + 8);
}

// What the picture leaves out.
std::vector<std::string> notesOf(const Picture& picture, const Region& region, const SectionPlanes& planes) {
  std::vector<std::string> out;
  std::size_t lost = 0, beyond = 0, hidden = 0;
  for (const PictureMove& move : picture.moves) {
    if (!isDrawn(move))
      ++lost;
    else if (!region.contains(move.from) || !region.contains(move.to))
      ++beyond;
  }
  const auto plural = [](std::size_t n, const char* what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
  };
  for (const PictureContact& contact : picture.contacts)
    hidden += isDrawn(contact.point) ? 0 : 1;
  for (const PictureError& error : picture.errors)
    hidden += isDrawn(error.at) ? 0 : 1;
  if (const std::string cut = cutNote(picture, region); !cut.empty())
    for (const std::string& line : wrapped(cut, 60))
      out.push_back(line);
  double missed = 0;
  for (std::size_t axis = 0; picture.part && axis < 3; ++axis)
    missed = std::max(missed, sectionLattice(*picture.part, axis, planes.at[axis], region).missed);
  if (missed > 0)
    for (const std::string& line : wrapped(missedNote(missed), 60))
      out.push_back(line);
  if (beyond > 0) out.push_back(fmt::format("the path leaves the picture in {}", plural(beyond, "move")));
  if (lost > 0) out.push_back(fmt::format("{} not drawn: no number, or beyond 1 km", plural(lost, "move")));
  if (hidden > 0) out.push_back(fmt::format("{} without a place on the sheet", plural(hidden, "mark")));
  if (picture.moves.size() > kThinFrom)
    out.push_back(fmt::format("{} moves: what is shorter than half a pixel is joined", picture.moves.size()));
  if (picture.contacts.size() > kMostNumbered)
    out.push_back(fmt::format("{} contacts: the first {} are drawn", picture.contacts.size(), kMostNumbered));
  return out;
}

struct Sheet {
  const Picture& picture;
  Region region;
  SectionPlanes planes;
  double scale = 1;
};

// What the blue numbers are. The zero is that of the banner: its work position less its place in the machine.
std::vector<std::string> zeroLines(const WorkZero& zero, int decimals) {
  const auto number = [&](double value) { return fixedText(value, decimals); };
  std::vector<std::string> out;
  // Mikroprog has one system, which has no number.
  if (zero.name == "work")
    out.push_back("blue numbers: as the control counts, zero at machine");
  else if (zero.above == 0)
    out.push_back(fmt::format("blue numbers: work coordinates {}, zero at machine", zero.name));
  else
    out.push_back(fmt::format("blue numbers: {} as shown with the {} there, zero at machine", zero.name,
                              zero.point.empty() ? "gauge line" : zero.point));
  out.push_back(pointText(zero.zero(), decimals));
  if (zero.above == 0) return out;
  const std::string counts =
      zero.length == 0 ? "no tool length is in force: Z counts for the gauge line"
                       : fmt::format("the length in force is {}: Z counts for a point", number(zero.length));
  for (std::string& line : wrapped(fmt::format("{}, {} {} the {}", counts, number(std::abs(zero.above)),
                                               zero.above > 0 ? "above" : "below",
                                               zero.point.empty() ? "gauge line" : zero.point),
                                   60))
    out.push_back(std::move(line));
  return out;
}

std::string drawLegend(const Sheet& sheet, double left, double top, double& bottom) {
  const Picture& picture = sheet.picture;
  const auto count = [&](auto&& holds) {
    return static_cast<std::size_t>(std::count_if(picture.errors.begin(), picture.errors.end(), holds));
  };
  const std::size_t misses = count(isMiss);
  const std::size_t used =
      count([](const PictureError& one) { return one.kind == PictureError::Kind::UsedMiss; });
  Legend legend(left, top + 12);
  for (const PathKind kind : {PathKind::Rapid, PathKind::Feed, PathKind::Protected, PathKind::Measuring})
    legend.sample(kind);
  legend.mark("<rect x=\"-14.5\" y=\"-3.5\" width=\"7\" height=\"7\" fill=\"#ffffff\" stroke=\"#20262d\" "
              "stroke-width=\"1.3\"/><rect x=\"7.5\" y=\"-3.5\" width=\"7\" height=\"7\" fill=\"#20262d\" "
              "stroke=\"#20262d\" stroke-width=\"1.3\"/>",
              "start, end of the path");
  legend.mark(fmt::format("<circle r=\"3.2\" fill=\"{}\"/>", kContactColour),
              fmt::format("contact ({}), numbered in order", picture.contacts.size()));
  legend.mark(fmt::format("<path d=\"M-5.5 -5.5l11 11m0 -11l-11 11\" fill=\"none\" stroke=\"{}\" "
                          "stroke-width=\"2.6\"/>",
                          kErrorColour),
              fmt::format("error ({})", picture.errors.size() - misses));
  legend.mark(fmt::format("<path d=\"M-16.5 0l6.5 -6.5 6.5 6.5 -6.5 6.5z\" fill=\"{0}\" stroke=\"{0}\" "
                          "stroke-width=\"2\"/><path d=\"M3.5 0l6.5 -6.5 6.5 6.5 -6.5 6.5z\" "
                          "fill=\"#ffffff\" stroke=\"{0}\" stroke-width=\"2\"/>",
                          kErrorColour),
              used == 0 ? fmt::format("miss ({})", misses)
                        : fmt::format("miss ({}); {} taken for the surface (full)", misses, used));
  if (picture.part) {
    legend.mark("<rect x=\"-22\" y=\"-6\" width=\"44\" height=\"12\" fill=\"url(#cut)\" stroke=\"#39424d\"/>",
                "material in the section");
    constexpr const char* kNames[] = {"YZ", "XZ", "XY"};
    constexpr const char* kAxes[] = {"X", "Y", "Z"};
    for (std::size_t axis = 3; axis-- > 0;) {
      std::string line = fmt::format("{} at {} {}", kNames[axis], kAxes[axis],
                                     fixedText(sheet.planes.at[axis], picture.decimals));
      if (sheet.planes.contact[axis])
        line += fmt::format(", through contact {}", *sheet.planes.contact[axis] + 1);
      const auto named = [&](std::size_t error) {
        return (isMiss(picture.errors[error]) ? "miss " : "error ") + errorNames(picture)[error];
      };
      if (sheet.planes.error[axis]) line += ", through " + named(*sheet.planes.error[axis]);
      if (const auto beside = sheet.planes.beside[axis])
        line += fmt::format(", inside the face {} {}",
                            touchAt(picture, picture.errors[*beside]) ? "at" : "nearest to", named(*beside));
      legend.text(line, 56);
    }
  } else {
    legend.text("no part: only the path is drawn", 56);
  }
  if (picture.setter) {
    legend.mark(
        fmt::format("<circle r=\"6\" fill=\"{0}\" fill-opacity=\"0.18\" stroke=\"{0}\"/>", kSetterColour),
        "tool setter" +
            std::string(sheet.region.contains(picture.setter->at) ? "" : ", outside of the picture"));
    legend.text("at machine " + pointText(picture.setter->at, picture.decimals), 56);
  }
  if (picture.moves.empty()) legend.text("no moves", 56);
  legend.gap(6);
  addScale(legend, sheet.scale);
  legend.text("mm, in coordinates of the machine;", 0, "#4a525c");
  legend.text(hasProbe(picture) ? fmt::format("the path is that of the ball's centre (ball {})",
                                              shortNumber(finite(picture.probe.ballDiameter), 3))
                                : "the path is that of the spindle's gauge line: no probe is stated",
              0, "#4a525c");
  for (const PictureTool& tool : picture.tools)
    for (const std::string& line : wrapped(toolNote(tool, picture.decimals), 60))
      legend.text(line, 0, tool.listed ? "#4a525c" : "#8a4b00");
  if (const std::optional<WorkZero> zero = workZeroOf(picture)) {
    for (const std::string& line : zeroLines(*zero, picture.decimals))
      legend.text(line, 0, kWorkColour);
  }
  for (const std::string& note : notesOf(picture, sheet.region, sheet.planes))
    legend.text(note, 0, "#8a4b00");
  bottom = legend.at();
  return legend.take();
}

// Numbered texts below the views.
std::string drawErrors(const Picture& picture, double width, double& at) {
  if (picture.errors.empty()) return "";
  const std::vector<std::string> names = errorNames(picture);
  std::string out = fmt::format("<g id=\"errors\" fill=\"{}\">\n", kErrorColour);
  const auto line = [&](const std::string& text, double indent, bool bold) {
    out += fmt::format("<text x=\"{}\" y=\"{}\"{}>{}</text>\n", px(kLeft + indent), px(at),
                       bold ? " font-weight=\"bold\"" : "", xmlText(text));
    at += kLine;
  };
  std::vector<std::size_t> order(picture.errors.size()); // errors before misses
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_partition(order.begin(), order.end(),
                        [&](std::size_t i) { return !isMiss(picture.errors[i]); });
  for (std::size_t place = 0; place < order.size() && place < kMostErrors; ++place) {
    const std::size_t i = order[place];
    const PictureError& error = picture.errors[i];
    std::string text = error.text;
    if (const std::optional<std::size_t> block = blockOf(picture, error))
      text = fmt::format("{}: {}", picture.blocks[*block].place, text);
    line(names[i], 0, true);
    at -= kLine;
    for (const std::string& part :
         wrapped(text.substr(0, 900), static_cast<std::size_t>((width - kLeft - 36 - kRight) / 6.6)))
      line(part, 36, false);
  }
  if (picture.errors.size() > kMostErrors)
    line(fmt::format("and {} more", picture.errors.size() - kMostErrors), 36, false);
  return out + "</g>\n";
}

} // namespace

std::string pictureSvg(const Picture& picture) {
  Sheet sheet{picture, regionOf(picture), {}, 1};
  sheet.planes = sectionPlanesOf(picture, sheet.region);
  const Point3 size = sheet.region.most - sheet.region.least;
  sheet.scale = std::min(kViews / (size.x + size.y), kHeight / (size.y + size.z));
  const double s = sheet.scale;

  // XY above XZ, YZ beside it: edges line up as in a drawing. The legend has the fourth corner.
  const double right = kLeft + std::max(size.x * s, 200.0) + kGap;
  const double width = std::max(right + size.y * s, right - 20 + kLegend) + kRight;
  double banner = 0;
  const std::string result = picture.result ? bannerSvg(*picture.result, kLeft, width, banner) : "";
  const double top = kTop + banner;
  double legendBottom = 0;
  const std::string legend = drawLegend(sheet, right - 20, top, legendBottom);
  const double low = std::max(top + size.y * s, legendBottom) + kGap;
  std::string views, clips;
  for (const std::size_t across : {2u, 1u, 0u}) {
    const std::array<std::size_t, 2> axes = planeAxes(across);
    ViewFrame frame{across, across == 0 ? right : kLeft, across == 2 ? top : low, s, ""};
    clips += fmt::format(
        "<clipPath id=\"clip{}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>\n", across,
        px(frame.left), px(frame.top), px(coordinate(size, axes[0]) * s), px(coordinate(size, axes[1]) * s));
    if (!picture.part) {
      views += drawView(picture, sheet.region, frame, nullptr);
      continue;
    }
    const Section section = sectionOf(*picture.part, across, sheet.planes.at[across], sheet.region);
    frame.heading = fmt::format("{} at {} {}", section.areas.empty() ? "no material" : "section",
                                std::string_view("XYZ").substr(across, 1),
                                fixedText(sheet.planes.at[across], picture.decimals));
    views += drawView(picture, sheet.region, frame, &section);
  }
  double bottom = low + size.z * s + 56;
  const std::string errors = drawErrors(picture, width, bottom);
  const std::string measured = measuredSvg(picture, kLeft, bottom);
  const std::string lists = listsSvg(picture, kLeft, bottom);
  const bool bare = errors.empty() && measured.empty() && lists.empty();
  const double height = bottom + kBottom - (bare ? 14 : 0);

  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"Helvetica, Arial, sans-serif\" font-size=\"12.5\">\n<title>{2}</title>\n",
      px(width), px(height),
      xmlText(picture.result ? picture.result->word + " - " + picture.title : picture.title, 300));
  out += "<style>@page{margin:10mm}@media print{:root{width:100%;height:auto;max-height:100vh}}</style>\n";
  out += "<defs>\n<pattern id=\"cut\" width=\"7\" height=\"7\" patternUnits=\"userSpaceOnUse\" "
         "patternTransform=\"rotate(45)\"><rect width=\"7\" height=\"7\" fill=\"#edf0f3\"/>"
         "<path d=\"M0 0v7\" stroke=\"#c3cad3\" stroke-width=\"1.6\"/></pattern>\n" +
         clips + "</defs>\n";
  out += fmt::format("<rect width=\"{}\" height=\"{}\" fill=\"#f7f8fa\"/>\n", px(width), px(height));
  out += result;
  out += fmt::format(
      "<text x=\"{}\" y=\"{}\" font-size=\"19\" font-weight=\"bold\" fill=\"#20262d\">{}</text>\n", px(kLeft),
      px(banner + 34), xmlText(picture.title, static_cast<std::size_t>((width - 2 * kLeft) / 10)));
  if (!picture.control.empty())
    out += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\" fill=\"#4a525c\">run on {}</text>\n",
                       px(width - kRight), px(banner + 52), xmlText(picture.control, 100));
  if (!picture.date.empty())
    out += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\" fill=\"#4a525c\">{}</text>\n",
                       px(width - kRight), px(banner + 34), xmlText(picture.date, 60));
  out += views;
  out += "<g id=\"legend\">\n" + legend + "</g>\n" + errors + measured + lists + "</svg>\n";
  return out;
}

} // namespace dotek::sim
