// Every message is produced by some test and keeps to the wording of docs/diagnostics.md.
#include "support/Diagnostics.h"
#include "tests/policy/Tree.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <doctest/doctest.h>
#include <map>
#include <set>
#include <string_view>

using namespace dotek;
using namespace dotek::tests;

namespace {

// Codes that no test can produce, each with its reason.
const std::map<std::string, std::string, std::less<>>& exemptions() {
  static const std::map<std::string, std::string, std::less<>> kExemptions = {};
  return kExemptions;
}

struct Message {
  std::string id;
  std::string code;
  std::string format;
};

// Words that judge the user or beg.
constexpr std::array<std::string_view, 5> kBlame = {"illegal", "invalid", "must", "please", "sorry"};

// The string literal that begins at or after `at`; `at` moves after it.
std::string literal(const std::string& text, std::size_t& at) {
  std::string out;
  at = text.find('"', at) + 1;
  for (; at < text.size() && text[at] != '"'; ++at) {
    if (text[at] == '\\') ++at;
    out += text[at];
  }
  ++at;
  return out;
}

std::vector<Message> messages() {
  std::vector<Message> out;
  for (const TreeFile& file : tree()) {
    if (!file.below("support/messages") || !file.path.ends_with(".def")) continue;
    const std::string start = "DOTEK_DIAGNOSTIC(";
    for (std::size_t at = file.text.find(start); at != std::string::npos; at = file.text.find(start, at)) {
      at += start.size();
      Message message;
      message.id = file.text.substr(at, file.text.find(',', at) - at);
      message.code = literal(file.text, at);
      message.format = literal(file.text, at);
      for (std::size_t next = file.text.find_first_not_of(" \n", at); file.text[next] == '"';
           next = file.text.find_first_not_of(" \n", at))
        message.format += literal(file.text, at);
      out.push_back(message);
    }
  }
  return out;
}

std::set<std::string> producedCodes(const std::vector<Message>& all) {
  std::string goldens;
  std::string units;
  for (const TreeFile& file : tree()) {
    if (file.below("tests/golden") && (file.path.ends_with("/stdout") || file.path.ends_with("/stderr")))
      goldens += file.text;
    if (file.below("tests/unit")) units += file.text;
  }
  std::set<std::string> out;
  for (const Message& message : all) {
    const bool found = goldens.find("[" + message.code + "]") != std::string::npos ||
                       goldens.find("\"code\": \"" + message.code + "\"") != std::string::npos ||
                       units.find("\"" + message.code + "\"") != std::string::npos ||
                       units.find("[" + message.code + "]") != std::string::npos ||
                       units.find("diag::" + message.id + "::code") != std::string::npos;
    if (found) out.insert(message.code);
  }
  return out;
}

} // namespace

TEST_CASE("policy: the table of messages is read whole") {
  const auto all = messages();
  REQUIRE(all.size() == messageTable().size());
  std::set<std::string> codes;
  for (const Message& message : all)
    CHECK_MESSAGE(codes.insert(message.code).second, message.code << " appears twice");
  for (const MessageInfo& info : messageTable()) {
    CHECK(codes.contains(std::string(info.code)));
    CHECK_MESSAGE(info.explanation.size() > 20, info.code << " is not explained");
  }
}

TEST_CASE("policy: some test produces every message") {
  const auto all = messages();
  const auto produced = producedCodes(all);
  std::string missing;
  for (const Message& message : all) {
    const bool exempt = exemptions().contains(message.code);
    if (!produced.contains(message.code) && !exempt) missing += "\n  " + message.code;
    CHECK_MESSAGE(!(produced.contains(message.code) && exempt),
                  message.code << " is exempt, but a test names it");
  }
  CHECK_MESSAGE(missing.empty(), "no golden and no unit test names:" << missing);
  for (const auto& [code, reason] : exemptions()) {
    CHECK_MESSAGE(
        std::any_of(all.begin(), all.end(), [&, &c = code](const Message& m) { return m.code == c; }),
        code << " is exempt, but is no message");
  }
}

TEST_CASE("policy: wording of messages") {
  for (const Message& message : messages()) {
    INFO(message.code << ": " << message.format);
    for (const char c : message.code)
      CHECK((std::islower(static_cast<unsigned char>(c)) != 0 ||
             std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '-'));
    REQUIRE(!message.format.empty());
    // A capital begins only a word of a language, such as FOR, or a name, such as UTF-16 or CycleData.mac.
    const std::string first = message.format.substr(0, message.format.find_first_of(" :,"));
    const bool capital = !first.empty() && std::isupper(static_cast<unsigned char>(first[0])) != 0;
    const bool name = first.size() <= 1 || std::any_of(first.begin() + 1, first.end(), [](unsigned char c) {
                        return std::isupper(c) != 0 || std::isdigit(c) != 0 || c == '.';
                      });
    CHECK((!capital || name));
    CHECK(!message.format.ends_with('.'));
    const std::string text = lowerCase(message.format);
    for (const std::string_view word : kBlame)
      CHECK_MESSAGE(findWord(text, word) == std::string::npos, word);
  }
}

TEST_CASE("policy: wording of checks and rules") {
  std::size_t literals = 0;
  for (const TreeFile& file : tree()) {
    const bool check = file.below("frontend") && file.path.find("/Check") != std::string::npos;
    if (!file.path.ends_with(".cpp") || !(check || file.below("lint/rules"))) continue;
    for (const std::string& line : linesOf(file.text)) {
      const std::size_t comment = std::min(line.find("// "), line.size());
      for (std::size_t at = line.find('"'); at < comment; at = line.find('"', at)) {
        const std::string text = lowerCase(literal(line, at));
        ++literals;
        for (const std::string_view word : kBlame)
          CHECK_MESSAGE(findWord(text, word) == std::string::npos, file.path << ": " << line);
        if (at >= line.size()) break;
      }
    }
  }
  CHECK(literals > 500);
}
