#include "sim/picture/PictureReport.h"

#include "sim/picture/PictureText.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace dotek::sim {

std::string_view bannerColour(Verdict verdict) {
  switch (verdict) {
  case Verdict::Pass: return "#0b6636";
  case Verdict::Doubt: return "#7a4d00";
  case Verdict::Fail: return "#a80b22";
  }
  return "";
}

std::string_view verdictName(Verdict verdict) {
  switch (verdict) {
  case Verdict::Pass: return "pass";
  case Verdict::Doubt: return "doubt";
  case Verdict::Fail: return "fail";
  }
  return "";
}

std::vector<std::string> wrapped(std::string_view text, std::size_t width) {
  std::vector<std::string> out;
  while (text.size() > width) {
    std::size_t at = text.rfind(' ', width);
    if (at == std::string_view::npos || at < width / 2) {
      at = width;
      while (at > 1 && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80)
        --at;
    }
    out.emplace_back(text.substr(0, at));
    text.remove_prefix(at);
    while (text.starts_with(' '))
      text.remove_prefix(1);
  }
  if (!text.empty() || out.empty()) out.emplace_back(text);
  return out;
}

std::string bannerSvg(const PictureResult& result, double left, double width, double& height) {
  constexpr std::size_t kMost = 600; // bytes of a text
  std::string text;
  double at = 40;
  const auto line = [&](std::string_view what, const char* style) {
    text += fmt::format("<text x=\"{}\" y=\"{}\" {}>{}</text>\n", shortNumber(left, 2), shortNumber(at, 2),
                        style, xmlText(what));
  };
  line(result.word, "font-size=\"27\" font-weight=\"bold\"");
  at += 7;
  for (const std::string& part : wrapped(std::string_view(result.text).substr(0, kMost),
                                         static_cast<std::size_t>((width - 2 * left) / 7.9))) {
    at += 20;
    line(part, "font-size=\"15.5\"");
  }
  at += 3;
  const auto small = static_cast<std::size_t>((width - 2 * left) / 7);
  const auto add = [&](const std::string& what, const char* style) {
    if (what.empty()) return;
    for (const std::string& part : wrapped(std::string_view(what).substr(0, kMost), small)) {
      at += 18;
      line(part, style);
    }
  };
  if (!result.place.empty()) add("at " + result.place, "font-size=\"13\"");
  add(result.block, "font-size=\"13\" font-family=\"Consolas, DejaVu Sans Mono, monospace\"");
  add(result.position, "font-size=\"13\"");
  add(fmt::format("{}", fmt::join(result.counts, ", ")), "font-size=\"13\" font-weight=\"bold\"");
  height = at + 16;
  return fmt::format("<g id=\"banner\" class=\"{}\" fill=\"#ffffff\">\n<rect width=\"{}\" height=\"{}\" "
                     "fill=\"{}\"/>\n{}</g>\n",
                     verdictName(result.verdict), shortNumber(width, 2), shortNumber(height, 2),
                     bannerColour(result.verdict), text);
}

namespace {

// XML of a text for a page; a number does not break at its sign.
std::string unbroken(std::string_view text, std::size_t most) {
  std::string out;
  const std::string all = xmlText(text, most);
  for (std::size_t at = 0; at < all.size();) {
    const std::size_t blank = std::min(all.find(' ', at), all.size());
    const std::string word = all.substr(at, blank - at);
    const std::size_t sign = word.find('-');
    const bool isNumber = sign != std::string::npos && sign <= 1 && word.size() < 24 &&
                          sign + 1 < word.size() && word[sign + 1] >= '0' && word[sign + 1] <= '9';
    out += isNumber ? fmt::format("<span class=\"n\">{}</span>", word) : word;
    if (blank < all.size()) out += ' ';
    at = blank + 1;
  }
  return out;
}

} // namespace

std::string bannerHtml(const PictureResult& result) {
  std::string out = fmt::format("<div id=\"banner\" class=\"{}\" style=\"background:{}\" role=\"status\">\n"
                                "<strong>{}</strong>\n<div><p>{}</p>\n",
                                verdictName(result.verdict), bannerColour(result.verdict),
                                xmlText(result.word, 100), unbroken(result.text, 600));
  if (!result.place.empty() || !result.block.empty())
    out += fmt::format("<p class=\"at\">{}{} <code>{}</code></p>\n", result.place.empty() ? "" : "at ",
                       xmlText(result.place, 300), xmlText(result.block, 200));
  if (!result.position.empty())
    out += fmt::format("<p class=\"at\">{}</p>\n", unbroken(result.position, 200));
  out += "</div>\n<ul>";
  for (const std::string& count : result.counts)
    out += fmt::format("<li>{}</li>", xmlText(count, 60));
  return out + "</ul>\n</div>";
}

} // namespace dotek::sim
