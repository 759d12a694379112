#include "WordCheck.h"

#include "project/CycleFolder.h"
#include "project/Lowering.h"
#include "support/Decimal.h"
#include "tests/policy/Tree.h"

#include <algorithm>
#include <cctype>
#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace dotek::tests {

namespace {

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(' ') - first + 1));
}

// After the value that begins at `at`: a number, a variable, brackets, what stands for a field.
std::size_t endOfValue(std::string_view text, std::size_t at) {
  if (at < text.size() && (text[at] == '-' || text[at] == '+')) ++at;
  if (at >= text.size()) return at;
  if (text[at] == '{') return std::min(text.find('}', at), text.size() - 1) + 1;
  if (text[at] == '[') {
    int depth = 0;
    for (; at < text.size(); ++at) {
      depth += text[at] == '[' ? 1 : text[at] == ']' ? -1 : 0;
      if (depth == 0) return at + 1;
    }
    return at;
  }
  if (text[at] == '#' || text[at] == 'P') ++at;
  if (at < text.size() && text[at] == '[') return endOfValue(text, at);
  while (at < text.size() && (std::isdigit(static_cast<unsigned char>(text[at])) != 0 || text[at] == '.'))
    ++at;
  return at;
}

std::string plainNumber(std::string_view text) {
  const auto number = parseNumber(text);
  return number ? numberText(*number) : std::string(text);
}

// "{ZText}" in a line of script becomes "{Z}", "{text}" what it was made of.
class ScriptTexts {
public:
  explicit ScriptTexts(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) {
      const std::string text = trimmed(line);
      if (!text.starts_with("var ")) continue;
      const std::size_t equals = text.find(" = "), open = text.find('('), close = text.rfind(')');
      if (equals == std::string::npos || open == std::string::npos || close == std::string::npos) continue;
      std::string inner = text.substr(open + 1, close - open - 1);
      if (!inner.empty() && inner[0] == '"') inner = inner.substr(inner.find("\", ") + 3);
      made_[text.substr(4, equals - 4)] = inner;
    }
  }

  // The text that a call of writeBlock or writeln prints.
  std::string printed(std::string_view expression) const {
    std::string out;
    for (std::size_t at = 0; at < expression.size();) {
      if (expression[at] == '"') {
        for (++at; at < expression.size() && expression[at] != '"'; ++at) {
          if (expression[at] == '\\') ++at;
          out += expression[at];
        }
        ++at;
      } else if (expression[at] == ' ' || expression[at] == '+') {
        ++at;
      } else {
        const std::size_t end = std::min(expression.find(' ', at), expression.size());
        const std::string name(expression.substr(at, end - at));
        const auto found = made_.find(name);
        out += "{" + (found == made_.end() ? name : found->second) + "}";
        at = end;
      }
    }
    return out;
  }

private:
  std::map<std::string, std::string> made_;
};

std::vector<std::string> linesOfResult(const std::string& text) {
  std::vector<std::string> out = linesOf(text);
  for (std::string& line : out)
    if (line.ends_with('\r')) line.pop_back();
  return out;
}

} // namespace

std::vector<NcWord> wordsOf(std::string_view block) {
  std::vector<NcWord> out;
  std::size_t at = 0;
  while (at < block.size()) {
    const char c = block[at];
    if (c == '(' || c == ';') {
      const std::size_t end = c == '(' ? std::min(block.find(')', at), block.size()) : block.size();
      out.push_back(
          {'(', trimmed(block.substr(at + 1, end - at - 1)), std::string(block.substr(at, end - at + 1))});
      at = end + 1;
    } else if (c == '#') {
      out.push_back({'#', std::string(block.substr(at)), std::string(block.substr(at))});
      return out;
    } else if (c == '@') {
      const std::size_t end = std::min(block.find(' ', at), block.size());
      out.push_back(
          {'@', std::string(block.substr(at + 1, end - at - 1)), std::string(block.substr(at, end - at))});
      at = end;
    } else if (std::isupper(static_cast<unsigned char>(c)) != 0) {
      const std::size_t end = endOfValue(block, at + 1);
      out.push_back(
          {c, plainNumber(block.substr(at + 1, end - at - 1)), std::string(block.substr(at, end - at))});
      at = std::max(end, at + 1);
    } else {
      ++at;
    }
  }
  return out;
}

