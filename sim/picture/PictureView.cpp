#include "sim/picture/PictureView.h"

#include "sim/picture/PicturePlanes.h"
#include "sim/picture/PictureProbe.h"
#include "sim/picture/PictureText.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace dotek::sim {
namespace {

constexpr const char* kAxisNames[] = {"X", "Y", "Z"};

std::string px(double value) {
  return shortNumber(value, 2);
}

struct Box {
  double left, top, right, bottom;
  bool meets(const Box& o) const {
    return left < o.right && o.left < right && top < o.bottom && o.top < bottom;
  }
};

// "1, 3-5" of ascending numbers; not more than six parts.
std::string numbersText(const std::vector<std::size_t>& numbers) {
  std::string out;
  int parts = 0;
  for (std::size_t i = 0; i < numbers.size(); ++parts) {
    if (parts == 6) return out + ",\xE2\x80\xA6";
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1)
      ++last;
    if (last < i + 2) last = i;
    out += fmt::format("{}{}", out.empty() ? "" : ",", numbers[i]);
    if (last > i) out += fmt::format("-{}", numbers[last]);
    i = last + 1;
  }
  return out;
}

class View {
public:
  View(const Picture& picture, const Region& region, const ViewFrame& frame)
      : picture_(picture), region_(region), frame_(frame), axes_(planeAxes(frame.across)) {
    for (std::size_t i = 0; i < 2; ++i) {
      least_[i] = coordinate(region.least, axes_[i]);
      most_[i] = coordinate(region.most, axes_[i]);
    }
    box_ = {frame.left, frame.top, frame.left + (most_[0] - least_[0]) * frame.scale,
            frame.top + (most_[1] - least_[1]) * frame.scale};
  }

  std::string draw(const Section* section) {
    const std::string name = fmt::format("{}{}", kAxisNames[axes_[0]], kAxisNames[axes_[1]]);
    out_ = fmt::format("<g id=\"{}\">\n", name);
    ground();
    if (section != nullptr) material(*section);
    out_ +=
        fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#8b939e\"/>\n",
                    px(box_.left), px(box_.top), px(box_.right - box_.left), px(box_.bottom - box_.top));
    setter();
    failure();
    balls();
    for (const PathKind kind : {PathKind::Measuring, PathKind::Protected, PathKind::Feed, PathKind::Rapid})
      way(kind);
    arrows();
    ends();
    contacts();
    misses();
    errors();
    setterName();
    out_ += "</g>\n";
    return std::move(out_);
  }

