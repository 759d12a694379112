#include "sim/picture/Lattice.h"
#include "sim/picture/Picture.h"
#include "sim/picture/PicturePage.h"
#include "sim/picture/PicturePlanes.h"
#include "sim/picture/PictureReport.h"
#include "sim/picture/PictureResult.h"
#include "sim/picture/PictureText.h"
#include "sim/picture/PictureView.h"
#include "sim/picture/SurfaceMesh.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace dotek::sim {
namespace {

// What the page holds at most; its head reports the rest.
constexpr std::size_t kMostMoves = 250'000;
constexpr std::size_t kMostBlocks = 300'000;
constexpr std::size_t kMostMarks = 20'000; // contacts, and errors
constexpr double kMeshUnit = 0.001;        // mm

std::string number(double value) {
  return std::isfinite(value) ? shortNumber(value, 6) : "null";
}
std::string numbers(const Point3& p) {
  return number(p.x) + ',' + number(p.y) + ',' + number(p.z);
}

class Page {
public:
  explicit Page(const Picture& picture) : picture_(picture), region_(regionOf(picture)) {}

  std::string make() {
    choose();
    const std::string all = data();
    std::string out;
    out.reserve(all.size() + 64'000);
    const std::string_view frame = pageFrame();
    for (std::size_t at = 0; at < frame.size();) {
      const std::size_t open = frame.find('@', at);
      const std::size_t close = open == std::string_view::npos ? open : frame.find('@', open + 1);
      if (close == std::string_view::npos) {
        out += frame.substr(at);
        break;
      }
      out += frame.substr(at, open - at);
      const std::string_view mark = frame.substr(open + 1, close - open - 1);
      if (mark == "TAB")
        out += xmlText((picture_.result ? picture_.result->word + " - " : "") + picture_.title, 300);
      if (mark == "TITLE") out += xmlText(picture_.title, 300);
      if (mark == "CONTROL" && !picture_.control.empty())
        out += fmt::format(" <small>run on {}</small>", xmlText(picture_.control, 100));
      if (mark == "DATE" && !picture_.date.empty())
        out += fmt::format(" <small>{}</small>", xmlText(picture_.date, 100));
      if (mark == "MEASURED") out += measuredHtml(picture_, [&](std::size_t move) { return placeOf(move); });
      if (mark == "LISTS") out += listsHtml(picture_);
      if (mark == "BANNER" && picture_.result) out += bannerHtml(*picture_.result);
      if (mark == "STYLE") out += pageStyle();
      if (mark == "NOTES") out += notes();
      if (mark == "LEGEND") out += legend();
      if (mark == "DATA") out += all;
      if (mark == "VIEW") out += pageView();
      if (mark == "SCRIPT") out += pageScript();
      at = close + 1;
    }
    return out;
  }

private:
  // Which moves the page holds: all, or every n-th and those with a contact or an error.
  void choose() {
    const std::size_t count = picture_.moves.size();
    chosen_.resize(count);
    std::iota(chosen_.begin(), chosen_.end(), std::size_t{0});
    place_ = chosen_;
    if (count <= kMostMoves) return;
    every_ = (count + kMostMoves - 1) / kMostMoves;
    std::vector<bool> marked(count);
    for (std::size_t i = 0; i < picture_.contacts.size() && i < kMostMarks; ++i)
      if (picture_.contacts[i].move < count) marked[picture_.contacts[i].move] = true;
    for (std::size_t i = 0; i < picture_.errors.size() && i < kMostMarks; ++i)
      if (picture_.errors[i].move < count) marked[picture_.errors[i].move] = true;
    chosen_.clear();
    for (std::size_t i = 0; i < count; ++i) {
      place_[i] = chosen_.size();
      if (i % every_ == every_ - 1 || marked[i] || i + 1 == count) chosen_.push_back(i);
    }
  }

  std::string notes() const {
    std::string out;
    const auto note = [&](const std::string& text) {
      out += fmt::format("<p class=\"note\">{}</p>\n", text);
    };
    if (every_ > 1)
      note(fmt::format("{} moves: one of {} is on the page, and those with a contact or an error",
                       picture_.moves.size(), every_));
    if (picture_.blocks.size() > kMostBlocks)
      note(fmt::format("{} blocks: the first {} are listed", picture_.blocks.size(), kMostBlocks));
    if (picture_.contacts.size() > kMostMarks)
      note(fmt::format("{} contacts: the first {} are drawn", picture_.contacts.size(), kMostMarks));
    if (picture_.errors.size() > kMostMarks)
      note(fmt::format("{} errors: the first {} are listed", picture_.errors.size(), kMostMarks));
    const auto lost = std::count_if(picture_.moves.begin(), picture_.moves.end(),
                                    [](const PictureMove& move) { return !isDrawn(move); });
    if (lost > 0) note(fmt::format("moves without a number, or beyond 1 km: {}; they are not drawn", lost));
    if (!hasProbe(picture_)) note("no probe is stated: the path is that of the spindle's gauge line");
    for (const PictureTool& tool : picture_.tools)
      if (!tool.listed) note("the path: " + toolNote(tool, picture_.decimals));
    if (!picture_.part) note("no part: only the path is drawn");
    if (picture_.setter) note("tool setter at machine " + pointText(picture_.setter->at, picture_.decimals));
    if (const std::string cut = cutNote(picture_, region_); !cut.empty()) note(cut);
    if (const std::string missed = missedNote(mesh_.missed); !missed.empty()) note(missed);
    return out;
  }

  std::string legend() const {
    std::string out;
    for (const PathKind kind : {PathKind::Rapid, PathKind::Feed, PathKind::Protected, PathKind::Measuring}) {
      const PathStyle& style = pathStyle(kind);
      out += fmt::format(
          "<div><svg width=\"44\" height=\"10\"><path d=\"M0 5h44\" style=\"stroke:var(--{})\" "
          "stroke-width=\"{}\" stroke-dasharray=\"{}\"/></svg>{}</div>\n",
          pathKindName(kind), style.width, *style.dashes == '\0' ? "none" : style.dashes, pathKindName(kind));
    }
    const auto misses =
        static_cast<std::size_t>(std::count_if(picture_.errors.begin(), picture_.errors.end(), isMiss));
    out += fmt::format(
        "<div><svg width=\"44\" height=\"10\"><circle cx=\"22\" cy=\"5\" r=\"3.4\" "
        "style=\"fill:var(--contact)\"/></svg>"
        "contact ({})</div>\n<div><svg width=\"44\" height=\"12\"><path d=\"M17 1l10 10m0 -10l-10 10\" "
        "style=\"stroke:var(--error)\" stroke-width=\"2.6\"/></svg>error ({})</div>\n"
        "<div title=\"full: the program took the end of the move for the surface\"><svg width=\"44\" "
        "height=\"14\" style=\"stroke:var(--error)\" stroke-width=\"2\"><path d=\"M5 7l6 -6 6 6 -6 6z\" "
        "style=\"fill:var(--error)\"/><path d=\"M25 7l6 -6 6 6 -6 6z\" style=\"fill:none\"/></svg>miss "
        "({})</div>\n",
        picture_.contacts.size(), picture_.errors.size() - misses, misses);
    out += "<div><svg width=\"44\" height=\"14\"><circle cx=\"13\" cy=\"7\" r=\"6\" fill=\"#f0a614\"/>"
           "<circle cx=\"31\" cy=\"7\" r=\"6\" fill=\"#545c66\"/></svg>probe on, off</div>";
    if (picture_.setter)
      out += "\n<div><svg width=\"44\" height=\"14\"><ellipse cx=\"22\" cy=\"7\" rx=\"12\" ry=\"5\" "
             "style=\"fill:none;stroke:var(--ink)\"/></svg>tool setter</div>";
    return out;
  }

  std::string data() {
    const Probe& probe = picture_.probe;
    const auto size = [](double value) {
      return std::isfinite(value) && value > 0 && value < kDrawn ? value : 0;
    };
    std::string out = fmt::format("{{\"count\":{},\"still\":{},\"decimals\":{},\n\"kinds\":[",
                                  moveCount(picture_), picture_.still, std::clamp(picture_.decimals, 0, 6));
    for (int i = 0; i < 4; ++i) {
      const auto kind = static_cast<PathKind>(i);
      const PathStyle& style = pathStyle(kind);
      std::string dashes = style.dashes;
      std::replace(dashes.begin(), dashes.end(), ' ', ',');
      out += fmt::format("{}{{\"name\":\"{}\",\"width\":{},\"dashes\":[{}]}}", i == 0 ? "" : ",",
                         pathKindName(kind), style.width, dashes);
    }
    out += fmt::format("],\n\"region\":[{},{}],\n", numbers(region_.least), numbers(region_.most));
    out += "\"probe\":";
    out += !hasProbe(picture_)
               ? "null,\n"
               : fmt::format("{{\"ball\":{},\"stem\":[{},{}],\"body\":[{},{}],\"length\":{}}},\n",
                             number(size(probe.ballRadius())), number(size(probe.stemDiameter) / 2),
                             number(size(probe.stemLength)), number(size(probe.bodyDiameter) / 2),
                             number(size(probe.bodyLength)),
                             number(std::isfinite(probe.centreLength()) ? probe.centreLength() : 0));
    out += "\"tools\":[";
    for (std::size_t i = 0; i < picture_.tools.size(); ++i)
      out += fmt::format("{}[{},{},{},{}]", i == 0 ? "" : ",", picture_.tools[i].number,
                         number(size(picture_.tools[i].length)), number(size(picture_.tools[i].diameter / 2)),
                         picture_.tools[i].listed ? 1 : 0);
    out += "],\n";
    out += picture_.setter && isDrawn(picture_.setter->at)
               ? fmt::format("\"setter\":{{\"at\":[{}],\"radius\":{}}},\n", numbers(picture_.setter->at),
                             number(size(picture_.setter->diameter / 2)))
               : "\"setter\":null,\n";
    // The move with which the page opens; null: the last one.
    const std::optional<std::size_t> failure = failureOf(picture_);
    out += fmt::format("\"opens\":{},\n",
                       failure ? std::to_string(placeOf(picture_.errors[*failure].move)) : "null");
    // The error that the picture is about, of those that the page holds.
    out +=
        fmt::format("\"fails\":{},\n", failure && *failure < kMostMarks ? std::to_string(*failure) : "null");
    way(out);
    frames(out);
    spindle(out);
    marks(out);
    out += "\"blocks\":[";
    for (std::size_t i = 0; i < picture_.blocks.size() && i < kMostBlocks; ++i)
      out += fmt::format("{}[{},{},{}]", i == 0 ? "" : ",\n", jsonText(picture_.blocks[i].text, 200),
                         jsonText(picture_.blocks[i].place, 200), jsonText(picture_.blocks[i].program, 40));
    out += "],\n";
    surface(out);
    return out + "}";
  }

  void way(std::string& out) const {
    out += "\"way\":[";
    std::string jumps;
    const PictureMove* before = nullptr;
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      const PictureMove& move = picture_.moves[chosen_[i]];
      out += fmt::format("{}{},{},{},{}", i == 0 ? "" : ",\n", static_cast<int>(move.kind),
                         move.probeOn ? 1 : 0, move.block, numbers(move.to));
      const Point3 from =
          picture_.moves[i == 0 ? 0 : chosen_[i - 1] + 1].from; // the first of those it stands for
      if (before == nullptr || !(before->to == from))
        jumps += fmt::format("{}[{},{}]", jumps.empty() ? "" : ",", i, numbers(from));
      before = &move;
    }
    out += "],\n\"jumps\":[" + jumps + "],\n\"numbers\":";
    if (every_ == 1) {
      out += "null,\n";
      return;
    }
    out += '[';
    for (std::size_t i = 0; i < chosen_.size(); ++i)
      out += fmt::format("{}{}", i == 0 ? "" : ",", chosen_[i]);
    out += "],\n";
  }

