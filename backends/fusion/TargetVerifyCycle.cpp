#include "backends/fusion/TargetVerifyCycle.h"

#include "backends/fusion/Emit.h"
#include "backends/fusion/Run.h"
#include "backends/fusion/TargetLists.h"
#include "backends/fusion/TargetWritten.h"
#include "project/Compilation.h"
#include "sim/machine/Compile.h"
#include "support/Decimal.h"
#include "support/messages/Verify.h"
#include "targets/ReadBack.h"
#include "targets/Stage.h"
#include "targets/Target.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <set>

namespace dotek::targets {

namespace fusion = backends::fusion;

namespace target {
extern const Target fanuc; // runs the program
}

namespace {

constexpr double kClearance = 40;   // above the start, mm
constexpr double kRounded = 0.0006; // of a word with three decimals, mm
constexpr std::string_view kLine = "  writeln(\"";

// "A", "5." of each word after `G65 P8000`; nullopt: it is no such call.
struct Call {
  std::uint32_t number = 0;
  std::vector<std::pair<char, std::string>> words;
};

std::optional<Call> callOf(std::string_view line) {
  constexpr std::string_view kCall = "G65";
  if (!line.starts_with(kCall)) return std::nullopt;
  Call out;
  std::vector<std::pair<char, std::string>> words;
  for (const char c : line.substr(kCall.size())) {
    if (c == ' ') continue;
    if (c >= 'A' && c <= 'Z')
      words.emplace_back(c, "");
    else if (!words.empty())
      words.back().second += c;
  }
  if (words.empty() || words.front().first != 'P') return std::nullopt;
  out.number = static_cast<std::uint32_t>(parseNumber(words.front().second).value_or(0));
  words.erase(words.begin());
  out.words = std::move(words);
  return out;
}

class FusionCycleVerification final : public Verification {
public:
  explicit FusionCycleVerification(const VerificationSource& source)
      : from_(source), control_(*source.inputs.control),
        runner_({source.session.options().scriptProgram, source.session.limits()}),
        stand_(control_, {}, limits_) {}

  bool prepare() override {
    const Translation& translation = *from_.plan.translation;
    prefix_ = prefixIn(translation.text);
    if (const auto fault = fragment_.load(translation.text, prefix_, true, fusion::sharedHelpers(control_)))
      return report(*fault);
    fusion::RunInput input;
    input.entry = "program";
    const fusion::RunResult program = fragment_.run(input);
    if (program.fault) return report(*program.fault);
    readChecks();
    plan_ = from_.plan;
    plan_.translation = programOf(translation, program.text);
    const std::size_t at = plan_.translation->text.find("\nO");
    number_ = at == std::string::npos
                  ? 0
                  : static_cast<std::uint32_t>(std::atoi(plan_.translation->text.c_str() + at + 2));
    inner_ = target::fanuc.verify(
        {from_.options, plan_, from_.session, from_.inputs, from_.folder, from_.compilation});
    return inner_->prepare();
  }

  TargetRun run(const TargetCase& now) override {
    TargetRun out;
    const fusion::RunInput input = inputOf(now.drawn);
    const fusion::RunResult result = fragment_.run(input);
    if (result.fault) {
      if (result.fault->kind == script::Fault::Kind::Script)
        out.differsAt(verify::Aspect::Ending, "the fragment fails: " + result.fault->text,
                      result.fault->source == fusion::kFragment ? result.fault->line : 0);
      else
        out.stopped = result.fault->text;
      return out;
    }
    if (!result.errors.empty()) {
      compareError(now, result, out);
      return out;
    }
    if (now.rejected && checks_.contains(std::string(now.rejection))) {
      out.differs(
          verify::Aspect::Ending,
          fmt::format("the cycle rejects the values, `{}`, and the fragment prints blocks", now.rejection));
      return out;
    }
    if (losesDigits(result)) {
      out.undecided = out.ofValues = true;
      out.why = "the call gets fewer digits than these values have, and the fragment warns of it";
      return out;
    }
    compareFrame(result, out);
    const Written written = writtenOf(result.text);
    const auto call = std::find_if(written.lines.begin(), written.lines.end(),
                                   [](const std::string& line) { return callOf(line).has_value(); });
    if (call == written.lines.end()) {
      out.differs(verify::Aspect::Ending, "the fragment calls no program");
      return out;
    }
    if (call + 1 != written.lines.end())
      out.differs(verify::Aspect::Printed, "a block after the call", *(call + 1));
    compareWay({written.lines.begin(), call}, now, input, out);
    verify::Case given = now.drawn;
    takeArguments(*callOf(*call), *call, given, out);
    if (!looked_ && out.differences.empty()) lookOtherwise(now, out);
    if (!out.differences.empty()) return out;
    TargetCase called{.drawn = given,
                      .entry = now.entry,
                      .stores = now.stores,
                      .world = now.world,
                      .source = now.source,
                      .rejected = now.rejected,
                      .rejection = now.rejection,
                      .sourceOf = now.sourceOf,
                      .questions = now.questions,
                      .shown = now.shown,
                      .stream = now.stream};
    TargetRun ran = inner_->run(called);
    for (TargetDifference& one : ran.differences)
      if (one.line != 0) one.line = one.line > 1 && first_ != 0 ? one.line - 2 + first_ : 0;
    return ran;
  }

private:
  static double inJob(double value) { return static_cast<float>(value); }

