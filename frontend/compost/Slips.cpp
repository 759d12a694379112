#include "frontend/compost/Slips.h"

#include "support/NearestName.h"

#include <algorithm>
#include <string>
#include <vector>

namespace dotek::frontend::compost {
namespace {

// `SpinOff` is Spin and Off; a number is a part of its own.
std::vector<std::string> partsOf(std::string_view name) {
  std::vector<std::string> out;
  const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
  const auto isUpper = [](char c) { return c >= 'A' && c <= 'Z'; };
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool begins =
        i == 0 || isDigit(name[i]) != isDigit(name[i - 1]) || (isUpper(name[i]) && !isUpper(name[i - 1]));
    if (begins) out.emplace_back();
    out.back() += name[i];
  }
  return out;
}

// Spindle and Spin, Oper and Op.
bool writtenOut(std::string_view one, std::string_view other) {
  const std::vector<std::string> a = partsOf(one);
  const std::vector<std::string> b = partsOf(other);
  if (a.size() < 2 || a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == b[i]) continue;
    const std::string& shorter = a[i].size() < b[i].size() ? a[i] : b[i];
    const std::string& longer = a[i].size() < b[i].size() ? b[i] : a[i];
    if (shorter.size() < 2 || !longer.starts_with(shorter)) return false;
  }
  return true;
}

// Digits and capitals, which tell members of a family apart.
std::string marksOf(std::string_view name) {
  std::string out;
  for (const char c : name)
    if ((c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z')) out += c;
  return out;
}

// doWashOn and doWashOff.
bool switchesOther(std::string_view one, std::string_view other) {
  const auto ends = [](std::string_view name, std::string_view end) { return name.ends_with(end); };
  return (ends(one, "On") && ends(other, "Off")) || (ends(one, "Off") && ends(other, "On"));
}

} // namespace

bool isSlip(std::string_view written, std::string_view known) {
  if (written == known || std::min(written.size(), known.size()) < 4) return false;
  if (switchesOther(written, known)) return false;
  if (writtenOut(written, known)) return true;
  const std::size_t allowed = known.size() >= 9 ? 2 : 1;
  return nameDistance(written, known, allowed) <= allowed && marksOf(written) == marksOf(known);
}

} // namespace dotek::frontend::compost