  // Tools beside the probe: of moves in a row the first, their number, and the tool's place.
  void spindle(std::string& out) const {
    out += "\"spindle\":[";
    const auto toolAt = [&](std::size_t i) { return picture_.moves[chosen_[i]].tool; };
    const std::size_t begin = out.size();
    for (std::size_t i = 0; i < chosen_.size();) {
      std::size_t end = i + 1;
      while (end < chosen_.size() && toolAt(end) == toolAt(i))
        ++end;
      if (toolAt(i) > 0 && toolAt(i) <= picture_.tools.size())
        out += fmt::format("{}[{},{},{}]", out.size() == begin ? "" : ",", i, end - i, toolAt(i) - 1);
      i = end;
    }
    out += "],\n";
  }

  // Work coordinates: each set of them, with the axes that are not known in the machine either, and of moves
  // in a row the first, their number and the set.
  void frames(std::string& out) const {
    out += "\"frames\":[";
    for (std::size_t i = 0; i < picture_.frames.size(); ++i)
      out += fmt::format("{}[{},{},{}]", i == 0 ? "" : ",", jsonText(picture_.frames[i].name, 40),
                         numbers(picture_.frames[i].shift), picture_.frames[i].unknown);
    out += "],\n\"framed\":[";
    const auto frameAt = [&](std::size_t i) { return picture_.moves[chosen_[i]].frame; };
    const std::size_t begin = out.size();
    for (std::size_t i = 0; i < chosen_.size();) {
      std::size_t end = i + 1;
      while (end < chosen_.size() && frameAt(end) == frameAt(i))
        ++end;
      if (frameAt(i) < picture_.frames.size())
        out += fmt::format("{}[{},{},{}]", out.size() == begin ? "" : ",", i, end - i, frameAt(i));
      i = end;
    }
    out += "],\n";
  }