  // What its functions begin with; of one without a dispatch what convert would write.
  std::string prefixIn(const std::string& text) const {
    constexpr std::string_view kFunction = "function ", kDispatch = "_dispatch(";
    const std::size_t end = text.find(kDispatch);
    const std::size_t begin = end == std::string::npos ? end : text.rfind(kFunction, end);
    if (begin != std::string::npos && text.find('\n', begin) > end)
      return text.substr(begin + kFunction.size(), end - begin - kFunction.size());
    return fusion::prefixOf(std::filesystem::path(from_.folder.name).stem().string());
  }

  bool report(const script::Fault& fault) {
    reportFault(fault, fault.source == fusion::kFragment ? fault.line : 0, *from_.plan.translation,
                from_.session);
    return false;
  }

  // The program with what its lines come from, where each is a line of the fragment.
  Translation programOf(const Translation& fragment, const std::string& text) {
    Translation out;
    out.name = fragment.name;
    out.text = "%\n" + text + "%\n";
    out.arguments = fragment.arguments;
    const auto count = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < fragment.text.size();) {
      const std::size_t end = std::min(fragment.text.find('\n', at), fragment.text.size());
      lines.push_back(fragment.text.substr(at, end - at));
      at = end + 1;
    }
    const auto begin = std::find(lines.begin(), lines.end(), "function " + prefix_ + "_program() {");
    std::size_t first = static_cast<std::size_t>(begin - lines.begin()) + 1, last = first;
    while (last < lines.size() && lines[last].starts_with(kLine))
      ++last;
    first_ = last - first == count ? static_cast<std::uint32_t>(first + 1) : 0;
    out.sources.emplace_back(); // %
    for (std::size_t i = 0; i < count; ++i)
      out.sources.push_back(first_ != 0 && first + i < fragment.sources.size() ? fragment.sources[first + i]
                                                                               : std::nullopt);
    out.sources.emplace_back();
    return out;
  }

  // What the checks say; nothing where the fragment leaves them to the program.
  void readChecks() {
    if (from_.plan.translation->text.find(fusion::kChecksOfProgram) != std::string::npos) return;
    Session own(from_.options.common);
    Compilation compilation(own);
    const auto lowered = compilation.lowerFile(from_.options.inputs.front(), from_.options.source);
    if (!lowered) return;
    for (const ir::CycleStatement& statement : lowered->cycle.checks)
      if (const auto* alarm = std::get_if<ir::Alarm>(&statement.node)) checks_.insert(alarm->message);
  }

  const ir::Kind* kindOf(const std::string& name) const {
    for (const verify::DrawField& field : from_.plan.fields)
      if (field.name == name) return &field.kind;
    return nullptr;
  }

