#include "driver/ProgramTools.h"

#include "driver/Command.h"
#include "frontend/macrob/Outline.h"
#include "frontend/macrob/Parse.h"
#include "frontend/macrob/Renumber.h"
#include "frontend/mikroprog/Parse.h"
#include "frontend/mikroprog/Renumber.h"
#include "project/Inputs.h"
#include "project/Lowering.h"
#include "project/Programs.h"
#include "project/Settings.h"
#include "stdlib/MovedSet.h"
#include "support/Printable.h"
#include "support/messages/Commands.h"
#include "support/messages/Output.h"
#include "support/messages/Sim.h"

#include <algorithm>
#include <deque>
#include <fmt/format.h>

namespace dotek::driver {

namespace macrob = frontend::macrob;

namespace {

constexpr std::string_view kExpected = "an NC program";

// nullopt: it is no program, or cannot be read; reported.
std::optional<macrob::File> parsed(const std::string& path, Session& session) {
  if (!kindAmong(path, {InputKind::Nc}, kExpected, session)) return std::nullopt;
  const std::optional<FileId> id = session.read(path, Encoding::Cp1250);
  if (!id) return std::nullopt;
  return macrob::parse(*id, session.sources(), session.limits(), session.diagnostics(), textOf(*id, session),
                       macrob::Reader::Fast, formsOf(*id, session));
}

bool hasInputs(const std::vector<std::string>& inputs, const char* command, Session& session) {
  if (!inputs.empty()) return true;
  session.diagnostics().report<diag::MissingOption>({}, command, "FILE", kExpected);
  return false;
}

class OutlineText {
public:
  explicit OutlineText(const SourceMap& sources) : sources_(sources) {}

  std::string text(const std::vector<macrob::OutlineProgram>& programs) const {
    std::string out;
    for (const macrob::OutlineProgram& one : programs) {
      if (!out.empty()) out += "\n";
      out += fmt::format("{}{}  {}\n", one.name.empty() ? "(no header)" : printable(one.name),
                         one.title.empty() ? "" : " (" + printable(one.title) + ")", place(one.range));
      if (!one.numbers.empty()) out += "  numbers    " + named(one.numbers, "N") + "\n";
      for (const macrob::OutlineCall& call : one.calls)
        out += fmt::format("  call       {} {}{}{} line {}\n", call.code,
                           call.program.starts_with('N') ? "" : "P", printable(call.program),
                           call.computed ? " (computed)" : "", line(call.range));
      for (const auto& [to, range] : one.jumps)
        out += fmt::format("  jump       to {} line {}\n", printable(to), line(range));
      for (const auto& [number, use] : one.variables)
        out += fmt::format("  variable   #{}{}{}\n", number, uses("written", use.written),
                           uses("read", use.read));
      for (const auto& [name, range] : one.computedVariables)
        out += fmt::format("  variable   {} (computed) line {}\n", printable(name), line(range));
    }
    return out;
  }

  std::string json(const std::vector<macrob::OutlineProgram>& programs) const {
    std::string out;
    for (const macrob::OutlineProgram& one : programs) {
      out += fmt::format("{}      {{\n        \"name\": {}, \"title\": {}, \"line\": {},\n",
                         out.empty() ? "" : ",\n", jsonString(one.name), jsonString(one.title),
                         std::max(line(one.range), 1U));
      out += "        \"numbers\": " + list(one.numbers, "number") + ",\n";
      std::string calls;
      for (const macrob::OutlineCall& call : one.calls)
        calls += fmt::format("{}{{\"code\": {}, \"program\": {}, \"computed\": {}, \"line\": {}}}",
                             calls.empty() ? "" : ", ", jsonString(call.code), jsonString(call.program),
                             call.computed, line(call.range));
      out += "        \"calls\": [" + calls + "],\n";
      out += "        \"jumps\": " + list(one.jumps, "to") + ",\n";
      std::string variables;
      for (const auto& [number, use] : one.variables)
        variables += fmt::format("{}{{\"number\": {}, \"written\": [{}], \"read\": [{}]}}",
                                 variables.empty() ? "" : ", ", number, lines(use.written), lines(use.read));
      out += "        \"variables\": [" + variables + "],\n";
      out += "        \"computedVariables\": " + list(one.computedVariables, "name") + "\n      }";
    }
    return out;
  }

private:
  using Places = std::vector<std::pair<std::string, SourceRange>>;

  std::uint32_t line(SourceRange range) const { return sources_.line(range); }
  std::string place(SourceRange range) const {
    return range.hasPlace() ? fmt::format("{}:{}", printable(sources_.file(range.file).name()), line(range))
                            : "";
  }
  std::string lines(const std::vector<SourceRange>& ranges) const {
    std::string out;
    std::uint32_t last = 0;
    for (const SourceRange& range : ranges) {
      if (line(range) == last) continue;
      last = line(range);
      out += fmt::format("{}{}", out.empty() ? "" : ", ", last);
    }
    return out;
  }
  std::string uses(const char* what, const std::vector<SourceRange>& ranges) const {
    return ranges.empty() ? "" : fmt::format("  {} {}", what, lines(ranges));
  }
  std::string named(const Places& places, const char* letter) const {
    std::string out;
    for (const auto& [name, range] : places)
      out += fmt::format("{}{}{}:{}", out.empty() ? "" : " ", letter, name, line(range));
    return out;
  }
  std::string list(const Places& places, const char* key) const {
    std::string out;
    for (const auto& [name, range] : places)
      out += fmt::format("{}{{\"{}\": {}, \"line\": {}}}", out.empty() ? "" : ", ", key, jsonString(name),
                         line(range));
    return "[" + out + "]";
  }

