#include "targets/Translation.h"

#include "sim/geometry/PartFile.h"
#include "support/Files.h"
#include "support/LineMatch.h"
#include "support/messages/Commands.h"
#include "support/messages/Fanuc.h"
#include "support/messages/Verify.h"
#include "targets/Conversion.h"
#include "targets/Target.h"

#include <algorithm>

namespace dotek::targets {
namespace {

Translation translationOf(const OutputFile& file, const MappedResult& map,
                          const std::vector<OutputArgument>& arguments,
                          const std::set<std::uint32_t>& handedBack, const SourceMap& sources) {
  Translation out;
  out.name = file.name;
  out.text = file.text;
  out.arguments = arguments;
  out.handedBack = handedBack;
  for (const MappedLine& line : map.lines) {
    auto& places = out.sources.emplace_back().emplace();
    for (const SourceRange& range : line.ranges)
      if (range.hasPlace()) places.emplace(sources.file(range.file).name(), sources.line(range));
  }
  return out;
}

} // namespace

ConvertOptions convertOptionsOf(const VerifyOptions& options) {
  ConvertOptions out;
  static_cast<TranslationOptions&>(out) = options;
  out.programNumber = options.programNumber;
  out.defaults = options.defaults;
  out.letters = options.letters;
  out.useDefaults = options.useDefaults;
  out.switchProbe = options.switchProbe;
  return out;
}

std::optional<Translated> translated(const VerifyOptions& options, Compilation& compilation,
                                     LoweringInputs* inputs) {
  if (const ConvertedInput* given = options.converted.get()) {
    Translated out{
        translationOf(given->file, given->map, given->arguments, given->handedBack, given->sources),
        given->macros,
        {}};
    addFindings(given->said, given->sources, out.said);
    return out;
  }
  Session& session = compilation.session();
  if (options.probeMacros && session.macroSet(*options.probeMacros) == nullptr) {
    reportUnknownMacroSet(*options.probeMacros, session);
    return std::nullopt;
  }
  const ConvertOptions convert = convertOptionsOf(options);
  ConversionContext context{convert, compilation, session, compilation.folders(), compilation.usedSets(),
                            inputs};
  readLetters(context);
  const std::unique_ptr<Conversion> conversion = findTarget(options.to)->convert(context);
  if (inputs != nullptr ? !conversion->beginCycles() : !conversion->beginPrograms()) return std::nullopt;
  if (inputs != nullptr)
    conversion->cycle(compilation.folders().front(), 0);
  else
    conversion->program(options.inputs.front());
  conversion->finish();
  for (const auto& [name, letter] : context.letters)
    if (!context.usedLetters.contains(name))
      session.diagnostics().report<diag::ArgumentUnknown>({}, name, "");
  const ConversionResult& result = context.result;
  const bool several = findTarget(options.to)->writesFolder;
  if (session.diagnostics().hasErrors() || result.files.empty() || (result.files.size() != 1 && !several))
    return std::nullopt;
  Translated out{
      translationOf(result.files.back(), result.maps.back(),
                    result.arguments.empty() ? std::vector<OutputArgument>() : result.arguments.front(),
                    result.handedBack.empty() ? std::set<std::uint32_t>() : result.handedBack.front(),
                    session.sources()),
      result.macros,
      {}};
  addFindings(session.diagnostics(), session.sources(), out.said);
  return out;
}

bool takeEdited(const std::string& path, Translation& translation, Session& session) {
  const auto bytes = readBytes(path, session.limits(), session.diagnostics());
  if (!bytes) return false;
  const SourceFile before("", translation.text, Encoding::Utf8), now("", *bytes, Encoding::Utf8);
  std::vector<std::optional<std::set<std::pair<std::string, std::uint32_t>>>> sources(now.lineCount());
  const auto same = matchLines(before.lineCount(), now.lineCount(), [&](std::uint32_t r, std::uint32_t c) {
    return before.line(r + 1) == now.line(c + 1);
  });
  if (same)
    for (const auto& [r, c] : *same)
      if (r < translation.sources.size()) sources[c] = translation.sources[r];
  translation.converted = std::move(translation.text);
  translation.name = path;
  translation.text = *bytes;
  translation.sources = std::move(sources);
  return true;
}

bool loadWorld(const VerifyOptions& options, VerifyPlan& plan, Session& session) {
  if (options.machine) {
    plan.machine =
        sim::loadMachine(*options.machine, session.limits(), session.sources(), session.diagnostics());
    if (!plan.machine) return false;
  }
  if (!options.part) return true;
  if (plan.machine && !plan.machine->hasProbe) {
    session.diagnostics().report<diag::SetupFlag>(
        {}, "--machine", "it has no [probe], and a probe is what touches a part; docs/part.md has the table");
    return false;
  }
  const auto part =
      sim::loadPart(*options.part, session.limits(), session.bounds(sim::folderOf(*options.part)),
                    session.sources(), session.diagnostics());
  if (!part) return false;
  plan.part = part->part;
  return true;
}

} // namespace dotek::targets
