// `dotek check`, `dotek fmt`, `dotek doc` and `dotek new cycle`.
#include "driver/Command.h"
#include "frontend/cycle/Parse.h"
#include "frontend/cycle/Words.h"
#include "frontend/macrob/Format.h"
#include "frontend/macrob/Parse.h"
#include "frontend/mikroprog/Format.h"
#include "frontend/mikroprog/Parse.h"
#include "lint/Suppressions.h"
#include "project/CycleCatalogue.h"
#include "project/CycleFiles.h"
#include "project/CycleLowering.h"
#include "project/Inputs.h"
#include "project/Programs.h"
#include "support/Files.h"
#include "support/messages/Common.h"
#include "support/messages/Output.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <system_error>

namespace dotek::driver {

namespace cycle = frontend::cycle;
namespace macrob = frontend::macrob;
namespace mikroprog = frontend::mikroprog;

namespace {

constexpr std::string_view kExpected = "a cycle";

bool hasInputs(const CycleOptions& options, const char* command, Session& session) {
  if (!options.inputs.empty()) return true;
  session.diagnostics().report<diag::MissingOption>({}, command, "FILE.cycle", kExpected);
  return false;
}

// Files as named, and the cycles of each folder by name.
std::vector<std::string> cyclePaths(const std::vector<std::string>& inputs, Session& session) {
  std::vector<std::string> out;
  for (const std::string& input : inputs) {
    std::error_code error;
    if (!std::filesystem::is_directory(input, error)) {
      out.push_back(input);
      continue;
    }
    const std::size_t first = out.size();
    std::filesystem::directory_iterator entries(input, error);
    for (; !error && entries != std::filesystem::directory_iterator(); entries.increment(error)) {
      const std::string path = entries->path().generic_string();
      if (entries->path().extension() != ".cycle") continue;
      if (isStream(path)) // nobody named it, and it may never end
        session.diagnostics().report<diag::FileNotReadable>({}, path, "it is no regular file");
      else
        out.push_back(path);
    }
    if (error) session.diagnostics().report<diag::FileNotReadable>({}, input, error.message());
    if (!error && out.size() == first)
      session.diagnostics().report<diag::FileNotReadable>({}, input, "it holds no cycle");
    std::sort(out.begin() + static_cast<std::ptrdiff_t>(first), out.end());
  }
  return out;
}

// `bore-3` is the file of `bore_3`.
std::string cycleName(std::string stem) {
  std::replace(stem.begin(), stem.end(), '-', '_');
  return stem;
}

// The layout with the line ends that the file has in its first line, and its byte order mark.
std::string endedAs(const std::string& path, const SourceFile& before, const std::string& laidOut,
                    const Limits& limits) {
  std::string out;
  Diagnostics unheard;
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error))
    if (const auto bytes = readBytes(path, limits, unheard); bytes && bytes->starts_with(kByteOrderMark))
      out = kByteOrderMark;
  const std::size_t end = before.bytes().find('\n');
  if (end == std::string::npos || end == 0 || before.bytes()[end - 1] != '\r') return out + laidOut;
  for (const char c : laidOut)
    out += c == '\n' ? "\r\n" : std::string(1, c);
  return out;
}

bool differs(const std::string& text, const SourceFile& before) {
  std::string_view written = text;
  if (written.starts_with(kByteOrderMark)) written.remove_prefix(kByteOrderMark.size());
  return written != before.bytes();
}

struct Layout {
  std::string text;
  bool changes = false;
};

Layout layoutOf(const std::string& path, const SourceFile& before, const std::string& laidOut,
                const Limits& limits) {
  std::string text = endedAs(path, before, laidOut, limits);
  const bool changes = differs(text, before);
  return {std::move(text), changes};
}

std::nullopt_t wouldDiffer(const std::string& path, FileId file, Session& session) {
  session.diagnostics().report<diag::NotLaidOut>({file, 0, 0}, path, "would read otherwise afterwards",
                                                 "this is a defect of Dotek; leave the file as it is");
  return std::nullopt;
}

// A program of Mikroprog (docs/mikroprog.md). nullopt: reported.
std::optional<Layout> sufLayout(const std::string& path, Session& session) {
  const auto id = session.read(path, Encoding::Cp852);
  if (!id) return std::nullopt;
  SourceMap& sources = session.sources();
  const mikroprog::Program program = mikroprog::parse(*id, sources, session.diagnostics(), session.limits());
  const std::optional<std::string> text = mikroprog::format(program, sources);
  if (!text) return std::nullopt; // the reader has said why
  const SourceFile& before = sources.file(*id);
  const FileId again = sources.add(SourceFile(before.name(), *text, before.encoding()));
  Diagnostics unheard;
  if (!mikroprog::sameProgram(program, mikroprog::parse(again, sources, unheard)))
    return wouldDiffer(path, *id, session);
  return layoutOf(path, sources.file(*id), *text, session.limits());
}

