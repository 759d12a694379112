#include "support/messages/Verify.h"
#include "driver/CycleFolder.h"
#include "driver/Driver.h"
#include "driver/Targets.h"
#include "driver/VerifyCase.h"
#include "driver/VerifyReport.h"
#include "frontend/gibbs/Cycle.h"
#include "ir/Rewrite.h"
#include "sim/PartFile.h"
#include "support/Files.h"
#include "support/messages/Commands.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>

namespace dotek::driver {
namespace {

constexpr std::uint64_t kEdgeShare = 10;                 // one edge case beside so many others
constexpr std::uint64_t kEdges = std::uint64_t{1} << 62; // numbers of edge cases begin here

class VerifyCommand {
public:
  VerifyCommand(const VerifyOptions& options, Session& session)
      : options_(options), session_(session), main_(options, plan_) {}

  Outcome run() {
    if (!checkOptions()) return session_.finish("");
    if (!main_.load() || !makePlan()) return main_.session().finish("");
    main_.session().diagnostics() = Diagnostics();
    if (!main_.prepare()) return main_.session().finish("");
    VerifyReport report(options_, plan_, main_);
    if (!runCases(report)) return main_.session().finish("");
    main_.session().diagnostics() = Diagnostics();
    return report.finish();
  }

private:
  bool checkOptions() {
    Diagnostics& diagnostics = session_.diagnostics();
    if (options_.inputs.size() != 1)
      diagnostics.report<diag::MissingOption>({}, "verify", "INPUT",
                                              "one folder of a cycle, or one file of programs");
    if (!options_.to.empty() && std::find(kTargets.begin(), kTargets.end(), options_.to) == kTargets.end())
      diagnostics.report<diag::UnknownTarget>({}, options_.to);
    if (options_.to.empty() && !options_.source.prog && !diagnostics.hasErrors())
      diagnostics.report<diag::MissingOption>({}, "verify", "--prog PROG.txt or --to TARGET",
                                              "what the cycle is compared with");
    return !diagnostics.hasErrors();
  }

  bool makePlan() {
    Session& session = main_.session();
    plan_.fixedHosts = main_.inputs().hosts;
    if (!loadWorld()) return false;
    std::set<std::string> used;
    std::optional<LoweredCycle> lowered = lowerCycle(main_.folder(), main_.inputs(), used, session);
    if (!lowered && (!options_.to.empty() || !main_.inputs().program)) return false;
    if (lowered) {
      if (lowered->macros != nullptr) plan_.sourceMacros = lowered->macros->name;
      takeFields(*lowered);
    } else {
      session.diagnostics() = Diagnostics();
      for (const frontend::gibbs::Field& field : frontend::gibbs::declaredFields(*main_.folder().cycle))
        addField(field.name.text, ir::Kind::Number, field.value, {});
    }
    if (options_.to.empty()) return true;
    return translate();
  }

  bool loadWorld() {
    Session& session = main_.session();
    if (options_.machine) {
      plan_.machine =
          sim::loadMachine(*options_.machine, session.limits(), session.sources(), session.diagnostics());
      if (!plan_.machine) return false;
    }
    if (!options_.part) return true;
    const auto part =
        sim::loadPart(*options_.part, session.limits(), session.sources(), session.diagnostics());
    if (!part) return false;
    plan_.part = part->part;
    return true;
  }

  void addField(const std::string& name, ir::Kind kind, std::optional<double> initial,
                std::vector<double> thresholds, int decimals = 3) {
    verify::DrawField field;
    field.name = name;
    field.kind = kind;
    field.initial = initial;
    field.decimals = decimals;
    field.thresholds = std::move(thresholds);
    for (const auto& [given, value] : main_.inputs().sets)
      if (frontend::gibbs::foldCase(given) == frontend::gibbs::foldCase(name)) field.fixed = value;
    plan_.fields.push_back(std::move(field));
  }

  void takeFields(const LoweredCycle& lowered) {
    std::map<ir::VariableId, int> decimals;
    for (const ir::PrintedBlock& block : lowered.printed)
      for (const ir::PrintedPiece& piece : block.pieces)
        if (piece.picture) {
          const auto [at, added] = decimals.emplace(piece.variable, piece.picture->decimals());
          if (!added) at->second = std::min(at->second, piece.picture->decimals());
        }
    for (const auto& [id, places] : decimals)
      if (const ir::Variable& host = lowered.cycle.variable(id); host.role == ir::Role::Host)
        plan_.hostDecimals.emplace(host.name, places);
    const std::set<double> compared = ir::constantsOf(lowered.cycle.checks);
    const std::vector<double> thresholds(compared.begin(), compared.end());
    for (ir::VariableId id = 0; id < lowered.cycle.variables.size(); ++id) {
      const ir::Variable& variable = lowered.cycle.variable(id);
      if (variable.role != ir::Role::Parameter) continue;
      const auto places = decimals.find(id);
      addField(variable.name, variable.kind, variable.defaultValue, thresholds,
               places == decimals.end() ? 3 : places->second);
    }
  }

