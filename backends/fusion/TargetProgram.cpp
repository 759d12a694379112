#include "backends/fusion/TargetProgram.h"

#include "support/messages/Fusion.h"
#include "targets/Target.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <set>

namespace dotek::targets {

namespace target {
extern const Target fanuc; // writes the program
}

namespace {

constexpr std::uint32_t kLastArgument = 26;
// By the number of the local variable, as G65 fills it; a blank: no letter does.
constexpr std::string_view kLetters = " ABCIJKDEF H M   QRSTUVWXYZ";

std::string withoutComments(std::string_view text) {
  std::string out;
  int open = 0;
  for (const char c : text) {
    open += c == '(' ? 1 : 0;
    if (open == 0 && c != ' ') out += c;
    open -= c == ')' && open > 0 ? 1 : 0;
  }
  return out;
}

std::uint32_t digitsAt(std::string_view text, std::size_t at) {
  std::uint32_t out = 0;
  std::from_chars(text.data() + at, text.data() + text.size(), out);
  return out;
}

bool hasCode(std::string_view text, std::string_view code) {
  for (std::size_t at = 0; (at = text.find(code, at)) != std::string_view::npos; ++at)
    if (at + code.size() == text.size() ||
        std::isdigit(static_cast<unsigned char>(text[at + code.size()])) == 0)
      return true;
  return false;
}

// Where a jump may arrive: labels that a GOTO names, all of them where it computes one, and ends of loops.
class Arrivals {
public:
  explicit Arrivals(const std::vector<std::string>& lines) {
    for (const std::string& line : lines)
      for (std::size_t at = 0; (at = line.find("GOTO", at)) != std::string::npos; at += 4) {
        const std::uint32_t label = digitsAt(line, at + 4);
        computed_ = computed_ || label == 0;
        labels_.insert(label);
      }
  }
  bool at(const std::string& line) const {
    if (line.find("END") != std::string::npos) return true;
    return line.starts_with('N') && (computed_ || labels_.contains(digitsAt(line, 1)));
  }

private:
  std::set<std::uint32_t> labels_;
  bool computed_ = false;
};

// Local variables that hold what the caller gives: those that are read where the program may not have given
// them a value itself.
std::set<std::uint32_t> argumentsOf(const std::vector<std::string>& lines) {
  const Arrivals arrivals(lines);
  std::set<std::uint32_t> out, given; // given: since the last arrival
  for (const std::string& line : lines) {
    if (arrivals.at(line)) given.clear();
    const std::size_t from = line.starts_with('N') ? line.find_first_not_of("0123456789", 1) : 0;
    const std::string_view rest =
        from == std::string::npos ? std::string_view() : std::string_view(line).substr(from);
    const std::size_t equals = rest.find('=');
    const bool gives = rest.starts_with('#') && equals != std::string_view::npos && rest.find('[') > equals;
    const std::string_view read = gives ? rest.substr(equals) : rest;
    for (std::size_t at = 0; (at = read.find('#', at)) != std::string_view::npos; ++at)
      if (const std::uint32_t number = digitsAt(read, at + 1);
          number > 0 && number <= kLastArgument && !given.contains(number))
        out.insert(number);
    if (gives) given.insert(digitsAt(rest, 1));
  }
  return out;
}

} // namespace

std::optional<CalledCycle> calledProgram(const std::string& path, ConversionContext& context) {
  Session& session = context.session;
  ConversionContext programs{context.options, context.compilation, session,
                             context.folders, context.usedSets,    context.inputs};
  const std::unique_ptr<Conversion> conversion = target::fanuc.convert(programs);
  if (!conversion->beginPrograms()) return std::nullopt;
  conversion->program(path);
  if (session.diagnostics().hasErrors() || programs.result.files.empty()) return std::nullopt;

  CalledCycle out{{}, {}, {}, {}, {}, {}};
  out.call.lines = linesOf(programs.result.files.front(), programs.result.maps.front());
  const auto refuse = [&](const char* why) {
    session.diagnostics().report<diag::FusionProgram>({}, path, why);
    return std::nullopt;
  };
  std::vector<std::string> lines;
  std::string title;
  bool returns = false, first = true;
  for (const backends::EmittedLine& line : out.call.lines) {
    const std::string text = withoutComments(line.text);
    if (out.call.number == 0) {
      out.call.number = text.starts_with('O') ? digitsAt(text, 1) : 0;
      if (out.call.number == 0) return refuse("it has no number");
      if (const std::size_t open = line.text.find('('); open != std::string::npos)
        title = line.text.substr(open + 1, line.text.rfind(')') - open - 1);
      continue;
    }
    first = first && !text.starts_with('O');
    if (hasCode(text, "M98")) return refuse("it calls another one by M98, which has its variables");
    if (!first) continue;
    if (hasCode(text, "M30") || hasCode(text, "M2") || hasCode(text, "M02"))
      return refuse("it ends the whole run");
    returns = returns || hasCode(text, "M99");
    lines.push_back(text);
  }
  if (!returns) return refuse("it has no M99");

  ir::Cycle& cycle = out.lowered.cycle;
  cycle.name = std::filesystem::path(path).stem().generic_string();
  cycle.title = title;
  for (const std::uint32_t number : argumentsOf(lines)) {
    const char letter = kLetters[number];
    if (letter == ' ') continue;
    ir::Variable variable;
    variable.name = std::string(1, letter);
    variable.role = ir::Role::Parameter;
    variable.optional = true;
    variable.meaning = "Argument " + variable.name + ", #" + std::to_string(number);
    const ir::VariableId id = cycle.add(std::move(variable));
    out.call.arguments.push_back({id, letter});
    out.arguments.push_back({std::string(1, letter), letter});
  }
  std::sort(out.call.arguments.begin(), out.call.arguments.end(),
            [](const auto& a, const auto& b) { return a.letter < b.letter; });
  return out;
}

} // namespace dotek::targets
