#include "backends/fusion/TargetProgram.h"

#include "stdlib/MacroSet.h"
#include "support/messages/Fusion.h"
#include "support/messages/Verify.h"
#include "targets/ReadBack.h"
#include "targets/Target.h"
#include "verify/Variables.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>

namespace dotek::targets {

namespace target {
extern const Target fanuc; // writes the program
}

namespace {

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

} // namespace

std::optional<CalledCycle> calledProgram(const std::string& path, const stdlib::Control& control,
                                         ConversionContext& context) {
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
  }
  if (!returns) return refuse("it has no M99");

  ir::Cycle& cycle = out.lowered.cycle;
  cycle.name = std::filesystem::path(path).stem().generic_string();
  cycle.title = title;
  // What it may read before it gives it a value itself is the caller's.
  SourceMap sources;
  Diagnostics found;
  const auto file =
      readBack(path, programs.result.files.front().text, control, session.limits(), sources, found);
  if (!file) {
    session.diagnostics().report<diag::TranslationNotRead>({}, path, firstError(found));
    return std::nullopt;
  }
  for (const verify::ProgramVariable& one : verify::variablesOf(*file, control, {})) {
    const char letter = one.local ? stdlib::letterOfLocal(one.number) : '\0';
    if (letter == 0) continue;
    ir::Variable variable;
    variable.name = std::string(1, letter);
    variable.role = ir::Role::Parameter;
    variable.optional = true;
    variable.meaning = "Argument " + variable.name + ", #" + std::to_string(one.number);
    const ir::VariableId id = cycle.add(std::move(variable));
    out.call.arguments.push_back({id, letter});
    out.arguments.push_back({std::string(1, letter), letter});
  }
  std::sort(out.call.arguments.begin(), out.call.arguments.end(),
            [](const auto& a, const auto& b) { return a.letter < b.letter; });
  return out;
}

} // namespace dotek::targets