ResultLine ResultLine::without(std::size_t word) const {
  ResultLine out = *this;
  const std::string& spelled = words[word].spelled;
  const std::size_t at = text.find(spelled);
  REQUIRE(at != std::string::npos);
  out.text.erase(at, spelled.size());
  out.words.erase(out.words.begin() + static_cast<std::ptrdiff_t>(word));
  return out;
}

std::vector<SourceBlock> sourceBlocks(const driver::ConvertOptions& options) {
  project::Session session(options.common);
  const auto inputs =
      project::loadLoweringInputs(options.source, std::string(project::kDefaultControl), session);
  REQUIRE(inputs);
  const project::CycleFolder folder = project::loadCycleFolder(options.inputs.front(), session);
  std::set<std::string> used;
  const auto lowered = project::lowerCycle(folder, *inputs, used, session);
  REQUIRE_MESSAGE(lowered, renderText(session.diagnostics(), session.sources(), 5));
  std::vector<SourceBlock> out;
  for (const ir::PrintedBlock& block : lowered->printed) {
    SourceBlock one;
    const SourceFile& file = session.sources().file(block.range.file);
    one.place = {file.name(), file.place(block.range.begin).line, file.place(block.range.end).line};
    for (const ir::PrintedPiece& piece : block.pieces) {
      const auto value = lowered->fixed.find(piece.variable);
      if (!piece.picture)
        one.text += piece.text;
      else if (value != lowered->fixed.end())
        one.text += piece.picture->print(value->second).text;
      else
        one.text += "{" + lowered->cycle.variable(piece.variable).name + "}";
    }
    one.text = trimmed(one.text);
    one.words = wordsOf(one.text);
    out.push_back(std::move(one));
  }
  return out;
}

std::vector<ResultLine> resultLines(const driver::Outcome& outcome, WordTarget target) {
  std::vector<ResultLine> out;
  REQUIRE(outcome.files.size() == 1);
  const std::vector<std::string> lines = linesOfResult(outcome.files.front().text);
  const ScriptTexts texts(target == WordTarget::Fusion ? lines : std::vector<std::string>());
  for (const std::string& line : lines) {
    ResultLine one;
    one.text = line;
    const std::string text = trimmed(line);
    if (target != WordTarget::Fusion) {
      one.words = wordsOf(line);
    } else if (text.starts_with("writeBlock(") || text.starts_with("writeln(")) {
      const std::size_t open = text.find('(');
      one.text = texts.printed(std::string_view(text).substr(open + 1, text.size() - open - 3));
      one.words = wordsOf(one.text);
    } else if (const std::size_t open = text.find("_comment(\""); open != std::string::npos) {
      // The post's own writeComment, or brackets around it.
      const std::size_t begin = text.find('"');
      one.text = "(" + texts.printed(std::string_view(text).substr(begin, text.size() - begin - 2)) + ")";
      one.words = wordsOf(one.text);
    }
    out.push_back(std::move(one));
  }
  const nlohmann::json map = nlohmann::json::parse(renderLineMap(outcome.maps, outcome.sources));
  for (const auto& line : map.at(0).at("lines")) {
    ResultLine& one = out.at(line.at("line").get<std::size_t>() - 1);
    one.reason = line.at("reason").get<std::string>();
    for (const auto& source : line.at("sources"))
      one.places.push_back({source.at("file").get<std::string>(), source.at("line").get<std::uint32_t>(),
                            source.at("endLine").get<std::uint32_t>()});
  }
  return out;
}

} // namespace dotek::tests
