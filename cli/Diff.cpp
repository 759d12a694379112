#include "cli/Diff.h"

#include "support/Printable.h"
#include "support/Source.h"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <vector>

namespace dotek::cli {
namespace {

struct Line {
  std::string_view text; // without its end
  std::string_view end;  // "\n", "\r\n", "" for a last line without one

  // Ends by CR LF and by LF count alike.
  bool operator==(const Line& other) const { return text == other.text && end.empty() == other.end.empty(); }
};
using Lines = std::vector<Line>;

Lines linesOf(std::string_view text) {
  Lines out;
  while (!text.empty()) {
    const std::size_t at = std::min(text.find('\n'), text.size());
    const std::size_t after = std::min(at + 1, text.size());
    const std::size_t body = at > 0 && at < text.size() && text[at - 1] == '\r' ? at - 1 : at;
    out.push_back({text.substr(0, body), text.substr(body, after - body)});
    text.remove_prefix(after);
  }
  return out;
}

constexpr std::size_t kMostCells = 4'000'000; // of the table below
constexpr std::size_t kAround = 3;            // lines before and after a change

// Without what would steer a terminal. A patch keeps the bytes of the file: tabs, and letters that are no
// UTF-8.
std::string shown(std::string_view text, bool terminal) {
  if (terminal) return printable(text);
  std::string out;
  if (!isUtf8(text)) {
    for (const char c : text)
      out += (c >= 0 && c < ' ' && c != '\t') || c == '\x7F' ? '?' : c;
    return out;
  }
  for (;;) {
    const std::size_t tab = text.find('\t');
    out += printable(text.substr(0, tab));
    if (tab == std::string_view::npos) return out;
    out += '\t';
    text.remove_prefix(tab + 1);
  }
}

struct Step {
  char sign = ' '; // `-` of the first text, `+` of the second, ` ` of both
  Line line;
};

// From the one text to the other.
std::vector<Step> stepsOf(const Lines& a, const Lines& b) {
  std::size_t first = 0, endA = a.size(), endB = b.size();
  while (first < endA && first < endB && a[first] == b[first])
    ++first;
  while (endA > first && endB > first && a[endA - 1] == b[endB - 1])
    --endA, --endB;
  const std::size_t rows = endA - first, columns = endB - first;
  // Length of what the rests have in common.
  const bool whole = (rows + 1) * (columns + 1) > kMostCells;
  std::vector<std::uint32_t> common(whole ? 0 : (rows + 1) * (columns + 1));
  const auto at = [&](std::size_t i, std::size_t j) -> std::uint32_t& {
    return common[i * (columns + 1) + j];
  };
  for (std::size_t i = whole ? 0 : rows; i-- > 0;)
    for (std::size_t j = columns; j-- > 0;)
      at(i, j) = a[first + i] == b[first + j] ? at(i + 1, j + 1) + 1 : std::max(at(i + 1, j), at(i, j + 1));
  std::vector<Step> out;
  for (std::size_t i = 0; i < first; ++i)
    out.push_back({' ', a[i]});
  std::size_t i = 0, j = 0;
  while (i < rows || j < columns) {
    if (!whole && i < rows && j < columns && a[first + i] == b[first + j]) {
      out.push_back({' ', a[first + i++]});
      ++j;
      continue;
    }
    std::vector<Step> added;
    while ((i < rows || j < columns) &&
           (whole || i == rows || j == columns || !(a[first + i] == b[first + j]))) {
      if (i < rows && (whole || j == columns || at(i + 1, j) >= at(i, j + 1)))
        out.push_back({'-', a[first + i++]});
      else
        added.push_back({'+', b[first + j++]});
    }
    out.insert(out.end(), added.begin(), added.end());
  }
  for (std::size_t k = endA; k < a.size(); ++k)
    out.push_back({' ', a[k]});
  return out;
}

// `12,3`; of no line, the number of the one before it.
std::string placeOf(std::size_t before, std::size_t count) {
  return fmt::format("{},{}", before + (count > 0 ? 1 : 0), count);
}

} // namespace

std::string lineDiff(const std::string& name, std::string_view before, std::string_view after,
                     bool terminal) {
  const std::vector<Step> steps = stepsOf(linesOf(before), linesOf(after));
  const auto changes = [](const Step& one) { return one.sign != ' '; };
  auto next = std::find_if(steps.begin(), steps.end(), changes);
  if (next == steps.end()) return "";
  // A blank in the name would end it.
  const std::string file = printable(name) + (name.find(' ') == std::string::npos ? "" : "\t");
  std::string out = fmt::format("--- {0}\n+++ {0}\n", file);
  std::size_t done = 0, inA = 0, inB = 0; // steps, and lines of both texts before them
  while (next != steps.end()) {
    const auto from = static_cast<std::size_t>(next - steps.begin());
    std::size_t end = from;
    // Changes with few lines between them are one.
    while (next != steps.end() && static_cast<std::size_t>(next - steps.begin()) <= end + 2 * kAround) {
      end = static_cast<std::size_t>(next - steps.begin()) + 1;
      next = std::find_if(next + 1, steps.end(), changes);
    }
    const std::size_t begin = std::max(done, from - std::min(from, kAround));
    end = std::min(end + kAround, steps.size());
    inA += begin - done;
    inB += begin - done;
    std::string lines;
    std::size_t ofA = 0, ofB = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [sign, line] = steps[i];
      ofA += sign == '+' ? 0 : 1;
      ofB += sign == '-' ? 0 : 1;
      lines += sign + shown(line.text, terminal);
      if (line.end.empty())
        lines += "\n\\ No newline at end of file\n";
      else
        lines += terminal ? "\n" : line.end;
    }
    out += fmt::format("@@ -{} +{} @@\n{}", placeOf(inA, ofA), placeOf(inB, ofB), lines);
    inA += ofA;
    inB += ofB;
    done = end;
  }
  return out;
}

} // namespace dotek::cli