  std::size_t placeOf(std::size_t move) const {
    return move < place_.size() ? place_[move] : place_.empty() ? 0 : chosen_.size() - 1;
  }

  void marks(std::string& out) const {
    out += "\"contacts\":[";
    for (std::size_t i = 0; i < picture_.contacts.size() && i < kMostMarks; ++i) {
      const PictureContact& contact = picture_.contacts[i];
      out += fmt::format("{}[{},{}]", i == 0 ? "" : ",", numbers(contact.point), placeOf(contact.move));
    }
    out += "],\n\"errors\":[";
    for (std::size_t i = 0; i < picture_.errors.size() && i < kMostMarks; ++i) {
      const PictureError& error = picture_.errors[i];
      const std::optional<std::size_t> block = blockOf(picture_, error);
      out += fmt::format("{}[{},{},{},{},{}]", i == 0 ? "" : ",\n", numbers(error.at), placeOf(error.move),
                         jsonText(error.text, 600), block ? std::to_string(*block) : "null",
                         static_cast<int>(error.kind));
    }
    out += "],\n";
  }

  void surface(std::string& out) {
    const double longest = std::max({region_.most.x - region_.least.x, region_.most.y - region_.least.y,
                                     region_.most.z - region_.least.z});
    // A part that is large for what was measured is drawn finer.
    if (picture_.part) mesh_ = surfaceOf(*picture_.part, region_, longest > 150 ? 160 : 112);
    const SurfaceMesh& mesh = mesh_;
    const double unit = std::max(kMeshUnit, std::pow(10, std::ceil(std::log10(longest)) - 6));
    out += fmt::format("\"open\":{},\n", cutSidesOf(picture_, region_).empty() ? "false" : "true");
    out += fmt::format("\"mesh\":{{\"unit\":{},\n\"vertices\":[", number(unit));
    const auto whole = [&](double value) { return static_cast<std::int64_t>(std::llround(value / unit)); };
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      const Point3 p = mesh.vertices[i] - region_.least;
      out += fmt::format("{}{},{},{}", i == 0 ? "" : ",", whole(p.x), whole(p.y), whole(p.z));
    }
    out += "],\n\"triangles\":[";
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const auto& t = mesh.triangles[i];
      out += fmt::format("{}{},{},{}", i == 0 ? "" : ",", t[0], t[1], t[2]);
    }
    out += "]}";
  }

  const Picture& picture_;
  Region region_;
  SurfaceMesh mesh_;
  std::size_t every_ = 1;
  std::vector<std::size_t> chosen_; // places in Picture::moves
  std::vector<std::size_t> place_;  // of each move in chosen_, of the next one that is there
};

} // namespace

std::string pictureHtml(const Picture& picture) {
  return Page(picture).make();
}

} // namespace dotek::sim
