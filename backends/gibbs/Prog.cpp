// The branch of the Prog: blocks of the control with fields of the CAM where numbers are.
#include "backends/gibbs/Emit.h"
#include "support/Ascii.h"

#include <algorithm>
#include <fmt/format.h>

namespace dotek::backends::gibbs {

namespace {

constexpr char kOpen = '\x01', kClose = '\x02', kClearance = '\x03';

std::string quoted(std::string text) {
  std::replace(text.begin(), text.end(), '\'', ' '); // no escape is known
  return "'" + text + "'";
}

bool endsWord(char c) {
  return c == ' ' || c == '\0';
}

// One block as pieces of the Prog. nullopt: the clearance plane is no word of its own.
std::optional<std::string> pieces(const std::string& block) {
  std::string out, literal = " ";
  const auto flush = [&] {
    if (!literal.empty()) out += (out.empty() || out.ends_with(' ') ? "" : " ") + quoted(literal);
    literal.clear();
  };
  for (std::size_t i = 0; i < block.size();) {
    if (block[i] == kClearance) {
      const char next = i + 1 < block.size() ? block[i + 1] : '\0';
      if (!literal.ends_with(" Z") || !endsWord(next)) return std::nullopt;
      literal.resize(literal.size() - 2);
      flush();
      out += " ZCP1";
      ++i;
      continue;
    }
    if (block[i] != kOpen) {
      literal += block[i++];
      continue;
    }
    const std::size_t end = block.find(kClose, i);
    const std::string field = block.substr(i + 1, end - i - 1);
    const char before = literal.empty() ? '\0' : literal.back();
    const char next = end + 1 < block.size() ? block[end + 1] : '\0';
    i = end + 1;
    const bool word = isCapital(before) && endsWord(next);
    const bool whole = word || before == '[' || before == '=' || before == ' ';
    // A number may print its own sign, which cannot follow another one.
    const bool negated = before == '-' && literal.size() > 1 && isCapital(literal[literal.size() - 2]);
    if (negated) {
      literal.back() = '[';
      literal += '-';
    }
    if (!whole) literal += '[';
    flush();
    out += "OpFieldData#('" + field + "')";
    if (!whole) literal += ']';
    if (negated) literal += ']';
  }
  flush();
  return out;
}

} // namespace

std::string hole(std::string_view field) {
  return kOpen + std::string(field) + kClose;
}
std::string clearanceHole() {
  return std::string(1, kClearance);
}

std::optional<std::vector<EmittedLine>> progBranch(const Folder& folder, const std::vector<Block>& blocks,
                                                   int decimals, const std::vector<std::string>& remarks) {
  std::vector<EmittedLine> out;
  const auto add = [&](std::string text) { out.push_back({std::move(text), {}, ""}); };
  add("{ Branch of the Prog for the cycle " + folder.name +
      ". Copy it into the routine of the post that prints");
  add("  drill cycles, and take over the picture: a point always, 0 for zero. }");
  for (const std::string& remark : remarks)
    add("{ " + remark + " }");
  std::string picture = "#1 = '#####." + std::string(static_cast<std::size_t>(decimals), '#') + ";0'";
  const bool selects = std::any_of(blocks.begin(), blocks.end(), [](const Block& block) {
    return block.out.text.find(std::string(" S") + kOpen) != std::string::npos;
  });
  if (selects)
    picture += " { dotek: ignore-file selector-with-point -- a work offset is printed as a length is }";
  add(picture);
  add("FORMAT(OpFieldData#,1)");
  add("");
  add("probe:");
  add("IF CycleType?('" + folder.name + "')");
  for (const Block& block : blocks) {
    const std::string& text = block.out.text;
    std::string printed;
    if (text == "M5")
      printed = " SeqC SpinOff EOL";
    else if (text == "M9")
      printed = " SeqC CoolOff EOL";
    else {
      const auto given = pieces(text);
      if (!given) return std::nullopt;
      printed = (block.numbered || block.comment ? " " : " SeqC ") + *given + " EOL";
    }
    out.push_back({std::move(printed), block.out.ranges, block.out.reason});
  }
  add("END");
  add("RETURN");
  return out;
}

} // namespace dotek::backends::gibbs
