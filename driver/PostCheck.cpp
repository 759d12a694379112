#include "driver/PostCheck.h"

#include "driver/Command.h"
#include "stdlib/MikroprogControl.h"
#include "support/WholeName.h"
#include "support/messages/Commands.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <memory>

namespace dotek::driver {

namespace {

namespace fs = std::filesystem;

// Of the lines that wrote a block, innermost first, the one that a person looks for: not the post's own
// writeBlock.
const posts::PostPlace* writerOf(const posts::PostStack& stack) {
  const posts::PostPlace* out = nullptr;
  for (const posts::PostPlace& place : stack) {
    if (place.line == 0) continue; // an entry whose own call is too far out
    out = &place;
    if (!place.function.starts_with("write")) break;
  }
  return out;
}

constexpr double kBareLength = 100; // mm

class PostCheck {
public:
  PostCheck(const RunPostOptions& options, const posts::PostResult& result, const posts::PostRunner& runner,
            Session& session)
      : options_(options), result_(result), runner_(runner), session_(session), common_(options.common) {}

  CheckedPost run() {
    const bool mikroprog =
        !options_.control.empty() && session_.data().find("mikroprog", options_.control) != nullptr;
    InputKind kind = mikroprog ? InputKind::Suf : InputKind::Nc;
    if (options_.control.empty() && recognise("", result_.nc).kind == InputKind::Suf) kind = InputKind::Suf;
    name_ = options_.name;
    if (name_.empty())
      name_ = fs::path(options_.post).replace_extension(kind == InputKind::Suf ? "suf" : "nc").string();
    common_.from = std::string(kindName(kind));
    auto buffers = std::make_shared<std::map<std::string, std::string>>();
    if (options_.common.buffers) *buffers = *options_.common.buffers;
    (*buffers)[wholeName(name_)] = result_.nc;
    common_.buffers = std::move(buffers);

    CheckedPost out;
    lint::LintOptions lintOptions;
    lintOptions.paths = {name_};
    lintOptions.common = common_;
    lintOptions.control = options_.control;
    Outcome linted = lint(lintOptions);
    out.fails = linted.status != 0;
    take(std::move(linted));
    if (!options_.part && !options_.machine) return out;
    if (!options_.machine && !result_.probe) {
      session_.diagnostics().report<diag::MissingOption>(
          {}, "run-post", "--machine MACHINE.toml",
          "the job has no probe that could touch the part of `--part`");
      out.fails = true;
      return out;
    }
    SimOptions simOptions;
    simOptions.program = name_;
    simOptions.common = common_;
    simOptions.control = options_.control;
    simOptions.part = options_.part;
    simOptions.machine = options_.machine;
    if (!options_.machine) useProbe(simOptions.setup);
    simOptions.trace = [](std::string_view) {}; // the table of what was measured is made with it
    Outcome ran = sim(simOptions);
    out.fails = out.fails || ran.status != 0;
    out.summary = ran.output;
    while (out.summary.ends_with('\n'))
      out.summary.pop_back();
    take(std::move(ran));
    return out;
  }

private:
  // Without a machine's file the job says which ball touches the part; its length is in its own offset, and
  // work offsets are where the part is.
  void useProbe(stdlib::Setup& setup) const {
    setup.tool = result_.probe->tool;
    setup.ballDiameter = result_.probe->diameter;
    setup.length = kBareLength;
    for (const std::uint32_t offset : result_.probe->offsets)
      if (offset >= 1 && offset <= 6) setup.zeros.push_back({offset - 1, true, {}});
  }

  // Findings of a command with sources of its own.
  void take(Outcome from) {
    std::map<FileId, FileId> files;
    const auto move = [&](SourceRange& range) {
      if (!range.hasPlace()) return;
      const auto [at, isNew] = files.try_emplace(range.file);
      if (isNew) at->second = session_.sources().add(from.sources.file(range.file));
      range.file = at->second;
    };
    for (Diagnostic& one : from.diagnostics.all()) {
      if (one.range.hasPlace() && from.sources.file(one.range.file).name() == name_)
        noteWriter(one, from.sources.line(one.range));
      const std::size_t own = noted_;
      noted_ = 0;
      move(one.range);
      for (std::size_t i = 0; i + own < one.notes.size(); ++i)
        move(one.notes[i].range);
      if (one.fix)
        for (Edit& edit : one.fix->edits)
          move(edit.range);
      session_.diagnostics().add(std::move(one));
    }
  }

  void noteWriter(Diagnostic& finding, std::uint32_t line) {
    if (line == 0 || line > result_.lines.size()) return;
    const posts::PostPlace* const place = writerOf(result_.lines[line - 1]);
    if (place == nullptr) return;
    finding.note(runner_.lineRange(place->line),
                 place->function.empty() || place->function == "global"
                     ? std::string("the post writes the block here")
                     : fmt::format("the post writes the block here, in {}", place->function));
    noted_ = 1;
  }

  const RunPostOptions& options_;
  const posts::PostResult& result_;
  const posts::PostRunner& runner_;
  Session& session_;
  CommonOptions common_;
  std::string name_;
  std::size_t noted_ = 0; // notes at the end whose place is of the session already
};

} // namespace

CheckedPost checkPosted(const RunPostOptions& options, const posts::PostResult& result,
                        const posts::PostRunner& runner, Session& session) {
  return PostCheck(options, result, runner, session).run();
}

} // namespace dotek::driver
