#include "driver/RunPost.h"
#include "driver/Command.h"
#include "driver/PostCheck.h"
#include "posts/LathePost.h"
#include "posts/PostJob.h"
#include "posts/PostRun.h"
#include "support/Files.h"
#include "support/Printable.h"
#include "support/messages/Commands.h"
#include "support/messages/Posts.h"

#include <algorithm>

namespace dotek::driver {

namespace {

constexpr std::size_t kMostCompared =
    4000; // lines that are matched; of longer texts only those that lie alike

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string line = text.substr(at, end - at);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    out.push_back(std::move(line));
    at = end + 1;
  }
  return out;
}

struct Difference {
  std::string text;        // all lines, with `-`, `+` or a blank before each
  std::size_t differs = 0; // lines that only one has
  std::size_t line = 0;    // first of these, in the new text
  std::string now, before; // there
};

// Lines of `before` that `now` lacks, and those that it has instead.
Difference compared(const std::vector<std::string>& before, const std::vector<std::string>& now) {
  Difference out;
  const std::size_t n = before.size(), m = now.size();
  const bool whole = n <= kMostCompared && m <= kMostCompared;
  std::vector<std::vector<std::uint16_t>> common;
  if (whole) {
    common.assign(n + 1, std::vector<std::uint16_t>(m + 1, 0));
    for (std::size_t i = n; i-- > 0;)
      for (std::size_t k = m; k-- > 0;)
        common[i][k] = before[i] == now[k] ? static_cast<std::uint16_t>(common[i + 1][k + 1] + 1)
                                           : std::max(common[i + 1][k], common[i][k + 1]);
  }
  const auto note = [&](std::size_t i, std::size_t k) {
    if (out.differs++ != 0) return;
    out.line = k + 1;
    out.now = k < m ? now[k] : "(nothing)";
    out.before = i < n ? before[i] : "(nothing)";
  };
  std::size_t i = 0, k = 0;
  while (i < n || k < m) {
    if (i < n && k < m && before[i] == now[k]) {
      out.text += "  " + now[k] + "\n";
      ++i;
      ++k;
    } else if (i < n && (k == m || !whole || common[i + 1][k] >= common[i][k + 1])) {
      note(i, k);
      out.text += "- " + before[i++] + "\n";
      if (!whole && k < m) out.text += "+ " + now[k++] + "\n";
    } else {
      note(i, k);
      out.text += "+ " + now[k++] + "\n";
    }
  }
  return out;
}

class RunPostCommand {
public:
  RunPostCommand(const RunPostOptions& options, Session& session) : options_(options), session_(session) {
    job_.properties = options.properties;
    job_.map = options.map || options.check;
    job_.most = session.limits().scriptOutput;
  }

  Outcome run() {
    Diagnostics& diagnostics = session_.diagnostics();
    if (options_.post.empty())
      diagnostics.report<diag::MissingOption>({}, "run-post", "POST.cps", "the post that is run");
    else if (!options_.job && options_.matrix.empty())
      diagnostics.report<diag::MissingOption>(
          {}, "run-post", "JOB.toml or --matrix KIND",
          "what the post is run on; `dotek new job --from POST.cps` begins one");
    if (diagnostics.hasErrors()) return outcomeOf(session_, "");
    const std::optional<std::string> text = textOf(options_.post, true);
    if (!text) return outcomeOf(session_, "");
    std::string output = *text;
    if (options_.diff) compare(*options_.diff, textOf(*options_.diff, false), *text, output);
    if (options_.expect) {
      std::optional<std::string> wanted;
      if (const auto file = session_.read(*options_.expect, Encoding::Cp1250))
        wanted = toUtf8(session_.sources().file(*file).bytes(), session_.sources().file(*file).encoding());
      compare(*options_.expect, wanted, *text, output);
    }
    const bool differs = differs_;
    Outcome outcome = outcomeOf(session_, std::move(output), differs || options_.check);
    outcome.summary = std::move(summary_);
    if (outcome.status > 1) outcome.output.clear(); // the command line is wrong
    outcome.maps = std::move(maps_);
    if (outcome.status == 0 && failed_) outcome.status = 1;
    return outcome;
  }

private:
  void compare(const std::string& with, const std::optional<std::string>& before, const std::string& now,
               std::string& output) {
    if (!before) return;
    const std::vector<std::string> lines = linesOf(now);
    const Difference difference = compared(linesOf(*before), lines);
    if (difference.differs == 0) return;
    differs_ = true;
    output = difference.text;
    session_.diagnostics().report<diag::PostDiffers>({}, with, difference.differs, lines.size(),
                                                     difference.line, difference.now, difference.before);
  }