  const SourceMap& sources_;
};

} // namespace

Outcome outline(const OutlineOptions& options) {
  Outcome outcome = guarded(options.common, [&](Session& session) {
    std::string out;
    if (hasInputs(options.inputs, "outline", session))
      for (const std::string& path : options.inputs) {
        const std::optional<macrob::File> file = parsed(path, session);
        if (!file) continue;
        const OutlineText text(session.sources());
        const auto programs = macrob::outline(*file, session.sources());
        if (options.json)
          out += fmt::format("{}  {{\n    \"file\": {},\n    \"programs\": [\n{}\n    ]\n  }}",
                             out.empty() ? "" : ",\n", jsonString(path), text.json(programs));
        else
          out += (out.empty() ? "" : "\n") + text.text(programs);
      }
    if (options.json) out = "[\n" + out + (out.empty() ? "]\n" : "\n]\n");
    return outcomeOf(session, std::move(out), true);
  });
  if (options.json && outcome.output.empty()) outcome.output = kEmptyOutline;
  return outcome;
}

namespace {

bool isSuf(const std::string& path, Session& session) {
  const Recognition* const found = session.kindOf(path, session.diagnostics(), std::nullopt);
  return found != nullptr && found->kind == InputKind::Suf;
}

// A program of Mikroprog. nullopt: reported.
std::optional<std::string> renumberedSuf(const std::string& path, const RenumberCommandOptions& options,
                                         Session& session) {
  namespace mikroprog = frontend::mikroprog;
  if (options.range) {
    session.diagnostics().report<diag::OptionOfMacroB>({}, "--range");
    return std::nullopt;
  }
  const std::optional<FileId> id = session.read(path, Encoding::Cp852);
  if (!id) return std::nullopt;
  const mikroprog::Program program =
      mikroprog::parse(*id, session.sources(), session.diagnostics(), session.limits());
  return mikroprog::renumber(program, {options.start, options.step, options.all}, session.sources(),
                             session.diagnostics());
}

} // namespace

Outcome renumber(const RenumberCommandOptions& options) {
  return guarded(options.common, [&](Session& session) {
    std::vector<OutputFile> files;
    std::vector<std::string> names, changed;
    std::deque<macrob::File> parsedFiles;
    std::vector<macrob::RenumberInput> inputs;
    if (hasInputs(options.inputs, "renumber", session))
      for (const std::string& path : options.inputs) {
        if (std::find(names.begin(), names.end(), path) != names.end()) continue;
        if (isSuf(path, session)) {
          auto text = renumberedSuf(path, options, session);
          if (!text) continue;
          if (*text != session.sources().file(*session.read(path, Encoding::Cp852)).bytes())
            changed.push_back(path);
          files.push_back({path, std::move(*text)});
          continue;
        }
        std::optional<macrob::File> file = parsed(path, session);
        if (!file) continue;
        macrob::RenumberOptions how{options.start, options.step, options.all, options.range};
        const std::string control =
            options.control.empty() ? settingsOf(path, session).control : options.control;
        if (!control.empty()) {
          const auto profile = loadControl(control, session);
          if (!profile) break;
          how.last = profile->sequenceLast;
        }
        inputs.push_back({&parsedFiles.emplace_back(std::move(*file)), how});
        names.push_back(path);
      }
    auto texts = macrob::renumber(inputs, session.sources(), session.diagnostics());
    for (std::size_t i = 0; i < texts.size(); ++i) {
      if (!texts[i]) continue;
      if (*texts[i] != session.sources().file(inputs[i].file->file).bytes()) changed.push_back(names[i]);
      files.push_back({names[i], std::move(*texts[i])});
    }
    Outcome outcome = outcomeOf(session, "", true);
    if (outcome.status == 0) {
      outcome.files = std::move(files);
      outcome.inputs = std::move(changed);
    }
    return outcome;
  });
}

Outcome newMacros(const std::string& name, const CommonOptions& common) {
  return guarded(common, {}, [&](Session& session) {
    if (auto text = stdlib::macroText(session.data(), name)) return outcomeOf(session, std::move(*text));
    std::string there;
    for (const stdlib::DataFile* file : session.data().list("macrob"))
      there += (there.empty() ? "`" : ", `") + file->name + "`";
    session.diagnostics().report<diag::NoMacroText>({}, printable(name), there);
    return outcomeOf(session, "");
  });
}

} // namespace dotek::driver
