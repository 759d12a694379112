// The parts of both pictures that are read, not looked at: the banner, and the table of what was measured.
#pragma once

#include "sim/picture/Picture.h"

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace dotek::sim {

// Bands of a banner: white text on them has a contrast of at least 4.5:1, in light and in dark.
std::string_view bannerColour(Verdict verdict);
std::string_view verdictName(Verdict verdict); // "pass", "doubt", "fail"

// Text in lines of at most `width` characters, broken at blanks where there are any.
std::vector<std::string> wrapped(std::string_view text, std::size_t width);

// The <g> of the banner over a sheet of this width, from its upper edge on; `height`: what it takes.
std::string bannerSvg(const PictureResult& result, double left, double width, double& height);
// An element of the page.
std::string bannerHtml(const PictureResult& result);

// The table of what was measured as plain text, a line each, for a terminal; `leftOut`: entries that are not
// kept. "": nothing was. `control`: that the program ran on; "": none.
std::string measuredText(const std::vector<PictureMeasured>& measured, std::size_t leftOut, int decimals,
                         const std::string& control);
// What was measured: feature, nominal, measured, deviation, and the offsets that were written. `at`: the
// upper edge, then the lower one. "": nothing was.
std::string measuredSvg(const Picture& picture, double left, double& at);
// A section of the page; `place`: of a move, in the moves of the page.
std::string measuredHtml(const Picture& picture, const std::function<std::size_t(std::size_t)>& place);
// The lists; "": there are none. `at` as above.
std::string listsSvg(const Picture& picture, double left, double& at);
std::string listsHtml(const Picture& picture); // a section of the page each

} // namespace dotek::sim