  // What a post writes; nullopt: reported. `main`: the one whose map is asked for.
  std::optional<std::string> textOf(const std::string& path, bool main) {
    std::optional<posts::PostJob> job;
    if (options_.matrix.empty()) {
      job = posts::readPostJob(*options_.job, job_, session_);
      if (!job) return std::nullopt;
      if (options_.inch && *options_.inch != job->inch) {
        session_.diagnostics().report<diag::PostUnitOther>(
            {}, *options_.job, job->inch ? "inches" : "millimetres", *options_.inch ? "in" : "mm");
        return std::nullopt;
      }
    }
    script::Options script(session_.options().scriptProgram, session_.limits());
    posts::PostRunner runner(session_, script);
    if (!runner.load(path, options_.inch.value_or(job && job->inch))) return std::nullopt;
    if (!job) return matrix(runner);
    const posts::PostResult result = runner.run(job->json);
    runner.report(result);
    if (result.fault) return std::nullopt;
    if (main && options_.map) takeMap(runner, result);
    if (main && options_.check) {
      CheckedPost checked = checkPosted(options_, result, runner, session_);
      failed_ = failed_ || checked.fails;
      summary_ = std::move(checked.summary);
    }
    std::string out = result.nc;
    for (const auto& [name, text] : result.files)
      if (options_.diff) out += "(redirected to " + name + ")\n" + text;
    return out;
  }

  void takeMap(const posts::PostRunner& runner, const posts::PostResult& result) {
    MappedResult& map = maps_.emplace_back();
    map.name = options_.post;
    for (std::size_t i = 0; i < result.lines.size(); ++i) {
      MappedLine& line = map.lines.emplace_back();
      line.line = static_cast<std::uint32_t>(i + 1);
      for (const posts::PostPlace& place : result.lines[i]) {
        if (const SourceRange where = runner.lineRange(place.line); where.hasPlace())
          line.ranges.push_back(where);
        line.reason += (line.reason.empty() ? "" : " < ") + place.function;
      }
    }
  }

  std::optional<std::string> matrix(posts::PostRunner& runner) {
    const auto jobs = posts::matrixJobs(options_.matrix, job_, session_);
    if (jobs.empty()) {
      std::string kinds;
      for (const std::string& kind : posts::matrixKinds(session_))
        kinds += (kinds.empty() ? "`" : ", `") + kind + "`";
      session_.diagnostics().report<diag::PostMatrixKind>({}, options_.matrix, kinds);
      return std::nullopt;
    }
    std::size_t width = 0, printed = 0, empty = 0, refused = 0, failed = 0;
    for (const posts::MatrixJob& job : jobs)
      width = std::max(width, job.name.size());
    std::string out;
    for (const posts::MatrixJob& job : jobs) {
      const posts::PostResult result = runner.run(job.json);
      out += fmt::format("{:<{}}  ", job.name, width);
      if (result.fault) {
        const posts::PostFault& fault = *result.fault;
        const bool refusal =
            fault.kind == posts::PostFault::Kind::Refusal || fault.kind == posts::PostFault::Kind::Expand;
        ++(refusal ? refused : failed);
        out += fmt::format("{}: {}{}\n", refusal ? "refused" : "fails", printable(fault.text),
                           fault.stack.empty() ? "" : fmt::format(" (line {})", fault.stack.front().line));
        continue;
      }
      const std::vector<std::string> blocks = blocksOf(result, job.isCycle);
      ++(blocks.empty() ? empty : printed);
      out += fmt::format("{} block{}\n", blocks.size(), blocks.size() == 1 ? "" : "s");
      for (const std::string& block : blocks)
        out += "    " + printable(block) + "\n";
    }
    const bool cycles = std::all_of(jobs.begin(), jobs.end(), [](const auto& job) { return job.isCycle; });
    out += fmt::format("{} of {} {} are printed, {} refused, {} fail", printed, jobs.size(),
                       cycles ? "cycles" : "operations", refused, failed);
    out += empty == 0 ? "\n" : fmt::format(", {} print nothing\n", empty);
    failed_ = failed_ || failed > 0 || empty > 0;
    return out;
  }

  // What onCyclePoint wrote, directly or by others; of moves what the operation wrote from onSection on.
  static std::vector<std::string> blocksOf(const posts::PostResult& result, bool isCycle) {
    const auto counts = [&](const posts::PostPlace& place) {
      if (isCycle) return place.function == "onCyclePoint";
      return place.function.starts_with("on") && place.function != "onOpen" && place.function != "onClose" &&
             place.function != "onMachine" && place.function != "onTerminate";
    };
    std::vector<std::string> out;
    const std::vector<std::string> lines = linesOf(result.nc);
    for (std::size_t i = 0; i < lines.size() && i < result.lines.size(); ++i) {
      const auto& stack = result.lines[i];
      if (std::any_of(stack.begin(), stack.end(), counts)) out.push_back(lines[i]);
    }
    return out;
  }

  const RunPostOptions& options_;
  Session& session_;
  posts::JobOptions job_;
  std::vector<MappedResult> maps_;
  std::string summary_; // of --check
  bool differs_ = false, failed_ = false;
};

} // namespace

Outcome runPost(const RunPostOptions& options) {
  return guarded(options.common, [&](Session& session) { return RunPostCommand(options, session).run(); });
}

Outcome newJob(const RunPostOptions& options) {
  return guarded(options.common, [&](Session& session) {
    posts::PostRunner runner(session, script::Options(session.options().scriptProgram, session.limits()));
    if (!runner.load(options.post, false)) return outcomeOf(session, "");
    return outcomeOf(session,
                     posts::newPostJob(options.post, runner.properties(), runner.capabilities(),
                                       posts::namesProbing(session.sources().file(runner.file()).bytes())));
  });
}

Outcome newPost(const std::string& description, const CommonOptions& common) {
  return guarded(common, [&](Session& session) {
    return outcomeOf(session, posts::newLathePost(description, session).value_or(""));
  });
}

} // namespace dotek::driver
