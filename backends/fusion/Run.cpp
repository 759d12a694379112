#include "backends/fusion/Run.h"

#include "backends/fusion/KernelText.h"
#include "backends/fusion/Script.h"

#include <algorithm>
#include <fmt/format.h>
#include <variant>

namespace dotek::backends::fusion {

namespace {

// What RunInput::noNumber arrives as.
constexpr std::string_view kNoNumber = "\"no number\"";

std::string object(const std::map<std::string, double>& members, const RunInput& input,
                   const std::string& more = "") {
  std::string out = "{";
  for (const auto& [name, value] : members)
    out += (out.size() > 1 ? ", " : "") + quoted(name) + ": " +
           (name == input.noNumber ? std::string(kNoNumber) : numberLiteral(value));
  if (!more.empty()) out += (out.size() > 1 ? ", " : "") + more;
  return out + "}";
}

// The kernel's input: JSON, and a literal of JavaScript as well.
std::string inputText(std::string_view prefix, bool whole, const RunInput& input, std::uint32_t most) {
  constexpr int kMillimetre = 1, kInch = 0;
  std::string points;
  const auto along = [&](const char* axis, double value) {
    return input.noNumber == axis ? std::string(kNoNumber) : numberLiteral(value);
  };
  for (const auto& [x, y, z] : input.points)
    points += fmt::format("{}[{}, {}, {}]", points.empty() ? "" : ", ", along("x", x), along("y", y),
                          along("z", z));
  return fmt::format(
      R"({{"unit": {}, "properties": {}, "points": [{}], "tool": {}, "cycle": {}, {}{}"most": {}}})",
      input.inch ? kInch : kMillimetre,
      object(input.properties, input, "\"dotekCycle\": " + quoted(input.chosen ? prefix : "none")), points,
      object({{"diameter", input.toolDiameter},
              {"number", input.toolNumber},
              {"lengthOffset", input.toolLengthOffset}},
             input),
      object(input.cycle, input), input.probing ? "\"strategy\": \"probe\", " : "",
      whole ? "" : "\"entry\": " + quoted(std::string(prefix) + "_" + input.entry) + ", ", most);
}

std::string textOf(const std::vector<EmittedLine>& lines) {
  std::string out;
  for (const EmittedLine& line : lines)
    out += line.text + "\n";
  return out;
}

} // namespace

std::optional<script::Fault> Fragment::load(std::string_view fragment, std::string_view prefix, bool numbered,
                                            std::string_view helpers) {
  prefix_ = prefix;
  whole_ = false;
  // Read by itself, so that a brace too many is found here and lines are the fragment's own. It is no
  // beginning of a script: a "use strict" in it says nothing.
  const std::string own = "0;" + std::string(fragment);
  std::string head = textOf(postHead());
  if (numbered)
    head += "function writeBlock() {\n  var text = formatWords(arguments);\n"
            "  if (text !== \"\") { writeln(\"N1 \" + text); }\n}\n";
  head += helpers;
  return runner_.load({{"kernel", kernelText()}, {"post", head}, {kFragment, own}});
}

std::optional<script::Fault> Fragment::loadPost(std::string_view post, std::string_view prefix) {
  prefix_ = prefix;
  whole_ = true;
  return runner_.load({{"kernel", kernelText()}, {"post", post}});
}

RunResult Fragment::run(const RunInput& input) const {
  RunResult out;
  const script::Options& options = runner_.options();
  auto answer = runner_.run(inputText(prefix_, whole_, input, options.output));
  if (script::Fault* fault = std::get_if<script::Fault>(&answer)) {
    out.fault = std::move(*fault);
    return out;
  }
  const auto& texts = std::get<script::Texts>(answer);
  if (texts.size() < 2) {
    out.fault = script::tooMuchOutput(options);
    return out;
  }
  out.text = texts[0];
  out.wroteAfterError = !texts[1].empty();
  for (std::size_t i = 2; i < texts.size(); ++i) {
    const char kind = texts[i].front();
    const std::size_t equals = texts[i].find('=');
    if (kind == 't')
      out.taken = true;
    else if (kind == 'd' && equals != std::string::npos)
      out.defined[texts[i].substr(1, equals - 1)] = texts[i].substr(equals + 1);
    else if (kind == 's' && equals != std::string::npos)
      out.scopes[texts[i].substr(1, equals - 1)] = texts[i].substr(equals + 1);
    else if (kind == 'n' && equals != std::string::npos)
      out.titles[texts[i].substr(1, equals - 1)] = texts[i].substr(equals + 1);
    else if (kind == 'g' && equals != std::string::npos)
      out.lostGroups[texts[i].substr(1, equals - 1)] = texts[i].substr(equals + 1);
    else if (kind == 'o' && equals != std::string::npos) {
      const std::size_t second = std::min(texts[i].find('=', equals + 1), texts[i].size());
      out.offered[texts[i].substr(1, equals - 1)].emplace_back(
          texts[i].substr(equals + 1, second - equals - 1),
          texts[i].substr(std::min(second + 1, texts[i].size())));
    } else
      (kind == 'e' ? out.errors : kind == 'w' ? out.warnings : out.kept).push_back(texts[i].substr(1));
  }
  return out;
}

std::string scriptFor(std::string_view fragment, std::string_view prefix, const RunInput& input) {
  const script::Options options;
  return std::string(kernelText()) + textOf(postHead()) + std::string(fragment) +
         textOf(postTail({std::string(prefix)})) + "console.log(dotekRun(" +
         inputText(prefix, false, input, options.output) + ").text);\n";
}

std::string evaluate(script::Runner& runner, std::string_view code) {
  const std::string kernel =
      std::string(kernelText()) + "(function (code) { return [String((0, eval)(code))]; });\n";
  const auto text = [](const script::Fault& fault) { return "throws: " + fault.text; };
  if (const auto fault = runner.load({{"kernel", kernel}})) return text(*fault);
  const auto answer = runner.run(quoted(code));
  const script::Fault* fault = std::get_if<script::Fault>(&answer);
  return fault != nullptr ? text(*fault) : std::get<script::Texts>(answer).front();
}

} // namespace dotek::backends::fusion