  bool translate() {
    ConvertOptions convert;
    convert.inputs = options_.inputs;
    convert.common = options_.common;
    convert.source = options_.source;
    convert.to = options_.to;
    convert.control = options_.control;
    convert.probeMacros = options_.probeMacros;
    convert.datum = options_.datum;
    Outcome outcome = driver::convert(convert);
    if (outcome.status != 0 || outcome.files.size() != 1) {
      refused_ = std::move(outcome);
      return false;
    }
    Translation translation;
    translation.name = outcome.files.front().name;
    translation.text = outcome.files.front().text;
    translation.number = numberOf(translation.text);
    if (!outcome.arguments.empty()) translation.arguments = outcome.arguments.front();
    for (const MappedLine& line : outcome.maps.front().lines) {
      auto& places = translation.sources.emplace_back().emplace();
      for (const SourceRange& range : line.ranges)
        if (range.hasPlace())
          places.emplace(outcome.sources.file(range.file).name(), outcome.sources.line(range));
    }
    if (options_.translation && !takeEdited(translation)) return false;
    plan_.targetMacros = outcome.macros;
    plan_.translation = std::move(translation);
    return true;
  }

  // The text of --translation; its lines that convert would write as well keep what they come from.
  bool takeEdited(Translation& translation) {
    Session& session = main_.session();
    const auto bytes = readBytes(*options_.translation, session.limits(), session.diagnostics());
    if (!bytes) return false;
    const SourceFile before("", translation.text, Encoding::Utf8), now("", *bytes, Encoding::Utf8);
    const std::uint32_t rows = before.lineCount(), columns = now.lineCount();
    constexpr std::uint64_t kMost = 25'000'000;
    std::vector<std::optional<std::set<std::pair<std::string, std::uint32_t>>>> sources(columns);
    if (std::uint64_t{rows} * columns <= kMost) {
      // The longest common subsequence of lines.
      std::vector<std::vector<std::uint32_t>> common(rows + 1, std::vector<std::uint32_t>(columns + 1, 0));
      for (std::uint32_t r = rows; r-- > 0;)
        for (std::uint32_t c = columns; c-- > 0;)
          common[r][c] = before.line(r + 1) == now.line(c + 1) ? common[r + 1][c + 1] + 1
                                                               : std::max(common[r + 1][c], common[r][c + 1]);
      for (std::uint32_t r = 0, c = 0; r < rows && c < columns;) {
        if (before.line(r + 1) == now.line(c + 1)) {
          if (r < translation.sources.size()) sources[c] = translation.sources[r];
          ++r, ++c;
        } else if (common[r + 1][c] >= common[r][c + 1]) {
          ++r;
        } else {
          ++c;
        }
      }
    }
    translation.name = *options_.translation;
    translation.text = *bytes;
    translation.sources = std::move(sources);
    return true;
  }

  static std::uint32_t numberOf(const std::string& text) {
    const std::size_t at = text.find("\nO");
    return at == std::string::npos ? 0 : static_cast<std::uint32_t>(std::atoi(text.c_str() + at + 2));
  }

  // Cases go to whoever is free; what they come to is put together by their numbers.
  bool runCases(VerifyReport& report) {
    const std::uint64_t edges = options_.to.empty() || options_.replay ? 0 : options_.cases / kEdgeShare;
    const std::uint64_t all = options_.cases + edges;
    std::atomic<std::uint64_t> next = 0, done = 0;
    std::atomic<bool> stop = false;
    std::mutex mutex;
    std::string noValues;
    const auto work = [&](CaseRunner& runner) {
      for (std::uint64_t n = next++; n < all && !stop; n = next++) {
        const bool edge = n >= options_.cases;
        std::optional<verify::Case> drawn;
        if (edge)
          drawn = runner.edge(n - options_.cases);
        else
          drawn = runner.draw(n);
        if (!drawn) {
          const std::lock_guard lock(mutex);
          noValues = runner.lastRefusal();
          stop = true;
          return;
        }
        CaseResult result = runner.run(*drawn);
        const std::lock_guard lock(mutex);
        if (options_.traces) options_.traces(n, result.verdict == CaseVerdict::Proved, result.trace);
        report.add(edge ? kEdges + n : n, edge, std::move(*drawn), std::move(result));
        const std::uint64_t finished = ++done;
        if (options_.progress && (finished % 64 == 0 || finished == all)) options_.progress(finished, all);
      }
    };
    std::uint32_t jobs =
        options_.jobs != 0 ? options_.jobs : std::max(1U, std::thread::hardware_concurrency());
    jobs = static_cast<std::uint32_t>(std::min<std::uint64_t>(jobs, std::max<std::uint64_t>(1, all / 32)));
    std::vector<std::thread> threads;
    for (std::uint32_t i = 1; i < jobs; ++i) {
      threads.emplace_back([&] {
        CaseRunner runner(options_, plan_);
        if (runner.load()) {
          runner.session().diagnostics() = Diagnostics();
          if (runner.prepare()) work(runner);
        }
      });
    }
    work(main_);
    for (std::thread& thread : threads)
      thread.join();
    if (!stop) return true;
    main_.session().diagnostics() = Diagnostics();
    main_.session().diagnostics().report<diag::NoValuesFound>({main_.folder().place, 0, 0}, noValues);
    return false;
  }

  const VerifyOptions& options_;
  Session& session_;
  VerifyPlan plan_;
  CaseRunner main_;

public:
  std::optional<Outcome> refused_; // of convert
};

} // namespace

Outcome verify(const VerifyOptions& options) {
  return guarded(options.common, [&](Session& session) {
    VerifyCommand command(options, session);
    Outcome outcome = command.run();
    return command.refused_ ? std::move(*command.refused_) : std::move(outcome);
  });
}

} // namespace dotek::driver