// A file of macro programs in the one style (docs/macrob.md). nullopt: reported.
std::optional<Layout> programLayout(const std::string& path, Session& session) {
  const auto id = session.read(path, Encoding::Cp1250);
  if (!id) return std::nullopt;
  SourceMap& sources = session.sources();
  std::optional<std::string> text;
  std::string meaning;
  { // one tree at a time: they are many times as large as their text
    const macrob::File file =
        macrob::parse(*id, sources, session.limits(), session.diagnostics(), textOf(*id, session),
                      macrob::Reader::Fast, formsOf(*id, session));
    if (file.hasErrors) return std::nullopt; // the reader has said why
    text = macrob::format(file, sources);
    if (text) meaning = macrob::dumpAst(file, sources, false);
  }
  if (!text) {
    session.diagnostics().report<diag::NotLaidOut>({*id, 0, 0}, path, "holds text that is no block",
                                                   "take it out, or put it into comments");
    return std::nullopt;
  }
  // What is written has to read as what was read.
  const SourceFile& before = sources.file(*id);
  const FileId again = sources.add(SourceFile(before.name(), *text, before.encoding()));
  Diagnostics unheard;
  const macrob::File after = macrob::parse(again, sources, session.limits(), unheard, macrob::Text::Program,
                                           macrob::Reader::Fast, formsOf(*id, session));
  if (meaning != macrob::dumpAst(after, sources, false)) return wouldDiffer(path, *id, session);
  return layoutOf(path, before, *text, session.limits());
}

} // namespace

Outcome check(const CycleOptions& options) {
  return guarded(options.common, [&](Session& session) {
    checkSettings(options.inputs, session); // a finding beside the others
    CycleFiles cycles(session);
    std::vector<FileId> checked;
    if (hasInputs(options, "check", session))
      for (const std::string& path : options.inputs)
        if (kindAmong(path, {InputKind::Cycle}, kExpected, session))
          if (const auto file = checkCycleFile(path, cycles, session)) checked.push_back(*file);
    // What meets nothing is a finding of lint, which knows all rules.
    std::vector<lint::Suppression> suppressions =
        lint::suppressionsOf(checked, session.sources(), session.diagnostics());
    lint::applySuppressions(suppressions, session.sources(), session.diagnostics(),
                            [](std::string_view, FileId) { return false; });
    return outcomeOf(session, "", true);
  });
}

Outcome layOut(const CycleOptions& options) {
  return guarded(options.common, options.inputs, [&](Session& session) {
    CycleFiles cycles(session);
    std::vector<OutputFile> files;
    std::vector<std::string> inputs;
    if (hasInputs(options, "fmt", session))
      for (const std::string& path : options.inputs) {
        const auto kind = kindAmong(path, {InputKind::Cycle, InputKind::Nc, InputKind::Suf},
                                    "a cycle or an NC program", session);
        if (!kind) continue;
        std::optional<Layout> laid;
        if (kind == InputKind::Suf)
          laid = sufLayout(path, session);
        else if (kind == InputKind::Nc)
          laid = programLayout(path, session);
        else if (const cycle::File* file = cycles.load(path); file != nullptr && !file->hasErrorNodes)
          laid = layoutOf(path, session.sources().file(file->file), cycle::layOut(*file), session.limits());
        if (!laid) continue;
        if (laid->changes) inputs.push_back(path);
        files.push_back({path, std::move(laid->text)});
      }
    Outcome outcome = outcomeOf(session, "", true);
    outcome.files = std::move(files);
    outcome.inputs = std::move(inputs);
    return outcome;
  });
}

Outcome catalogue(const CycleOptions& options) {
  return guarded(options.common, options.inputs, [&](Session& session) {
    CycleFiles cycles(session);
    std::vector<CyclePage> pages;
    const auto add = [&](const cycle::File* file) {
      if (file != nullptr && !file->hasErrorNodes && file->header() != nullptr)
        pages.push_back(cyclePage(*file));
    };
    if (options.inputs.empty())
      for (const stdlib::DataFile* data : session.data().list("cycles"))
        if (data->name.find('/') == std::string::npos) add(cycles.library(cycleName(data->name)));
    for (const std::string& path : cyclePaths(options.inputs, session))
      if (kindAmong(path, {InputKind::Cycle}, kExpected, session)) add(cycles.check(path));
    std::set<std::string> linked;
    for (const CyclePage& page : pages)
      linked.insert(page.name);
    for (CyclePage& page : pages)
      for (const std::string& name : page.calls)
        if (!linked.contains(name)) page.elsewhere.push_back(name);
    std::string all;
    std::vector<OutputFile> files;
    for (const CyclePage& page : pages) {
      files.push_back({fileStem(page.name) + ".md", markdown(page)});
      files.push_back({fileStem(page.name) + ".html", html(page)});
      all += (all.empty() ? "" : "\n") + files[files.size() - 2].text;
    }
    files.push_back({"index.md", markdownIndex(pages)});
    files.push_back({"index.html", htmlIndex(pages)});
    Outcome outcome = outcomeOf(session, std::move(all));
    if (outcome.status == 0) outcome.files = std::move(files);
    return outcome;
  });
}

Outcome newCycle(const std::string& name, const CommonOptions& common) {
  return guarded(common, [&](Session& session) {
    if (cycle::isName(name) && !cycle::isReserved(name)) return outcomeOf(session, cycleDraft(name));
    session.diagnostics().report<diag::CycleName>({}, name, cycle::proposeName(name));
    return outcomeOf(session, "");
  });
}

} // namespace dotek::driver
