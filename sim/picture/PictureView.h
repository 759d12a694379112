// One of the three views of an SVG: a section of the part, the path, contacts and errors on it.
#pragma once

#include "sim/picture/PictureRegion.h"
#include "sim/picture/Sections.h"

#include <string>
#include <vector>

namespace dotek::sim {

// Where a view is on the sheet, px.
struct ViewFrame {
  std::size_t across = 2; // the axis that is not seen
  double left = 0, top = 0;
  double scale = 1;    // px per mm
  std::string heading; // behind the view's name; XML
};

// How a kind of move is drawn: told apart by colour and by line, so that grey is enough. The colours have a
// contrast of at least 4.5:1 on paper and on the part; picture.css has them for the page, light and dark.
struct PathStyle {
  const char* colour;
  const char* dashes; // "": solid
  const char* width;  // px
};
const PathStyle& pathStyle(PathKind kind);

inline constexpr const char* kErrorColour = "#a80b22";
inline constexpr const char* kContactColour = "#111111";
inline constexpr const char* kSetterColour = "#39424d";
inline constexpr const char* kWorkColour = "#0a529a"; // numbers of work coordinates

// What a picture shows of its lists at most; the legend reports the rest.
inline constexpr std::size_t kMostNumbered = 400; // contacts with a number
inline constexpr std::size_t kMostErrors = 30;
inline constexpr std::size_t kThinFrom = 5000; // from here on moves below half a px are joined

// A length of 1, 2 or 5 times a power of ten, at most `most`.
double roundLength(double most);

// The <g> of a view.
std::string drawView(const Picture& picture, const Region& region, const ViewFrame& frame,
                     const Section* section);

} // namespace dotek::sim