private:
  PlanePoint on(const Point3& p) const { return {coordinate(p, axes_[0]), coordinate(p, axes_[1])}; }
  PlanePoint sheet(const PlanePoint& p) const {
    return {box_.left + (p[0] - least_[0]) * frame_.scale, box_.bottom - (p[1] - least_[1]) * frame_.scale};
  }
  bool isSeen(const Point3& p) const { return isDrawn(p) && region_.contains(p); }
  static std::string pair(const PlanePoint& p) { return px(p[0]) + ' ' + px(p[1]); }

  // Background, grid and the numbers along the two axes.
  void ground() {
    out_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"#ffffff\"/>\n",
                        px(box_.left), px(box_.top), px(box_.right - box_.left), px(box_.bottom - box_.top));
    std::string lines, numbers;
    double step = roundLength(48 / frame_.scale);
    if (step < 48 / frame_.scale) step = roundLength(step * 2.5); // the next one
    const int places = step < 0.01 ? 3 : step < 0.1 ? 2 : step < 1 ? 1 : 0;
    for (std::size_t i = 0; i < 2; ++i) {
      for (double k = std::ceil(least_[i] / step); k * step <= most_[i]; ++k) {
        PlanePoint a{least_[0], least_[1]}, b{most_[0], most_[1]};
        a[i] = b[i] = k * step;
        const PlanePoint p = sheet(a), q = sheet(b);
        lines += fmt::format("M{}L{}", pair(p), pair(q));
        const std::string text = shortNumber(k * step, places);
        if (i == 0)
          numbers += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>", px(p[0]),
                                 px(box_.bottom + 14), text);
        else
          numbers += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>", px(box_.left - 6),
                                 px(p[1] + 3.5), text);
      }
    }
    if (const std::optional<WorkZero> zero = workZeroOf(picture_)) work(*zero, step, places);
    out_ += fmt::format("<path d=\"{}\" stroke=\"#e6e9ed\" fill=\"none\"/>\n", lines);
    out_ += fmt::format("<g font-size=\"10.5\" fill=\"#4a525c\">{}</g>\n", numbers);
    out_ +=
        fmt::format("<g font-size=\"13\" font-weight=\"bold\" fill=\"#20262d\">"
                    "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>"
                    "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>"
                    "<text x=\"{}\" y=\"{}\">{}{}<tspan font-size=\"11.5\" font-weight=\"normal\" dx=\"8\" "
                    "fill=\"#4a525c\">{}</tspan></text></g>\n",
                    px(box_.right), px(box_.bottom + 28), kAxisNames[axes_[0]], px(box_.left - 8),
                    px(box_.top - 7), kAxisNames[axes_[1]], px(box_.left), px(box_.top - 24),
                    kAxisNames[axes_[0]], kAxisNames[axes_[1]], frame_.heading);
  }

  // The same of the work coordinates, along the upper and the right side.
  void work(const WorkZero& zero, double step, int places) {
    std::string ticks, numbers;
    for (std::size_t i = 0; i < 2; ++i) {
      const double from = coordinate(zero.at, axes_[i]);
      for (double k = std::ceil((least_[i] - from) / step); from + k * step <= most_[i]; ++k) {
        PlanePoint at{most_[0], most_[1]};
        at[i] = from + k * step;
        const PlanePoint p = sheet(at);
        const std::string text = shortNumber(k * step, places);
        ticks += "M" + pair(p) + (i == 0 ? "v-4" : "h4");
        // Beside the corners are the letter of the axis and the name of the system.
        constexpr double kLetter = 18;
        if (i == 0 && (p[0] < box_.left + kLetter || p[0] > box_.right - kLetter)) continue;
        numbers += i == 0
                       ? fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>", px(p[0]),
                                     px(p[1] - 7), text)
                       : fmt::format("<text x=\"{}\" y=\"{}\">{}</text>", px(p[0] + 7), px(p[1] + 3.5), text);
      }
    }
    out_ += fmt::format("<path d=\"{}\" stroke=\"{}\" fill=\"none\"/>\n<g font-size=\"10.5\" fill=\"{}\">{}"
                        "<text x=\"{}\" y=\"{}\">{}</text></g>\n",
                        ticks, kWorkColour, kWorkColour, numbers, px(box_.right + 7), px(box_.top - 7),
                        xmlText(zero.name, 12));
  }

  void trace(const SectionLine& line, std::string& d) const {
    for (std::size_t i = 0; i < line.points.size(); ++i)
      d += (i == 0 ? 'M' : 'L') + pair(sheet(line.points[i]));
    if (line.closed) d += 'Z';
  }

  void material(const Section& section) {
    std::string areas, lines;
    for (const SectionLine& line : section.areas)
      trace(line, areas);
    for (const SectionLine& line : section.lines)
      trace(line, lines);
    if (!areas.empty())
      out_ += fmt::format("<path d=\"{}\" fill=\"url(#cut)\" fill-rule=\"evenodd\"/>\n", areas);
    if (!lines.empty())
      out_ += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#39424d\" stroke-width=\"1.1\" "
                          "stroke-linejoin=\"round\"/>\n",
                          lines);
  }

  // The part of a line in the view (Liang and Barsky). false: none.
  bool clip(PlanePoint& a, PlanePoint& b) const {
    double first = 0, last = 1;
    for (std::size_t i = 0; i < 2; ++i) {
      const double d = b[i] - a[i];
      if (d == 0) {
        if (a[i] < least_[i] || a[i] > most_[i]) return false;
        continue;
      }
      const double low = (least_[i] - a[i]) / d, high = (most_[i] - a[i]) / d;
      first = std::max(first, std::min(low, high));
      last = std::min(last, std::max(low, high));
    }
    if (first > last) return false;
    const PlanePoint d{b[0] - a[0], b[1] - a[1]};
    b = {a[0] + d[0] * last, a[1] + d[1] * last};
    a = {a[0] + d[0] * first, a[1] + d[1] * first};
    return true;
  }

  void way(PathKind kind) {
    const double least = picture_.moves.size() > kThinFrom ? 0.5 : 0.01; // px
    std::string d;
    bool open = false;
    PlanePoint drawn{}, waiting{}; // sheet
    bool waits = false;
    const auto flush = [&] {
      if (waits) d += 'L' + pair(waiting);
      waits = false;
    };
    for (const PictureMove& move : picture_.moves) {
      if (move.kind != kind || !isDrawn(move)) {
        flush();
        open = false;
        continue;
      }
      PlanePoint a = on(move.from), b = on(move.to);
      if (!clip(a, b)) continue;
      a = sheet(a);
      b = sheet(b);
      const PlanePoint& end = waits ? waiting : drawn;
      if (!open || std::hypot(a[0] - end[0], a[1] - end[1]) > 0.02) {
        flush();
        d += 'M' + pair(a);
        drawn = a;
        open = true;
      }
      if (std::hypot(b[0] - drawn[0], b[1] - drawn[1]) < least) {
        waiting = b;
        waits = true;
        continue;
      }
      d += 'L' + pair(b);
      drawn = b;
      waits = false;
    }
    flush();
    if (d.find('L') == std::string::npos) return;
    const PathStyle& style = pathStyle(kind);
    out_ += fmt::format("<path class=\"{}\" d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{} "
                        "stroke-linejoin=\"round\"/>\n",
                        pathKindName(kind), d, style.colour, style.width,
                        *style.dashes == '\0' ? "" : fmt::format(" stroke-dasharray=\"{}\"", style.dashes));
  }

  // The path's direction where there is room for it, measuring moves first.
  void arrows() {
    std::vector<PlanePoint> taken;
    std::string kinds[4];
    for (const bool measuring : {true, false}) {
      for (std::size_t i = 0; i < picture_.moves.size() && taken.size() < 60; ++i) {
        const PictureMove& move = picture_.moves[i];
        if ((move.kind == PathKind::Measuring) != measuring || !isDrawn(move)) continue;
        PlanePoint a = on(move.from), b = on(move.to);
        if (!clip(a, b)) continue;
        a = sheet(a);
        b = sheet(b);
        const double l = std::hypot(b[0] - a[0], b[1] - a[1]);
        if (l < (measuring ? 22 : 54)) continue;
        const PlanePoint u{(b[0] - a[0]) / l, (b[1] - a[1]) / l};
        const PlanePoint tip{a[0] + u[0] * (l * 0.55 + 5), a[1] + u[1] * (l * 0.55 + 5)};
        if (std::any_of(taken.begin(), taken.end(),
                        [&](const PlanePoint& p) { return std::hypot(p[0] - tip[0], p[1] - tip[1]) < 24; }))
          continue;
        taken.push_back(tip);
        const PlanePoint foot{tip[0] - u[0] * 9, tip[1] - u[1] * 9};
        kinds[static_cast<std::size_t>(move.kind)] +=
            fmt::format("M{}L{}L{}Z", pair(tip), pair({foot[0] - u[1] * 3.4, foot[1] + u[0] * 3.4}),
                        pair({foot[0] + u[1] * 3.4, foot[1] - u[0] * 3.4}));
      }
    }
    for (std::size_t kind = 0; kind < 4; ++kind) {
      if (!kinds[kind].empty())
        out_ += fmt::format("<path d=\"{}\" fill=\"{}\"/>\n", kinds[kind],
                            pathStyle(static_cast<PathKind>(kind)).colour);
    }
  }

  // Hollow where the path begins, full where it ends.
  void ends() {
    if (picture_.moves.empty()) return;
    const auto square = [&](const Point3& p, const char* fill) {
      if (!isSeen(p)) return;
      const PlanePoint at = sheet(on(p));
      out_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"7\" height=\"7\" fill=\"{}\" stroke=\"#20262d\" "
                          "stroke-width=\"1.3\"/>\n",
                          px(at[0] - 3.5), px(at[1] - 3.5), fill);
    };
    square(picture_.moves.back().to, "#20262d");
    square(picture_.moves.front().from, "#ffffff");
  }

  // A disc seen from above, as high as it is wide below its face from the side.
  void setter() {
    if (!picture_.setter || !isSeen(picture_.setter->at)) return;
    const double r = picture_.setter->diameter / 2 * frame_.scale;
    const PlanePoint at = sheet(on(picture_.setter->at));
    out_ += fmt::format(
        "<g class=\"setter\" fill=\"{0}\" fill-opacity=\"0.18\" stroke=\"{0}\" stroke-width=\"1.4\" "
        "clip-path=\"url(#clip{1})\">",
        kSetterColour, frame_.across);
    out_ += frame_.across == 2
                ? fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"/>", px(at[0]), px(at[1]), px(r))
                : fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>", px(at[0] - r),
                              px(at[1]), px(2 * r), px(r));
    out_ += "</g>\n";
  }
  void setterName() {
    if (!picture_.setter || !isSeen(picture_.setter->at)) return;
    out_ += "<g font-size=\"12\" stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\" "
            "stroke-linejoin=\"round\">\n";
    PlanePoint at = sheet(on(picture_.setter->at));
    at[1] += picture_.setter->diameter / 4 * frame_.scale;
    label(at, "tool setter", kSetterColour);
    out_ += "</g>\n";
  }

  // Where the run failed: seen when the sheet is as small as a telephone, with the probe as it stood there.
  void failure() {
    const std::optional<std::size_t> place = failureOf(picture_);
    if (!place || !isSeen(picture_.errors[*place].at)) return;
    const PictureError& error = picture_.errors[*place];
    const PlanePoint at = sheet(on(error.at));
    // What met: of stem and body it is away from the ball.
    const std::optional<Part::Nearest> touch = touchAt(picture_, error);
    const bool isInside = touch && picture_.part->distance(error.at) < 0;
    const PlanePoint spot = touch && !isInside ? sheet(on(touch->point)) : at;
    const bool probe = hasProbe(picture_) && !isMiss(error) && error.move < picture_.moves.size() &&
                       picture_.moves[error.move].tool == 0;
    // From above stem and body are of interest only where they meet something.
    const bool byBall = touch && (touch->point - error.at).length() < picture_.probe.ballRadius() + 0.1;
    const bool outlined = probe && (frame_.across != 2 || (touch && !byBall && !isInside));
    out_ += fmt::format("<g class=\"failure\" clip-path=\"url(#clip{0})\" fill=\"{1}\" fill-opacity=\"{2}\" "
                        "stroke=\"{1}\" stroke-opacity=\"0.55\">{3}<circle cx=\"{4}\" cy=\"{5}\" r=\"26\" "
                        "fill-opacity=\"0.2\" stroke=\"none\"/></g>\n",
                        frame_.across, kErrorColour, frame_.across == 2 ? "0" : "0.07",
                        outlined ? probeOutline(picture_.probe, frame_.across, at, frame_.scale) : "",
                        px(spot[0]), px(spot[1]));
  }

  // The ball where it touched and where something went wrong.
  void balls() {
    const double radius = picture_.probe.ballRadius() * frame_.scale;
    if (!hasProbe(picture_) || !(radius > 1) || radius > 2000 || picture_.contacts.size() > 60) return;
    const auto ball = [&](const Point3& p, const char* colour) {
      const PlanePoint at = sheet(on(p));
      out_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" stroke=\"{}\"/>\n", px(at[0]), px(at[1]),
                          px(radius), colour);
    };
    const auto ofProbe = [&](std::size_t move) {
      return move < picture_.moves.size() && picture_.moves[move].tool == 0;
    };
    out_ +=
        fmt::format("<g fill=\"none\" stroke-opacity=\"0.7\" clip-path=\"url(#clip{})\">\n", frame_.across);
    for (const PictureContact& contact : picture_.contacts) {
      if (ofProbe(contact.move) && isSeen(picture_.moves[contact.move].to))
        ball(picture_.moves[contact.move].to, pathStyle(PathKind::Measuring).colour);
    }
    for (std::size_t i = 0; i < picture_.errors.size() && i < kMostErrors; ++i) {
      if (ofProbe(picture_.errors[i].move) && isSeen(picture_.errors[i].at))
        ball(picture_.errors[i].at, kErrorColour);
    }
    out_ += "</g>\n";
  }

  struct Mark {
    PlanePoint at;
    std::vector<std::size_t> numbers; // from 1 on
    bool full = false;
  };
  // Marks that fall on one another are one.
  static Mark& addMark(std::vector<Mark>& marks, const PlanePoint& at, std::size_t number) {
    for (Mark& mark : marks) {
      if (std::hypot(mark.at[0] - at[0], mark.at[1] - at[1]) > 2.5) continue;
      if (number != 0) mark.numbers.push_back(number);
      return mark;
    }
    marks.push_back({at, {}});
    if (number != 0) marks.back().numbers.push_back(number);
    return marks.back();
  }

  bool isFree(const Box& box) const {
    return box.left > box_.left && box.right < box_.right && box.top > box_.top && box.bottom < box_.bottom &&
           std::none_of(taken_.begin(), taken_.end(), [&](const Box& o) { return o.meets(box); });
  }
  // Beside a mark, where nothing is written yet; where all is full, close to it.
  Box labelBox(const PlanePoint& at, double width) const {
    constexpr double kHeight = 12;
    constexpr double kWays[][2] = {{1, -1}, {-1, -1}, {1, 1}, {-1, 1}, {1, 0}, {-1, 0}, {0, -1}, {0, 1}};
    const auto box = [&](const double* way, double away) {
      const double x = at[0] + way[0] * (away + width / 2), y = at[1] + way[1] * (away + kHeight / 2 - 3);
      return Box{x - width / 2, y - kHeight / 2, x + width / 2, y + kHeight / 2};
    };
    for (const double away : {7.0, 16.0, 27.0}) {
      for (const auto& way : kWays) {
        if (const Box candidate = box(way, away); isFree(candidate)) return candidate;
      }
    }
    // Within the view, where that is wide enough: the legend is beside it.
    Box close = box(kWays[0], 7);
    const double over = std::max(0.0, close.right - box_.right + 2);
    const double shift = std::min(over, std::max(0.0, close.left - box_.left - 2));
    close.left -= shift;
    close.right -= shift;
    return close;
  }
  void label(const PlanePoint& at, const std::string& text, const char* colour) {
    const Box box = labelBox(at, 6.9 * static_cast<double>(text.size()) + 2);
    taken_.push_back(box);
    out_ += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\" fill=\"{}\">{}</text>\n",
                        px((box.left + box.right) / 2), px(box.bottom - 2), colour, text);
  }

  static Box around(const PlanePoint& p, double r) { return {p[0] - r, p[1] - r, p[0] + r, p[1] + r}; }

  void contacts() {
    std::vector<Mark> marks;
    for (std::size_t i = 0; i < picture_.contacts.size() && i < kMostNumbered; ++i) {
      if (isSeen(picture_.contacts[i].point)) addMark(marks, sheet(on(picture_.contacts[i].point)), i + 1);
    }
    std::size_t errors = 0, misses = 0;
    for (std::size_t i = 0; i < picture_.errors.size() && i < kMostErrors; ++i) {
      const PictureError& error = picture_.errors[i];
      const std::size_t number = isMiss(error) ? ++misses : ++errors;
      if (!isSeen(error.at)) continue;
      Mark& mark = addMark(isMiss(error) ? misses_ : errors_, sheet(on(error.at)), number);
      mark.full = mark.full || error.kind == PictureError::Kind::UsedMiss;
    }
    for (const Mark& mark : marks)
      taken_.push_back(around(mark.at, 3));
    for (const std::vector<Mark>* list : {&misses_, &errors_})
      for (const Mark& mark : *list)
        taken_.push_back(around(mark.at, 7));
    if (marks.empty()) return;
    out_ += "<g font-size=\"12\" font-weight=\"bold\" stroke=\"#ffffff\" stroke-width=\"3\" "
            "paint-order=\"stroke\" "
            "stroke-linejoin=\"round\">\n";
    for (const Mark& mark : marks)
      out_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"3.2\" stroke-width=\"1\" fill=\"{}\"/>\n",
                          px(mark.at[0]), px(mark.at[1]), kContactColour);
    for (const Mark& mark : marks)
      label(mark.at, numbersText(mark.numbers), kContactColour);
    out_ += "</g>\n";
  }

  // Diamonds: full where the program took the end for the surface.
  void misses() {
    if (misses_.empty()) return;
    for (const Mark& mark : misses_)
      out_ += fmt::format("<path d=\"M{}l6.5 -6.5 6.5 6.5 -6.5 6.5z\" fill=\"{}\" stroke=\"#ffffff\" "
                          "stroke-width=\"5\" paint-order=\"stroke\"/><path d=\"M{}l6.5 -6.5 6.5 6.5 -6.5 "
                          "6.5z\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n",
                          pair({mark.at[0] - 6.5, mark.at[1]}), mark.full ? kErrorColour : "#ffffff",
                          pair({mark.at[0] - 6.5, mark.at[1]}), kErrorColour);
    names(misses_, "M");
  }
  void names(const std::vector<Mark>& marks, const char* letter) {
    out_ += "<g font-size=\"12.5\" font-weight=\"bold\" stroke=\"#ffffff\" stroke-width=\"3\" "
            "paint-order=\"stroke\" "
            "stroke-linejoin=\"round\">\n";
    for (const Mark& mark : marks)
      label(mark.at, letter + numbersText(mark.numbers), kErrorColour);
    out_ += "</g>\n";
  }

  void errors() {
    if (errors_.empty()) return;
    std::string d;
    for (const Mark& mark : errors_)
      d += fmt::format("M{}l11 11m0 -11l-11 11", pair({mark.at[0] - 5.5, mark.at[1] - 5.5}));
    // A light rim lifts the crosses off the hatching and off the path.
    out_ += fmt::format("<path d=\"{0}\" fill=\"none\" stroke=\"#ffffff\" stroke-width=\"6\" "
                        "stroke-linecap=\"round\"/>\n<path d=\"{0}\" fill=\"none\" stroke=\"{1}\" "
                        "stroke-width=\"2.6\"/>\n",
                        d, kErrorColour);
    names(errors_, "E");
  }

  const Picture& picture_;
  const Region& region_;
  const ViewFrame& frame_;
  std::array<std::size_t, 2> axes_;
  PlanePoint least_{}, most_{};
  Box box_{};
  std::string out_;
  std::vector<Mark> errors_, misses_;
  std::vector<Box> taken_;
};

} // namespace

const PathStyle& pathStyle(PathKind kind) {
  static constexpr PathStyle kStyles[] = {
      {"#6a4f00", "6 4", "1.6"},      // rapid
      {"#0a529a", "", "1.7"},         // feed
      {"#005c46", "10 3 2 3", "2.1"}, // protected
      {"#960f80", "", "4"},           // measuring
  };
  return kStyles[static_cast<std::size_t>(kind)];
}

double roundLength(double most) {
  const double power = std::pow(10, std::floor(std::log10(most)));
  const double share = most / power * (1 + 1e-9);
  return power * (share >= 5 ? 5 : share >= 2 ? 2 : 1);
}

std::string drawView(const Picture& picture, const Region& region, const ViewFrame& frame,
                     const Section* section) {
  return View(picture, region, frame).draw(section);
}

} // namespace dotek::sim