  fusion::RunInput inputOf(const verify::Case& drawn) const {
    const auto host = [&](const char* name, double otherwise) {
      const auto found = drawn.hosts.find(name);
      return found == drawn.hosts.end() ? otherwise : found->second;
    };
    fusion::RunInput out;
    for (const auto& [name, value] : drawn.values) {
      out.properties[fusion::propertyOf(prefix_, name)] = inJob(value);
      out.properties[fusion::givingPropertyOf(prefix_, name)] = 1;
    }
    out.points = {{inJob(host("start_x", 0)), inJob(host("start_y", 0)), inJob(host("start_z", 0))}};
    out.toolDiameter = inJob(2 * host("tool_radius", 3));
    out.toolNumber = host("tool_number", 1);
    out.toolLengthOffset = host("tool_offset", 1);
    out.cycle["clearance"] = inJob(host("clearance", host("start_z", 0) + kClearance));
    if (const auto found = drawn.hosts.find("retract"); found != drawn.hosts.end())
      out.cycle["retract"] = inJob(found->second);
    return out;
  }

  // Not a check of the source: what the fragment looks at besides begins with the name of the cycle.
  bool isOfFragment(const std::string& error) const {
    const std::size_t colon = error.find(": ");
    return colon != std::string::npos && fusion::prefixOf(error.substr(0, colon)) == prefix_;
  }

  void compareError(const TargetCase& now, const fusion::RunResult& result, TargetRun& out) const {
    const std::string& error = result.errors.front();
    if (result.wroteAfterError || !result.text.empty())
      out.differs(verify::Aspect::Ending, "the fragment writes blocks beside its error: " + error);
    const bool ascii = std::all_of(now.rejection.begin(), now.rejection.end(),
                                   [](char c) { return static_cast<unsigned char>(c) < 0x80; });
    if (!now.rejected && !isOfFragment(error))
      out.differs(
          verify::Aspect::Ending,
          fmt::format("the cycle takes the values, and the fragment stops with its message `{}`", error));
    else if (now.rejected && ascii && !now.rejection.empty() && !isOfFragment(error) &&
             now.rejection.find(error) == std::string_view::npos)
      out.differs(verify::Aspect::Ending,
                  fmt::format("the cycle rejects the values, `{}`, and the fragment stops with `{}`",
                              now.rejection, error));
    out.refused = out.differences.empty();
    out.why = "the post stops with an error: " + error;
  }

  void compareFrame(const fusion::RunResult& result, TargetRun& out) const {
    if (!result.taken)
      out.differs(verify::Aspect::Ending,
                  fmt::format("`{}_dispatch` prints the cycle and does not return true", prefix_));
    std::string kept;
    for (const std::string& name : result.kept)
      kept += (kept.empty() ? "`" : ", `") + name + "`";
    if (!kept.empty())
      out.differs(verify::Aspect::Modal,
                  kept + " not reset: the post leaves out words that the blocks have made necessary");
  }

  // From wherever the post has been: up before sideways, and to the point of the operation.
  void compareWay(const std::vector<std::string>& lines, const TargetCase& now, const fusion::RunInput& input,
                  TargetRun& out) const {
    std::string text = "O1\n";
    for (const std::string& line : lines)
      text += line + "\n";
    SourceMap sources;
    Diagnostics found;
    const auto file = readBack("way", text + "M30\n", control_, from_.session.limits(), sources, found);
    if (!file) {
      out.differs(verify::Aspect::Printed, "the blocks before the call cannot be read: " + firstError(found),
                  lines.empty() ? "" : lines.front());
      return;
    }
    std::vector<const ir::Program*> programs;
    for (const ir::Program& program : file->programs)
      programs.push_back(&program);
    const sim::Bytecode way = sim::compile(programs, control_, sources);
    const sim::Point3& start = now.entry.start;
    const double clearance = input.cycle.at("clearance");
    for (const sim::Point3 away : {sim::Point3{41, -27, 0}, sim::Point3{-33, 19, clearance - start.z}}) {
      verify::Entry entry = now.entry;
      entry.start = start + away;
      entry.blocks.clear();
      const sim::Part nothing = emptyPart(entry.zeros[entry.system - 54]);
      sim::World world(nothing, probeFor(from_.plan, now.drawn), sim::MachineLimits{});
      const verify::Record record = stand_.run(way, world, entry, {}, nullptr);
      const sim::Point3 wanted = record.start - away,
                        top = record.start + sim::Point3{0, 0, clearance - entry.start.z};
      if (record.ending != verify::Ending::Finished || (record.end - wanted).length() > kRounded) {
        out.differs(verify::Aspect::Path,
                    "the blocks before the call do not lead to the point of the operation",
                    lines.empty() ? "" : lines.back());
        return;
      }
      for (const verify::Piece& piece : record.pieces) {
        const double aside = std::hypot(piece.to.x - piece.from.x, piece.to.y - piece.from.y);
        if (aside <= kRounded || std::min(piece.from.z, piece.to.z) >= top.z - kRounded) continue;
        out.differs(verify::Aspect::Path, "the way to the point goes sideways below the clearance plane",
                    lines.empty() ? "" : lines.front());
        return;
      }
    }
  }

  // What the call says becomes what the program is given.
  void takeArguments(const Call& call, const std::string& line, verify::Case& given, TargetRun& out) const {
    if (call.number != number_)
      out.differs(verify::Aspect::Printed,
                  fmt::format("it calls O{}, and the program is O{}", call.number, number_), line);
    const std::vector<OutputArgument>& arguments = from_.plan.translation->arguments;
    std::set<char> letters;
    for (const auto& [letter, text] : call.words) {
      const std::optional<double> value = parseNumber(text);
      const bool known = std::any_of(arguments.begin(), arguments.end(),
                                     [c = letter](const auto& one) { return one.letter == c; });
      if (!value || !known || text.find('.') == std::string::npos || !letters.insert(letter).second)
        out.differs(verify::Aspect::Printed,
                    fmt::format("the word `{}{}` is no argument of the program", letter, text), line);
    }
    for (const OutputArgument& argument : arguments) {
      const bool field = kindOf(argument.name) != nullptr;
      auto& values = field ? given.values : given.hosts;
      const auto word = std::find_if(call.words.begin(), call.words.end(),
                                     [&](const auto& one) { return one.first == argument.letter; });
      if (word == call.words.end())
        values.erase(argument.name);
      else
        values[argument.name] = parseNumber(word->second).value_or(0);
    }
  }

  // The operation of another cycle, a document in inches, an operation of probing, a field without a value,
  // a clearance plane below the start.
  void lookOtherwise(const TargetCase& now, TargetRun& out) {
    looked_ = true;
    fusion::RunInput input = inputOf(now.drawn);
    input.chosen = false;
    const fusion::RunResult other = fragment_.run(input);
    compareLists(listsOfCycle(from_.options.inputs.front(), from_.options.common), other, prefix_, out);
    if (!other.ok() || !other.text.empty() || other.taken)
      out.differs(verify::Aspect::Ending,
                  "an operation that names no cycle: it has to write nothing; " + didInstead(other));
    input = inputOf(now.drawn);
    input.inch = true;
    demandError(input, "a document in inches", out);
    input = inputOf(now.drawn);
    input.probing = true;
    demandError(input, "a probing operation", out);
    input = inputOf(now.drawn);
    input.cycle["clearance"] = input.points.front()[2] - 1;
    demandError(input, "a clearance plane below the start", out);
    for (const OutputArgument& argument : from_.plan.translation->arguments) {
      input = inputOf(now.drawn);
      const std::string property = fusion::propertyOf(prefix_, argument.name);
      if (!input.properties.contains(property)) continue;
      input.noNumber = property;
      demandError(input, fmt::format("`{}` without a number", argument.name), out);
    }
  }

  void demandError(const fusion::RunInput& input, const std::string& what, TargetRun& out) const {
    const fusion::RunResult result = fragment_.run(input);
    if (result.fault || result.errors.empty() || !result.text.empty())
      out.differs(verify::Aspect::Ending, what + " has to be an error; " + didInstead(result));
  }

  const VerificationSource from_;
  const stdlib::Control& control_;
  const Limits limits_ = limitsOfRun(from_.session.limits());
  script::Runner runner_;
  fusion::Fragment fragment_{runner_};
  verify::Stand stand_;
  VerifyPlan plan_; // of the program
  std::unique_ptr<Verification> inner_;
  std::string prefix_;
  std::uint32_t number_ = 0;     // of the program
  std::uint32_t first_ = 0;      // line of the fragment, from 1, that writes its first line; 0: not known
  std::set<std::string> checks_; // messages of the cycle's checks
  bool looked_ = false;
};

} // namespace

std::unique_ptr<Verification> fusionCycleVerification(const VerificationSource& source) {
  return std::make_unique<FusionCycleVerification>(source);
}

} // namespace dotek::targets
